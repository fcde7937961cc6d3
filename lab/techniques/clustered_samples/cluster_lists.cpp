#include "lab/techniques/clustered_samples/cluster_lists.h"

#include "lab/gpu/device.h"
#include "lab/scene/error.h"
#include "lab/techniques/device/spread.h"

#include <fmt/format.h>

#include <limits>
#include <numeric>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kAssignCode[] =
#include "clusters_assign.comp.inc"
    ;

constexpr std::uint64_t kWord = sizeof(std::uint32_t), kRangeBytes = 2 * kWord;

// Sums on the device are modulo 2^32. Where they cannot get there, nobody need look.
void check_sum(const gpu::Buffer& counts, std::uint64_t clusters, std::uint64_t lights) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (clusters * lights <= most) return;
    const std::vector<std::uint32_t> words = counts.download<std::uint32_t>();
    const std::uint64_t sum = std::accumulate(words.begin(), words.end(), std::uint64_t{0});
    if (sum > most)
        throw InputError(fmt::format("clustered_samples: {} references of {} clusters; at most {} can be stored", sum,
                                     clusters, most));
}

} // namespace

ClusterLists::ClusterLists(gpu::Device& device)
    : device_(device), prefix_sum_(device),
      count_pipeline_(device, {"clusters, counts of lights", kAssignCode, 8, kWord, {0}}),
      write_pipeline_(device, {"clusters, lights", kAssignCode, 8, kWord, {1}}),
      counts_(device, "lights of each cluster"), places_(device, "places of lists"),
      total_(device, "number of references"), ranges_(device, "lists of clusters"),
      references_(device, "lights of clusters") {}

double ClusterLists::find(const LightHierarchy& hierarchy, const SampleClusters& clusters) {
    counts_.fit(kWord * clusters.count());
    places_.fit(kWord * clusters.count());
    total_.fit(kWord);
    ranges_.fit(kRangeBytes * clusters.count());
    references_.fit(0);
    prefix_sum_.reserve(clusters.count());
    const double count_ms = count(hierarchy, clusters);
    check_sum(counts_.buffer(), clusters.count(), hierarchy.light_count());
    references_.fit(kWord * total_.buffer().download<std::uint32_t>(1).front());
    return count_ms + write(hierarchy, clusters);
}

double ClusterLists::count(const LightHierarchy& hierarchy, const SampleClusters& clusters) {
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    dispatch(commands, count_pipeline_, hierarchy, clusters);
    prefix_sum_.record(commands, counts_.buffer(), places_.buffer(), clusters.count(), total_.buffer());
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("counting the lights of clusters");
    return commands.milliseconds(start, end);
}

double ClusterLists::write(const LightHierarchy& hierarchy, const SampleClusters& clusters) {
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    dispatch(commands, write_pipeline_, hierarchy, clusters);
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("writing the lights of clusters");
    return commands.milliseconds(start, end);
}

void ClusterLists::dispatch(gpu::Commands& commands, const gpu::ComputePipeline& pipeline,
                            const LightHierarchy& hierarchy, const SampleClusters& clusters) {
    const gpu::Buffer& words = &pipeline == &count_pipeline_ ? counts_.buffer() : places_.buffer();
    commands.dispatch(pipeline,
                      {{hierarchy.shape()},
                       {hierarchy.nodes()},
                       {hierarchy.spheres()},
                       {clusters.clusters()},
                       {words},
                       {hierarchy.indices()},
                       {ranges()},
                       {references()}},
                      clusters.count(), spread_groups(clusters.count()));
}

} // namespace manylights::lab
