#version 460
// As gpu_raster.frag, where there is no image.
layout(early_fragment_tests) in; // or fragments that fail them are counted as well
layout(std430, set = 0, binding = 1) buffer Counts { uint d[]; } counts;
layout(push_constant) uniform Push {
    vec2 size;
    float depth;
};
layout(location = 0) flat in uint instance;

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    atomicAdd(counts.d[pixel.y * uint(size.x) + pixel.x], 1u);
}
