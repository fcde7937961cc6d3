// Shading by linked lists: the links of the pixel's texel, and of these the lights whose depths hold the point's.
#include "lab/techniques/device/tile_grid.glsl"
#include "lab/techniques/device/visible_light.glsl"
#include "lab/techniques/light_linked_list/light_links.glsl"
#include "lab/techniques/shading_pass.glsl"

layout(std430, set = 0, binding = 6) readonly buffer Header {
    TileGrid grid; // of texels
    uint link_words;
}
header;
layout(std430, set = 0, binding = 7) readonly buffer Heads { uint d[]; }
heads;
layout(std430, set = 0, binding = 8) readonly buffer Pool { uint d[]; }
pool;
layout(std430, set = 0, binding = 9) readonly buffer Lights { VisibleLight d[]; }
lights; // by rank

struct Link {
    float low, high;
    uint light, next;
};

Link read_link(uint link) {
    uint at = link * header.link_words;
    Link read;
    if (header.link_words == 4u) {
        read.low = uintBitsToFloat(pool.d[at]);
        read.high = uintBitsToFloat(pool.d[at + 1u]);
    } else {
        read.low = depth_of_half(pool.d[at] >> 16u);
        read.high = depth_of_half(pool.d[at] & 0xFFFFu);
    }
    uint last = pool.d[at + header.link_words - 1u];
    if (header.link_words == 2u) {
        read.light = lights.d[last >> 24u].index;
        read.next = last & kNoShortLink;
        if (read.next == kNoShortLink) read.next = kNoLink;
    } else {
        read.light = pool.d[at + header.link_words - 2u];
        read.next = last;
    }
    return read;
}

void test_light(inout Pixel pixel, uint light) {
    touch_light(light);
#if defined(MANYLIGHTS_RECORD)
    pixel.record.tested += 1u;
#endif
    vec4 sphere = spheres.d[light];
    if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
}

void walk(inout Pixel pixel) {
    uint list = tile_index(header.grid, pixel.coordinates / header.grid.tile_size);
    touch_node(list / 4u);
#if defined(MANYLIGHTS_RECORD)
    pixel.record.nodes += 1u;
#endif
    for (uint at = heads.d[list]; at != kNoLink;) {
        Link link = read_link(at);
        touch_check(at);
#if defined(MANYLIGHTS_RECORD)
        pixel.record.references += 1u;
#endif
        if (pixel.depth >= link.low && pixel.depth <= link.high) test_light(pixel, link.light);
        at = link.next;
    }
}

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) walk(pixel);
    end_pixel(pixel);
}
