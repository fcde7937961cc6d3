#version 450
// Deals the pairs of a block out, in order: behind those of lesser digits, and of the same digit in earlier blocks.
layout(local_size_x = 256) in;

layout(std430, set = 0, binding = 0) readonly buffer Keys { uint d[]; } keys;
layout(std430, set = 0, binding = 1) readonly buffer Values { uint d[]; } values;
layout(std430, set = 0, binding = 2) readonly buffer Places { uint d[]; } places; // of each digit and block
layout(std430, set = 0, binding = 3) writeonly buffer SortedKeys { uint d[]; } sorted_keys;
layout(std430, set = 0, binding = 4) writeonly buffer SortedValues { uint d[]; } sorted_values;
layout(push_constant) uniform Push { uint count, shift; };

const uint kDigits = 16u;
const uint kLanes = 256u;
const uint kPairsPerLane = 4u; // in a row

// Per digit and lane: how many of the lane's keys have the digit; then how many of the lanes before.
shared uint before[kDigits * kLanes];
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

// Exclusive, over the lanes of one digit after those of the one before.
void sum_digits(uint lane) {
    barrier();
    uint sum = 0u;
    for (uint i = lane * kDigits; i < (lane + 1u) * kDigits; ++i) sum += before[i];
    sums[lane] = sum;
    sum_lanes(lane);
    sum = lane == 0u ? 0u : sums[lane - 1u];
    for (uint i = lane * kDigits; i < (lane + 1u) * kDigits; ++i) {
        uint next = sum + before[i];
        before[i] = sum;
        sum = next;
    }
    barrier();
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint first = (gl_WorkGroupID.x * kLanes + lane) * kPairsPerLane;
    uint end = min(first + kPairsPerLane, count);
    for (uint digit = 0u; digit < kDigits; ++digit) before[digit * kLanes + lane] = 0u;
    for (uint i = first; i < end; ++i) before[(keys.d[i] >> shift) % kDigits * kLanes + lane] += 1u;
    sum_digits(lane);
    if (lane < kDigits) sums[lane] = before[lane * kLanes]; // of the digit's first lane
    barrier();
    for (uint i = first; i < end; ++i) {
        uint key = keys.d[i];
        uint digit = (key >> shift) % kDigits;
        uint place = places.d[digit * gl_NumWorkGroups.x + gl_WorkGroupID.x] + before[digit * kLanes + lane] - sums[digit];
        before[digit * kLanes + lane] += 1u; // this lane's own column
        sorted_keys.d[place] = key;
        sorted_values.d[place] = values.d[i];
    }
}
