// Where a key's bit is: at the key itself, or behind the page that its upper bits were given. A set of bits with the
// number of those before each word says how many of them are before a bit.
#ifndef MANYLIGHTS_LAB_SLOTS_GLSL
#define MANYLIGHTS_LAB_SLOTS_GLSL

layout(constant_id = 0) const bool kIsPaged = false;
const uint kPageBits = 10u;

layout(std430, set = 0, binding = 3) readonly buffer Pages { uint d[]; } pages; // in use; only where paged
layout(std430, set = 0, binding = 4) readonly buffer PagePlaces { uint d[]; } page_places;

uint bits_below(uint word, uint bit) { return bitCount(word & ((1u << (bit & 31u)) - 1u)); }

uint slot_of(uint key) {
    if (!kIsPaged) return key;
    uint page = key >> kPageBits;
    uint place = page_places.d[page >> 5u] + bits_below(pages.d[page >> 5u], page);
    return place << kPageBits | (key & ((1u << kPageBits) - 1u));
}

#endif
