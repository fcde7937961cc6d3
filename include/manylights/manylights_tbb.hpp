// Runs a builder's work on oneTBB: an adapter for ManylightsSettings.parallel_for. Needs oneTBB (target
// manylights::tbb); the library itself does not.
//
//     ManylightsSettings settings = manylights::make_settings();
//     manylights::use_tbb(settings);
#ifndef MANYLIGHTS_MANYLIGHTS_TBB_HPP
#define MANYLIGHTS_MANYLIGHTS_TBB_HPP

#include <manylights/manylights.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

namespace manylights {

// As ManylightsParallelFor; user is a tbb::task_arena, or null for the one that the calling thread is in. Tasks are
// large already: each is handed out alone.
inline void run_on_tbb(void* user, std::uint32_t count, ManylightsTask task, void* context) {
    const auto run = [=] {
        tbb::parallel_for(
            std::uint32_t{0}, count, [=](std::uint32_t i) { task(context, i); }, tbb::simple_partitioner());
    };
    if (user != nullptr)
        static_cast<tbb::task_arena*>(user)->execute(run);
    else
        run();
}

// Sets parallel_for, and as many tasks as there are threads: each costs its own lists of all tiles. Where threads are
// uneven, set max_workers to more. arena outlives the builder; null: see run_on_tbb.
inline void use_tbb(ManylightsSettings& settings, tbb::task_arena* arena = nullptr) {
    const int threads = arena != nullptr ? arena->max_concurrency() : tbb::this_task_arena::max_concurrency();
    settings.parallel_for = run_on_tbb;
    settings.parallel_user = arena;
    settings.max_workers = static_cast<std::uint32_t>(std::clamp(threads, 1, 1024));
}

} // namespace manylights

#endif
