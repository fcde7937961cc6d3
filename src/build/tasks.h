#pragma once
// Work on the caller's threads.

#include "src/build/settings.h"

#include <algorithm>
#include <cstdint>

namespace manylights::detail {

// How many tasks do this work best, if each should have so much of it at least. No result may depend on it.
inline std::uint32_t task_count_for(const Settings& settings, std::uint64_t work, std::uint64_t least_per_task) {
    if (settings.parallel_for == nullptr) return 1;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(work / least_per_task, 1, settings.max_workers));
}

// The part of [0, count) that belongs to a task: contiguous, and ascending with the task.
struct Part {
    std::uint64_t begin, end;
};
inline Part part_of(std::uint64_t count, std::uint32_t task, std::uint32_t task_count) {
    return {count * task / task_count, count * (task + 1) / task_count};
}

// The least i in [0, count] with before(i) >= target, where before ascends: cuts work into parts of equal size.
template <typename Before>
std::uint64_t first_with(std::uint64_t count, std::uint64_t target, const Before& before) {
    std::uint64_t low = 0;
    std::uint64_t high = count;
    while (low < high) {
        const std::uint64_t middle = (low + high) / 2;
        if (before(middle) < target)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// Calls body(task) for each task.
template <typename Body>
void run_tasks(const Settings& settings, std::uint32_t count, const Body& body) {
    if (count == 1) return body(0u);
    const auto call = [](void* context, std::uint32_t task) { (*static_cast<const Body*>(context))(task); };
    settings.parallel_for(settings.parallel_user, count, call, const_cast<Body*>(&body));
}

} // namespace manylights::detail
