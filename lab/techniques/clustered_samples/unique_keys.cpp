#include "lab/techniques/clustered_samples/unique_keys.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

namespace manylights::lab {

namespace {

constexpr std::uint64_t kWord = sizeof(std::uint32_t);
constexpr std::uint64_t kMostKeys = std::uint64_t{1} << 32;

} // namespace

UniqueKeys::UniqueKeys(gpu::Device& device)
    : device_(device), prefix_sum_(device), ids_(device, "clusters of samples"), keys_(device, "keys of clusters"),
      total_(device, "number of keys") {}

void UniqueKeys::begin(const Frame& frame, const SampleGrid& grid, const char* way) {
    if (grid.keys() > kMostKeys) refuse(grid, way, kMostKeys, "");
    ids_.fit(kWord * frame.width * frame.height);
    total_.fit(kWord);
}

void UniqueKeys::count_keys() {
    count_ = total();
    keys_.fit(kWord * count_);
}

void UniqueKeys::refuse(const SampleGrid& grid, const char* way, std::uint64_t most, const char* of) {
    throw InputError(fmt::format("clustered_samples: unique={} has room for {} keys{}, and {} have more; use larger "
                                 "tiles or smaller images",
                                 way, most, of, grid.text()));
}

} // namespace manylights::lab
