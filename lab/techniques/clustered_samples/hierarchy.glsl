// The light hierarchy as shaders read it: light_hierarchy.h says what it is.
#ifndef MANYLIGHTS_LAB_LIGHT_HIERARCHY_GLSL
#define MANYLIGHTS_LAB_LIGHT_HIERARCHY_GLSL

#include "lab/techniques/device/device_view.glsl"

const uint kMaxLevels = 12u;

// The text of HierarchyShape in light_hierarchy.cpp.
struct HierarchyShape {
    DeviceView view;
    uint fan_out;
    uint level_count; // level 0: the lights
    uint unused_a, unused_b;
    uvec2 levels[kMaxLevels]; // first node, count of nodes; of level 0: 0, count of lights
};

// In the camera's axes. 32 bytes.
struct Box {
    vec4 low, high; // w unused
};

// in_view makes this radius of what is so far or so large that it counts as being everywhere.
bool is_everywhere(vec4 sphere) { return sphere.w >= 1e18; }

// What comparisons with a sphere may be off by: turning a point or a centre into the camera's axes moves it by less than
// 4 * 2^-24 of its distance, the faces of a cell and the squares of a distance are off by less than 2^-21 of theirs, and
// no point of the sphere is farther than |c| + r.
float sphere_slack(vec4 sphere) {
    return 2e-6 * (abs(sphere.x) + abs(sphere.y) + abs(sphere.z) + sphere.w);
}

Box box_of_sphere(vec4 sphere) {
    float reach = is_everywhere(sphere) ? kFarthest : sphere.w + sphere_slack(sphere);
    return Box(vec4(sphere.xyz - reach, 0.0), vec4(sphere.xyz + reach, 0.0));
}

bool boxes_meet(Box a, Box b) {
    return all(lessThanEqual(a.low.xyz, b.high.xyz)) && all(lessThanEqual(b.low.xyz, a.high.xyz));
}

bool sphere_meets_box(vec4 sphere, Box box) {
    vec3 offset = clamp(sphere.xyz, box.low.xyz, box.high.xyz) - sphere.xyz;
    float reach = sphere.w + sphere_slack(sphere);
    return is_everywhere(sphere) || dot(offset, offset) <= reach * reach;
}

// Floats as words in the same order, above 0; so a maximum by atomicMax begins with 0.
uint ordered_word(float value) {
    uint bits = floatBitsToUint(value);
    return bits ^ ((bits >> 31u) != 0u ? 0xFFFFFFFFu : 0x80000000u);
}

float value_of_ordered(uint word) {
    return uintBitsToFloat(word ^ ((word >> 31u) != 0u ? 0x80000000u : 0xFFFFFFFFu));
}

#endif
