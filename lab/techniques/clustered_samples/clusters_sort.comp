#version 460
// The keys of a tile's samples, each once and in order, and which of them each sample has. One workgroup per tile: its
// keys are sorted in workgroup memory, together with the number of the sample.
#extension GL_GOOGLE_include_directive : require
#include "lab/techniques/clustered_samples/samples.glsl"

layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 3) writeonly buffer Ids { uint d[]; } ids;           // within the tile
layout(std430, set = 0, binding = 4) writeonly buffer TileKeys { uint d[]; } tile_keys; // room for each sample's
layout(std430, set = 0, binding = 5) writeonly buffer Counts { uint d[]; } counts;      // of keys of each tile

const uint kLanes = 256u;
const uint kMostSamples = 1024u;
const uint kSampleBits = 10u;
const uint kNoKey = 0xFFFFFFFFu >> kSampleBits; // of sky: behind all keys

shared uint words[kMostSamples]; // key, and the sample in the lower bits
shared uint sums[kLanes];

uvec2 pixel_of(uint number) { return gl_WorkGroupID.xy * tile_size + uvec2(number % tile_size, number / tile_size); }

void load(uint count) {
    for (uint i = gl_LocalInvocationIndex; i < count; i += kLanes) {
        ViewSample found = sample_at(pixel_of(i));
        words[i] = (found.is_shaded ? local_key(found) : kNoKey) << kSampleBits | i;
    }
}

// Bitonic; count is a power of two.
void sort(uint count) {
    for (uint size = 2u; size <= count; size *= 2u) {
        for (uint step = size / 2u; step > 0u; step /= 2u) {
            barrier();
            for (uint i = gl_LocalInvocationIndex; i < count / 2u; i += kLanes) {
                uint low = (i & ~(step - 1u)) * 2u + (i & (step - 1u));
                uint a = words[low], b = words[low + step];
                bool is_ascending = (low & size) == 0u;
                words[low] = is_ascending ? min(a, b) : max(a, b);
                words[low + step] = is_ascending ? max(a, b) : min(a, b);
            }
        }
    }
    barrier();
}

bool is_first_of_key(uint i) {
    uint key = words[i] >> kSampleBits;
    return key != kNoKey && (i == 0u || words[i - 1u] >> kSampleBits != key);
}

// In doubling steps; afterwards sums[i] is the sum of the lanes before i and of lane i.
void sum_lanes(uint lane) {
    for (uint step = 1u; step < kLanes; step *= 2u) {
        barrier();
        uint sum = sums[lane] + (lane >= step ? sums[lane - step] : 0u);
        barrier();
        sums[lane] = sum;
    }
    barrier();
}

void main() {
    uint lane = gl_LocalInvocationIndex, count = tile_size * tile_size;
    uint tile = gl_WorkGroupID.y * tiles_x + gl_WorkGroupID.x;
    load(count);
    sort(count);
    uint per_lane = count / kLanes, begin = lane * per_lane;
    uint sum = 0u;
    for (uint i = begin; i < begin + per_lane; ++i) sum += is_first_of_key(i) ? 1u : 0u;
    sums[lane] = sum;
    sum_lanes(lane);
    uint rank = lane == 0u ? 0u : sums[lane - 1u]; // of the next key
    for (uint i = begin; i < begin + per_lane; ++i) {
        uint key = words[i] >> kSampleBits;
        if (is_first_of_key(i)) tile_keys.d[tile * count + rank++] = key;
        uvec2 pixel = pixel_of(words[i] & (kMostSamples - 1u));
        if (key != kNoKey) ids.d[pixel.y * view.size.x + pixel.x] = rank - 1u;
    }
    if (lane == kLanes - 1u) counts.d[tile] = sums[lane];
}
