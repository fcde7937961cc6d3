#include "src/build/settings.h"

#include "src/format/layout.h"

#include <cstdlib>
#include <limits>

namespace manylights::detail {

namespace {

void* allocate_with_malloc(void*, std::size_t bytes, std::size_t) { return std::malloc(bytes); }
void release_with_free(void*, void* memory, std::size_t) { std::free(memory); }

template <typename T>
T or_default(T value, T fallback) {
    return value != T{} ? value : fallback;
}

bool positive_or_zero(float value) { return value >= 0.0f && value <= std::numeric_limits<float>::max(); }

Outcome check_ranges(const ManylightsSettings& given) {
    if (given.size < sizeof(ManylightsSettings)) return invalid("settings.size", "must be sizeof(ManylightsSettings)");
    if (given.structure > MANYLIGHTS_STRUCTURE_WINDOWS)
        return invalid("settings.structure", "must be a ManylightsStructure");
    if (given.tile_px != 0 && (given.tile_px < 8 || given.tile_px > kMaxPixels))
        return invalid("settings.tile_px", "must be 0 or in [8, 65536]");
    if (given.slice_count > kMaxSlices) return invalid("settings.slice_count", "must be at most 128");
    if (given.leaf_size > kMaxLeafLights) return invalid("settings.leaf_size", "must be at most 65535");
    if (!positive_or_zero(given.slice_near)) return invalid("settings.slice_near", "must be finite and positive, or 0");
    if (!positive_or_zero(given.slice_far)) return invalid("settings.slice_far", "must be finite and positive, or 0");
    if (given.max_workers > kMaxWorkers) return invalid("settings.max_workers", "must be at most 1024");
    if (given.allocate == nullptr && given.release != nullptr)
        return invalid("settings.allocate", "must be set where release is");
    if (given.allocate != nullptr && given.release == nullptr)
        return invalid("settings.release", "must be set where allocate is");
    return {};
}

} // namespace

Outcome resolve_settings(const ManylightsSettings* given, Settings& settings) {
    ManylightsSettings all_defaults{};
    all_defaults.size = sizeof(all_defaults);
    if (given == nullptr) given = &all_defaults;
    if (Outcome outcome = check_ranges(*given); !outcome.ok()) return outcome;

    settings.structure = or_default<std::uint32_t>(given->structure, MANYLIGHTS_STRUCTURE_WINDOWS);
    const bool windows = settings.structure == MANYLIGHTS_STRUCTURE_WINDOWS;
    settings.tile_px = or_default(given->tile_px, windows ? 0u : 48u);
    settings.slice_count = or_default(given->slice_count, 16u);
    if (windows || settings.structure == MANYLIGHTS_STRUCTURE_TREES) settings.slice_count = 1;
    settings.leaf_size = or_default(given->leaf_size, 4u);
    settings.slice_near = or_default(given->slice_near, 5.0f);
    settings.slice_far = or_default(given->slice_far, 500.0f);
    if (!(settings.slice_far > settings.slice_near))
        return invalid("settings.slice_far", "must be greater than slice_near (defaults: 500 and 5)");
    settings.max_workers = or_default(given->max_workers, 64u);
    settings.max_bytes = given->max_bytes != 0 ? given->max_bytes : std::numeric_limits<std::uint64_t>::max();
    settings.allocator = {given->allocate, given->release, given->allocator_user};
    if (given->allocate == nullptr) settings.allocator = {allocate_with_malloc, release_with_free, nullptr};
    settings.parallel_for = given->parallel_for;
    settings.parallel_user = given->parallel_user;
    return {};
}

} // namespace manylights::detail
