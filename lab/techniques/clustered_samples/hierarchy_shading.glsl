// Each pixel goes down the light hierarchy by itself: any point can, on a surface or not.
#include "lab/techniques/shading_pass.glsl"

#include "lab/techniques/clustered_samples/hierarchy.glsl"

layout(std430, set = 0, binding = 6) readonly buffer Shapes { HierarchyShape d[]; }
shapes;
layout(std430, set = 0, binding = 7) readonly buffer Nodes { Box d[]; }
nodes;
layout(std430, set = 0, binding = 8) readonly buffer Indices { uint d[]; }
indices; // of the lights, in the order of the hierarchy

// The pixel's point in the camera's axes, as the boxes are.
vec3 point_in_view(vec3 position) {
    DeviceView view = shapes.d[0].view;
    return vec3(dot(view.right.xyz, position), dot(view.down.xyz, position), dot(view.forward.xyz, position));
}

// A node is 32 bytes, two units.
bool enters(inout Pixel pixel, uint node, vec3 point) {
    touch_node(2u * node);
    touch_node(2u * node + 1u);
#if defined(MANYLIGHTS_RECORD)
    pixel.record.nodes += 2u;
#endif
    Box box = nodes.d[node];
    return all(greaterThanEqual(point, box.low.xyz)) && all(lessThanEqual(point, box.high.xyz));
}

void test_lights(inout Pixel pixel, uint first, uint end) {
    for (uint i = first; i < end; i += 1u) {
        uint light = indices.d[i];
        touch_light(light);
        vec4 sphere = spheres.d[light];
        if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
    }
#if defined(MANYLIGHTS_RECORD)
    pixel.record.tested += end - first;
    pixel.record.references += end - first;
#endif
}

// Depth first, without a stack: behind the last child of a node comes the node behind it, a level up. Behind the last node
// of a level nothing is left.
void walk(inout Pixel pixel) {
    uint fan_out = shapes.d[0].fan_out, top = shapes.d[0].level_count - 1u;
    vec3 point = point_in_view(pixel.surface.position);
    if (top == 0u) test_lights(pixel, 0u, shapes.d[0].levels[0].y);
    uint level = top, node = 0u;
    while (level > 0u && node < shapes.d[0].levels[level].y) {
        bool is_entered = enters(pixel, shapes.d[0].levels[level].x + node, point);
        if (is_entered && level == 1u)
            test_lights(pixel, node * fan_out, min((node + 1u) * fan_out, shapes.d[0].levels[0].y));
        if (is_entered && level > 1u) {
            level -= 1u;
            node *= fan_out;
            continue;
        }
        node += 1u;
        while (level < top && node % fan_out == 0u) {
            level += 1u;
            node /= fan_out;
        }
    }
}

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) walk(pixel);
    end_pixel(pixel);
}
