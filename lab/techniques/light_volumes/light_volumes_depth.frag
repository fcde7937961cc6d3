#version 460
// The depths of the points as a depth attachment has them: near / depth, and 0 for the sky.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/light_volumes/volumes.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 d[]; } positions;

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    float depth = positions.d[pixel.y * view.size.x + pixel.x].w;
    gl_FragDepth = depth > 0.0 ? min(view.forward.w / depth, 1.0) : 0.0;
}
