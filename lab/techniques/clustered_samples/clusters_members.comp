#version 460
// What the samples of each cluster extend to, as ordered words: the greatest of each coordinate in the camera's axes and
// of its negative, and of the negative cosine between a normal and the middle of its patch.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/hierarchy.glsl"
#include "lab/techniques/clustered_samples/samples.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, set = 0, binding = 3) readonly buffer Ids { uint d[]; } ids;
layout(std430, set = 0, binding = 4) buffer Extents { uint d[]; } extents; // eight words of each cluster, the last unused

void extend(uint word, float value) {
    uint ordered = ordered_word(value);
    if (extents.d[word] < ordered) atomicMax(extents.d[word], ordered);
}

void main() {
    ViewSample found = sample_at(gl_GlobalInvocationID.xy);
    if (!found.is_shaded) return;
    uint first = 8u * ids.d[found.index];
    vec3 position = vec3(dot(view.right.xyz, found.position.xyz), dot(view.down.xyz, found.position.xyz),
                         dot(view.forward.xyz, found.position.xyz));
    for (uint axis = 0u; axis < 3u; ++axis) {
        extend(first + axis, -position[axis]);
        extend(first + 3u + axis, position[axis]);
    }
    if (patch_count == 1u) return;
    vec3 normal = normals.d[found.index].normal;
    uint number = patch_of(normal);
    if (number == kNoPatch) return;
    extend(first + 6u, -dot(unit_normal(normal), patch_direction(number, vec2(0.5))));
}
