// One invocation per pixel: casts four rays into an analytic scene, and lights each hit with the lights that reach it.
//
// What concerns manylights stands between the [integration] marks. The rest is a small ray caster. Everything is in
// camera-relative space: world axes, with the camera at the origin.
#version 460
#extension GL_GOOGLE_include_directive : require
#include <manylights/format.h>

layout(local_size_x = 8, local_size_y = 8) in;

struct Light { // the same 32 bytes as Light in minimal.cpp
    vec3 position_ws;
    float range;
    vec3 color;
    float bulb_radius;
};

// The five buffers of manylights.
layout(std430, binding = 0) readonly buffer Views { MlView d[]; } views;
layout(std430, binding = 1) readonly buffer SliceEdges { float d[]; } slice_edges;
layout(std430, binding = 2) readonly buffer Cells { MlCell d[]; } cells;
layout(std430, binding = 3) readonly buffer Nodes { uvec4 d[]; } nodes;
layout(std430, binding = 4) readonly buffer References { uint d[]; } references;
// Our own.
layout(std430, binding = 5) readonly buffer Lights { Light d[]; } lights;
layout(std430, binding = 6) writeonly buffer Pixels { uint d[]; } pixels;

// The direction of a ray is forward + x * right + y * down, with x and y from -1 to 1 over the image. forward has
// length one and the other two are at right angles to it, so the distance in such lengths is the view depth.
layout(push_constant) uniform Camera {
    vec4 right;
    vec4 down;
    vec4 forward;
    vec4 position_ws;
    uvec2 size;
} camera;

struct Surface {
    vec3 point; // camera-relative
    float view_depth;
    vec3 normal;
    vec3 to_camera;
    vec3 albedo;
    float roughness;
};

vec3 center(uint light) { return lights.d[light].position_ws - camera.position_ws.xyz; }
float range(uint light) { return lights.d[light].range; }

// Fades to zero at the range: Karis 2013, "Real Shading in Unreal Engine 4".
float range_window(float squared_distance, float range) {
    float ratio = squared_distance / (range * range);
    float window = max(1.0 - ratio * ratio, 0.0);
    return window * window;
}

// Reflected radiance: Lambert, and GGX with Schlick's Fresnel term for a surface with 4% reflectance.
vec3 reflected(Surface surface, vec3 to_light, float n_dot_l) {
    vec3 half_vector = normalize(to_light + surface.to_camera);
    float n_dot_h = dot(surface.normal, half_vector);
    float n_dot_v = max(dot(surface.normal, surface.to_camera), 0.02);
    float alpha = surface.roughness * surface.roughness;
    float lobe = n_dot_h * n_dot_h * (alpha * alpha - 1.0) + 1.0;
    float distribution = alpha * alpha / (lobe * lobe);
    float visibility = 0.5 / mix(2.0 * n_dot_l * n_dot_v, n_dot_l + n_dot_v, alpha);
    float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(half_vector, to_light), 0.0), 5.0);
    return surface.albedo * (1.0 - fresnel) + distribution * visibility * fresnel;
}

// The bulb itself and its halo, where the ray passes it before it arrives at the surface. Only lights that reach the
// surface are asked, and their halo fades with the light's effect there, so none ends abruptly.
float bulb(Surface surface, vec3 center_of_light, float bulb_radius) {
    float along = clamp(dot(center_of_light, -surface.to_camera), 0.0, length(surface.point));
    vec3 miss = center_of_light + along * surface.to_camera;
    float squared_ratio = dot(miss, miss) / (bulb_radius * bulb_radius);
    return 14.0 * exp2(-squared_ratio * squared_ratio) + 0.5 * exp2(-0.35 * squared_ratio);
}

vec3 shade(uint light, Surface surface) {
    vec3 offset = center(light) - surface.point;
    float squared_distance = dot(offset, offset);
    vec3 to_light = offset * inversesqrt(squared_distance);
    float n_dot_l = max(dot(surface.normal, to_light), 0.0);
    vec3 from_surface = reflected(surface, to_light, n_dot_l) * n_dot_l / (squared_distance + 0.01);
    float from_bulb = bulb(surface, center(light), lights.d[light].bulb_radius);
    return lights.d[light].color * range_window(squared_distance, range(light)) * (from_surface + from_bulb);
}

// [integration]
#define ML_SLICE_EDGE(i) slice_edges.d[i]
#define ML_CELL(i) cells.d[i]
#define ML_NODE(i) ml_node_from_words(nodes.d[i])
#define ML_REFERENCE(i) references.d[i]
#include <manylights/query.h>

vec3 light_from_all(Surface surface, vec2 pixel) {
    vec3 sum = vec3(0.0);
    MlCursor cursor = ml_begin(views.d[0], pixel, surface.view_depth);
    uint light;
    while (ml_next(cursor, light))
        if (ml_affects(surface.point, center(light), range(light))) sum += shade(light, surface);
    return sum;
}
// [/integration]

const vec4 spheres_ws[] = { // centre, radius
    vec4(-5.2, 1.9, -2.5, 1.9), vec4(0.6, 1.3, 1.2, 1.3), vec4(6.4, 2.4, -6.0, 2.4), vec4(-1.6, 0.7, 4.6, 0.7),
    vec4(4.6, 0.9, 3.6, 0.9), vec4(-11.5, 2.6, -13.0, 2.6), vec4(1.2, 3.0, -16.0, 3.0), vec4(15.0, 2.2, -19.0, 2.2)};

const float no_hit = 1e30;
const vec3 moonlight = vec3(0.045, 0.065, 0.120);

