// What shading one pixel found: the same text as PixelRecord in technique.h, 64 bytes.
#ifndef MANYLIGHTS_LAB_RECORD_GLSL
#define MANYLIGHTS_LAB_RECORD_GLSL

#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "reference/oracle/light_hash.h"

struct PixelRecord {
    uint affecting, hash_a, hash_b;
    uint front, front_hash_a, front_hash_b;
    uint tested, nodes, references;
    uint shaded;
    int64_t radiance[3];
};

// Radiance in units of 2^-20. Each contribution is rounded down by itself and clamped to [0, 2^20], so that the sum does
// not depend on the order and cannot overflow below 2^23 lights.
void add_radiance(inout PixelRecord record, vec3 radiance) {
    precise vec3 units = clamp(radiance, vec3(0.0), vec3(1048576.0)) * 1048576.0;
    record.radiance[0] += int64_t(units.x);
    record.radiance[1] += int64_t(units.y);
    record.radiance[2] += int64_t(units.z);
}

void add_light(inout PixelRecord record, uint light, bool is_front, vec3 radiance) {
    uint hash_a = light_hash_a(light);
    uint hash_b = light_hash_b(light);
    record.affecting += 1u;
    record.hash_a += hash_a;
    record.hash_b += hash_b;
    if (is_front) {
        record.front += 1u;
        record.front_hash_a += hash_a;
        record.front_hash_b += hash_b;
    }
    add_radiance(record, radiance);
}

PixelRecord empty_record() {
    return PixelRecord(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, int64_t[3](int64_t(0), int64_t(0), int64_t(0)));
}

#endif
