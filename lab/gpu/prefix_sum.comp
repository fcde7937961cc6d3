#version 450
// Exclusive prefix sums of blocks: 2048 words each, one workgroup per block, and the sum of each block.
layout(local_size_x = 256) in;

layout(std430, set = 0, binding = 0) readonly buffer Source { uint d[]; } source; // may be the target's buffer
layout(std430, set = 0, binding = 1) writeonly buffer Target { uint d[]; } target;
layout(std430, set = 0, binding = 2) writeonly buffer BlockSums { uint d[]; } block_sums;
layout(push_constant) uniform Push { uint count; };

const uint kLanes = 256u;
const uint kWordsPerLane = 8u; // see kWordsPerBlock

shared uint words[kLanes * kWordsPerLane];
shared uint sums[kLanes];

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

// Neighbouring lanes read and write neighbouring words; in between a lane sums words in a row.
void main() {
    uint lane = gl_LocalInvocationIndex;
    uint first = gl_WorkGroupID.x * kLanes * kWordsPerLane;
    for (uint i = lane; i < kLanes * kWordsPerLane; i += kLanes)
        words[i] = first + i < count ? source.d[first + i] : 0u;
    barrier();
    uint sum = 0u;
    for (uint i = lane * kWordsPerLane; i < (lane + 1u) * kWordsPerLane; ++i) sum += words[i];
    sums[lane] = sum;
    sum_lanes(lane);
    sum = lane == 0u ? 0u : sums[lane - 1u];
    for (uint i = lane * kWordsPerLane; i < (lane + 1u) * kWordsPerLane; ++i) {
        uint word = words[i];
        words[i] = sum;
        sum += word;
    }
    barrier();
    for (uint i = lane; i < kLanes * kWordsPerLane; i += kLanes)
        if (first + i < count) target.d[first + i] = words[i];
    if (lane == kLanes - 1u) block_sums.d[gl_WorkGroupID.x] = sum;
}
