// Shading by linked lists: the links of the pixel's texel, and of these the lights whose depths hold the point's.
#include "lab/techniques/device/tile_grid.glsl"
#include "lab/techniques/device/visible_light.glsl"
#define POOL_BINDING 9
#define POOL_ACCESS readonly
#include "lab/techniques/light_linked_list/light_links.glsl"
#include "lab/techniques/shading_pass.glsl"

layout(std430, set = 0, binding = 6) readonly buffer Header {
    TileGrid grid; // of texels
    uint link_words;
}
header;
layout(std430, set = 0, binding = 7) readonly buffer Heads { uint d[]; }
heads;
layout(std430, set = 0, binding = 8) readonly buffer Lights { VisibleLight d[]; }
lights; // by rank

struct Link {
    float low, high;
    uint light, next;
};

uint read_word(uint page, uint at) {
    if (page == 0u) return pool0.d[at];
    if (page == 1u) return pool1.d[at];
    if (page == 2u) return pool2.d[at];
    if (page == 3u) return pool3.d[at];
    if (page == 4u) return pool4.d[at];
    if (page == 5u) return pool5.d[at];
    if (page == 6u) return pool6.d[at];
    return pool7.d[at];
}

void read_depths(inout Link link, uint page, uint at) {
    uint word = read_word(page, at);
    if (header.link_words == 4u) {
        link.low = uintBitsToFloat(word);
        link.high = uintBitsToFloat(read_word(page, at + 1u));
    } else {
        link.low = depth_of_half(word >> 16u);
        link.high = depth_of_half(word & 0xFFFFu);
    }
}

Link read_link(uint number) {
    uint page = number >> kPageBits, at = first_word(number, header.link_words);
    Link link;
    read_depths(link, page, at);
    uint last = read_word(page, at + header.link_words - 1u);
    if (header.link_words == 2u) {
        link.light = lights.d[last >> 24u].index;
        link.next = last & kNoShortLink;
        if (link.next == kNoShortLink) link.next = kNoLink;
    } else {
        link.light = read_word(page, at + header.link_words - 2u);
        link.next = last;
    }
    return link;
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
    uint list = tile_index(header.grid, tile_of(header.grid, pixel.coordinates));
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
