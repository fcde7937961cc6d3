#pragma once
// How the inside of the library says what went wrong: static texts and an index, nothing allocated.

#include "manylights/manylights.h"

#include <cstdint>

namespace manylights::detail {

struct Outcome {
    ManylightsStatus status = MANYLIGHTS_OK;
    const char* field = "";
    const char* rule = "";
    std::uint64_t index = 0;

    [[nodiscard]] bool ok() const { return status == MANYLIGHTS_OK; }
};

inline Outcome invalid(const char* field, const char* rule, std::uint64_t index = 0) {
    return {MANYLIGHTS_INVALID_ARGUMENT, field, rule, index};
}

inline Outcome out_of_memory(const char* what) {
    return {MANYLIGHTS_OUT_OF_MEMORY, what, "the allocator must return memory", 0};
}

inline ManylightsStatus hand_out(const Outcome& outcome, ManylightsReport* report) {
    if (report != nullptr) *report = {outcome.status, outcome.field, outcome.rule, outcome.index};
    return outcome.status;
}

} // namespace manylights::detail
