#include "lab/techniques/clustered_samples/sample_clusters.h"

#include "lab/gpu/device.h"
#include "lab/techniques/device/spread.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kMembersCode[] =
#include "clusters_members.comp.inc"
    ;
constexpr std::uint32_t kBoundsCode[] =
#include "clusters_bounds.comp.inc"
    ;

constexpr std::uint32_t kClusterGroup = 64;
constexpr std::uint64_t kClusterBytes = 48, kExtentBytes = 32;

std::unique_ptr<UniqueKeys> make_keys(gpu::Device& device, UniqueBy unique) {
    if (unique == UniqueBy::sort) return make_keys_by_sort(device);
    return make_keys_by_bits(device, unique == UniqueBy::page_table);
}

} // namespace

SampleClusters::SampleClusters(gpu::Device& device, const ClusterOptions& options)
    : device_(device), options_(options), grid_(device), keys_(make_keys(device, options.unique)),
      bounds_pipeline_(device,
                       {"clusters, bounds", kBoundsCode, 6, sizeof(SamplesPush), {options.is_explicit ? 1u : 0u}}),
      clusters_(device, "clusters"), extents_(device, "extents of clusters") {
    if (options.is_explicit)
        members_pipeline_.emplace(device,
                                  gpu::ComputeShader{"clusters, members", kMembersCode, 5, sizeof(SamplesPush), {}});
}

double SampleClusters::find(const Frame& frame, const DeviceView& view) {
    grid_.lay_out(frame, view, options_.tile_size, options_.has_normals);
    const double keys_ms = keys_->find(frame, grid_);
    return keys_ms + bound(frame);
}

double SampleClusters::bound(const Frame& frame) {
    clusters_.fit(kClusterBytes * count());
    extents_.fit(options_.is_explicit ? kExtentBytes * count() : 0);
    SamplesPush push = grid_.push();
    push.cluster_count = count();
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    if (options_.is_explicit) {
        commands.fill(extents_.buffer(), 0);
        commands.barrier();
        commands.dispatch(*members_pipeline_, grid_.bindings(frame, {{ids()}, {extents_.buffer()}}), push,
                          grid_.groups_of_pixels());
        commands.barrier();
    }
    commands.dispatch(bounds_pipeline_, grid_.bindings(frame, {{keys_->keys()}, {extents_.buffer()}, {clusters()}}),
                      push, spread_groups(gpu::group_count(count(), kClusterGroup)));
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("bounding clusters");
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
