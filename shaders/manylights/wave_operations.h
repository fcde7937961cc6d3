// What a wave does together, for query_wave.h: by the language's own operations, or emulated in workgroup memory.
// There, every operation is a barrier or two of the whole workgroup.
#if defined(__cplusplus)
#define ml_lowest_bit(bits) MlUint(std::countr_zero(bits))
#elif !defined(ML_HLSL) && (defined(GL_core_profile) || defined(GL_ES))
#define ml_lowest_bit(bits) uint(findLSB(bits))
#else
#define ml_lowest_bit(bits) firstbitlow(bits)
#endif

#if defined(ML_WAVE_EMULATED)

#if !defined(ML_WAVE_BARRIER)
#if defined(ML_HLSL) || !(defined(GL_core_profile) || defined(GL_ES))
#define ML_WAVE_BARRIER() GroupMemoryBarrierWithGroupSync()
#else
#define ML_WAVE_BARRIER() barrier()
#endif
#endif
#define ML_WAVE_LANE (ML_WAVE_INDEX % ML_WAVE_SIZE)

// The value of each lane of the wave in ML_WAVE_SHARED(ml_wave_place()) and behind it, until the next barrier.
ML_FN MlUint ml_wave_place() { return ML_WAVE_INDEX - ML_WAVE_LANE; }
ML_FN void ml_wave_publish(MlUint value) {
    ML_WAVE_BARRIER();
    ML_WAVE_SHARED(ML_WAVE_INDEX) = value;
    ML_WAVE_BARRIER();
}

ML_FN MlUint ml_wave_min(MlUint value) {
    ml_wave_publish(value);
    MlUint least = value;
    for (MlUint i = 0u; i < ML_WAVE_SIZE; ++i) {
        MlUint other = ML_WAVE_SHARED(ml_wave_place() + i);
        least = other < least ? other : least;
    }
    return least;
}

ML_FN MlUint ml_wave_or(MlUint value) {
    ml_wave_publish(value);
    MlUint all = 0u;
    for (MlUint i = 0u; i < ML_WAVE_SIZE; ++i) all |= ML_WAVE_SHARED(ml_wave_place() + i);
    return all;
}

// Bit i of the first word is lane i's, of the second lane 32 + i's.
ML_FN void ml_wave_ballot(bool vote, ML_OUT(MlUint) low, ML_OUT(MlUint) high) {
    ml_wave_publish(vote ? 1u : 0u);
    low = high = 0u;
    for (MlUint i = 0u; i < ML_WAVE_SIZE; ++i) {
        MlUint bit = ML_WAVE_SHARED(ml_wave_place() + i) << (i & 31u);
        if (i < 32u)
            low |= bit;
        else
            high |= bit;
    }
}

// Of all waves that must go the same way through the barriers.
ML_FN bool ml_wave_group_any(bool vote) {
    ml_wave_publish(vote ? 1u : 0u);
    MlUint all = 0u;
    for (MlUint i = 0u; i < ML_WAVE_GROUP_SIZE; ++i) all |= ML_WAVE_SHARED(i);
    return all != 0u;
}

#elif !defined(ML_HLSL) && (defined(GL_core_profile) || defined(GL_ES))

#define ML_WAVE_SIZE gl_SubgroupSize
#define ML_WAVE_LANE gl_SubgroupInvocationID
#define ml_wave_min(value) subgroupMin(value)
#define ml_wave_or(value) subgroupOr(value)
#define ml_wave_group_any(vote) (vote)
void ml_wave_ballot(bool vote, out uint low, out uint high) {
    uvec4 votes = subgroupBallot(vote);
    low = votes.x;
    high = votes.y;
}

#else

#define ML_WAVE_SIZE WaveGetLaneCount()
#define ML_WAVE_LANE WaveGetLaneIndex()
#define ml_wave_min(value) WaveActiveMin(value)
#define ml_wave_or(value) WaveActiveBitOr(value)
#define ml_wave_group_any(vote) (vote)
void ml_wave_ballot(bool vote, out uint low, out uint high) {
    uint4 votes = WaveActiveBallot(vote);
    low = votes.x;
    high = votes.y;
}

#endif