// Distance to the nearer intersection, in lengths of direction.
float hit_sphere(vec3 direction, vec3 center_of_sphere, float radius) {
    float squared_length = dot(direction, direction);
    float nearest = dot(direction, center_of_sphere) / squared_length;
    vec3 miss = center_of_sphere - nearest * direction;
    float half_chord = (radius * radius - dot(miss, miss)) / squared_length;
    return half_chord > 0.0 && nearest > 0.0 ? nearest - sqrt(half_chord) : no_hit;
}

vec3 sky(vec3 direction) {
    float height = max(direction.y, 0.0);
    return mix(vec3(0.003, 0.006, 0.022), vec3(0.070, 0.042, 0.085), exp(-11.0 * height));
}

// How much of the sky the spheres hide from a point: Quilez, "Sphere ambient occlusion".
float open_sky(Surface surface) {
    float open = 1.0;
    for (int i = 0; i < spheres_ws.length(); ++i) {
        vec3 offset = spheres_ws[i].xyz - camera.position_ws.xyz - surface.point;
        float squared_distance = dot(offset, offset);
        float squared_radius = spheres_ws[i].w * spheres_ws[i].w;
        float cosine = dot(surface.normal, offset) * inversesqrt(squared_distance);
        if (squared_distance > 1.001 * squared_radius)
            open *= 1.0 - max(cosine, 0.0) * squared_radius / squared_distance;
    }
    return open;
}

// Paving with joints, which fade out before they become finer than a pixel.
void pave(inout Surface surface) {
    vec2 place = surface.point.xz + camera.position_ws.xz;
    vec2 stone = floor(place);
    vec2 to_joint = 0.5 - abs(place - stone - 0.5);
    float width = 0.0016 * surface.view_depth;
    float joint = 1.0 - smoothstep(0.02, 0.02 + width, min(to_joint.x, to_joint.y));
    joint *= 1.0 / (1.0 + 0.004 * surface.view_depth * surface.view_depth);
    float tone = fract(sin(dot(stone, vec2(12.9898, 78.233))) * 43758.547);
    surface.albedo = vec3(0.20, 0.20, 0.22) * mix(0.8 + 0.4 * tone, 0.3, joint);
    surface.roughness = mix(0.30 + 0.12 * tone, 0.8, joint);
}

bool cast_ray(vec3 direction, out Surface surface) {
    surface.view_depth = direction.y < 0.0 ? -camera.position_ws.y / direction.y : no_hit;
    surface.normal = vec3(0.0, 1.0, 0.0);
    int sphere = -1;
    for (int i = 0; i < spheres_ws.length(); ++i) {
        float hit = hit_sphere(direction, spheres_ws[i].xyz - camera.position_ws.xyz, spheres_ws[i].w);
        if (hit >= surface.view_depth) continue;
        surface.view_depth = hit;
        sphere = i;
    }
    surface.point = surface.view_depth * direction;
    surface.to_camera = -normalize(direction);
    if (sphere < 0) {
        pave(surface);
    } else {
        surface.normal = (surface.point - (spheres_ws[sphere].xyz - camera.position_ws.xyz)) / spheres_ws[sphere].w;
        surface.albedo = vec3(0.78, 0.76, 0.73);
        surface.roughness = 0.28;
    }
    return surface.view_depth < no_hit;
}

// Radiance along the ray through a place in the image, given in pixels.
vec3 radiance(vec2 pixel) {
    vec2 place = 2.0 * pixel / vec2(camera.size) - 1.0;
    vec3 direction = camera.forward.xyz + place.x * camera.right.xyz + place.y * camera.down.xyz;
    Surface surface;
    if (!cast_ray(direction, surface)) return sky(normalize(direction));
    float open = open_sky(surface);
    vec3 mirrored = reflect(-surface.to_camera, surface.normal);
    float fresnel = 0.04 + 0.5 * pow(1.0 - max(dot(surface.normal, surface.to_camera), 0.0), 5.0);
    float moon = 0.5 + 0.5 * dot(surface.normal, vec3(-0.48, 0.80, 0.36));
    vec3 ambient = open * (surface.albedo * mix(vec3(0.01), moonlight, moon) + fresnel * sky(mirrored));
    vec3 color = ambient + open * light_from_all(surface, pixel);
    float haze = 1.0 - exp(-0.00035 * surface.view_depth * surface.view_depth);
    return mix(color, sky(vec3(0.0)), haze);
}

// Narkowicz 2015, "ACES filmic tone mapping curve", then the sRGB transfer function.
vec3 to_display(vec3 color) {
    color = clamp(color * (2.51 * color + 0.03) / (color * (2.43 * color + 0.59) + 0.14), 0.0, 1.0);
    return mix(12.92 * color, 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, greaterThan(color, vec3(0.0031308)));
}

void main() {
    uvec2 id = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(id, camera.size))) return;
    // Four rays on a rotated grid. guard_px 0.5 makes the lights of the whole pixel available.
    const vec2 places[] = {vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875)};
    vec3 color = vec3(0.0);
    for (int i = 0; i < 4; ++i) color += 0.25 * to_display(radiance(vec2(id) + places[i]));
    // Interleaved gradient noise (Jimenez 2014), half a step wide, hides the bands of the sky.
    float noise = fract(52.9829189 * fract(dot(vec2(id), vec2(0.06711056, 0.00583715)))) - 0.5;
    pixels.d[id.y * camera.size.x + id.x] = packUnorm4x8(vec4(color + noise / 255.0, 1.0));
}
