#version 460
#extension GL_GOOGLE_include_directive : require
#define MANYLIGHTS_LOG
#include "lab/techniques/shading_pass.glsl"

// Touches what no technique does yet, and, where the buffer says so, what no technique may.
layout(std430, set = 0, binding = 6) readonly buffer Faults { uint more_when_written, index; }
faults;

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) {
        touch_check(faults.index + pixel.coordinates.x);
        touch_batch(pixel.coordinates.y / 4u);
        touch_node(2u * (pixel.coordinates.x / 2u)); // a wide node for two columns
        touch_node(2u * (pixel.coordinates.x / 2u) + 1u);
        if (faults.more_when_written != 0u && log_end > 0u) touch_light(0u);
    }
    end_pixel(pixel);
}
