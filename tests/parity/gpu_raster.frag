#version 460
// Counts its fragments per pixel, and hands out what tells the order of instances: 1, 2^24, 2^-24, 1, ...
layout(early_fragment_tests) in; // or fragments that fail them are counted as well
layout(std430, set = 0, binding = 1) buffer Counts { uint d[]; } counts;
layout(push_constant) uniform Push {
    vec2 size;
    float depth;
};
layout(location = 0) flat in uint instance;
layout(location = 0) out vec4 color;

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    atomicAdd(counts.d[pixel.y * uint(size.x) + pixel.x], 1u);
    color = vec4(exp2(instance % 3u == 0u ? 0.0 : instance % 3u == 1u ? 24.0 : -24.0));
}
