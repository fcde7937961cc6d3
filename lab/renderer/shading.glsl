// How a surface answers to light: emission and a little ambient light, and for each light the falloff of glTF's
// KHR_lights_punctual with a Lambert and GGX reflection. Never non-finite, whatever the lights and the materials are.
//
// `precise`: the shaders of two techniques must not differ in which operations a driver fuses, for their radiances are
// compared bit by bit.
#ifndef MANYLIGHTS_LAB_SHADING_GLSL
#define MANYLIGHTS_LAB_SHADING_GLSL

// The same text as MaterialRecord in point_buffer.h.
struct MaterialRecord {
    vec3 base_color;
    float roughness;
    vec3 emissive;
    float metallic;
};

// A point ready to be lit: what does not depend on the light.
struct Surface {
    vec3 position; // relative to the camera
    vec3 normal;
    vec3 view; // unit length, towards the camera
    vec3 diffuse;
    vec3 specular; // reflectance at normal incidence
    vec3 unlit;
    float alpha;   // squared roughness
    float cos_view;
};

const float kPi = 3.14159265;
const float kBrightest = 65504.0; // per light and channel: the largest half float
// Below this a highlight is smaller than a pixel and only makes sparkles.
const float kSmoothest = 0.06;
// Dim, bluish from above and brownish from below: shapes stay visible where no light reaches.
const vec3 kAmbientAbove = vec3(0.016, 0.019, 0.026);
const vec3 kAmbientBelow = vec3(0.007, 0.006, 0.005);

// Sums of products in a fixed order: `precise` does not reach into the built-in dot.
float dot_product(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

vec3 safe_normalize(vec3 v, vec3 fallback) {
    precise float squared_length = dot_product(v, v);
    precise vec3 normalized = v * inversesqrt(squared_length);
    return squared_length > 1e-30 && squared_length < 1e30 ? normalized : fallback;
}

Surface make_surface(vec3 position, vec3 normal, MaterialRecord material) {
    precise Surface surface;
    surface.position = position;
    surface.normal = normal;
    surface.view = safe_normalize(-position, normal);
    surface.diffuse = material.base_color * (1.0 - material.metallic);
    surface.specular = mix(vec3(0.04), material.base_color, material.metallic);
    precise vec3 ambient = mix(kAmbientBelow, kAmbientAbove, 0.5 * normal.y + 0.5);
    surface.unlit = material.emissive + ambient * material.base_color;
    precise float roughness = clamp(material.roughness, kSmoothest, 1.0);
    surface.alpha = roughness * roughness;
    surface.cos_view = max(dot_product(normal, surface.view), 1e-4);
    return surface;
}

// What the camera sees of the surface without any light.
vec3 unlit_radiance(Surface surface) { return surface.unlit; }

// KHR_lights_punctual, "Range Property": intensity * clamp(1 - (d / r)^4, 0, 1) / d^2. A point light's irradiance has no
// bound at the light itself; 1e-4 stands for a lamp of 1 cm.
float light_falloff(float squared_distance, float range) {
    precise float ratio = squared_distance / max(range * range, 1e-30);
    precise float falloff = clamp(1.0 - ratio * ratio, 0.0, 1.0) / max(squared_distance, 1e-4);
    return falloff;
}

// GGX distribution (Walter et al. 2007) times the height-correlated Smith visibility (Heitz 2014), which holds the
// 4 (n.l) (n.v) of the microfacet model's denominator.
float specular_lobe(float alpha, float cos_half, float cos_light, float cos_view) {
    precise float a2 = alpha * alpha;
    precise float d = (cos_half * a2 - cos_half) * cos_half + 1.0; // 1 + cos^2 (a2 - 1) >= a2 > 0
    precise float distribution = a2 / (kPi * max(d * d, 1e-12));
    precise float shadowing = cos_view * sqrt(cos_light * cos_light * (1.0 - a2) + a2);
    precise float masking = cos_light * sqrt(cos_view * cos_view * (1.0 - a2) + a2);
    precise float lobe = distribution * 0.5 / max(shadowing + masking, 1e-6);
    return lobe;
}

// The light that the surface sends to the camera of a light with this volume (relative to the camera) and intensity.
vec3 light_radiance(Surface surface, vec3 center, float range, vec3 intensity) {
    precise vec3 to_light = center - surface.position;
    precise vec3 direction = safe_normalize(to_light, surface.normal);
    precise float cos_light = clamp(dot_product(surface.normal, direction), 0.0, 1.0);
    if (!(cos_light > 0.0)) return vec3(0.0);
    precise vec3 halfway = safe_normalize(direction + surface.view, surface.normal);
    precise float cos_half = clamp(dot_product(surface.normal, halfway), 0.0, 1.0);
    precise float grazing = pow(1.0 - clamp(dot_product(direction, halfway), 0.0, 1.0), 5.0); // Schlick 1994
    precise vec3 fresnel = surface.specular + (vec3(1.0) - surface.specular) * grazing;
    precise vec3 reflection = surface.diffuse * (vec3(1.0) - fresnel) / kPi +
                      fresnel * specular_lobe(surface.alpha, cos_half, cos_light, surface.cos_view);
    precise vec3 irradiance = intensity * (light_falloff(dot_product(to_light, to_light), range) * cos_light);
    precise vec3 radiance = reflection * irradiance;
    return clamp(radiance, vec3(0.0), vec3(kBrightest));
}

#endif
