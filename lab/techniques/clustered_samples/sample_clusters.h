#pragma once
// The clusters of a view's samples, built on the device: the cells of tiles, depth slices and parts of all directions
// that have samples, the cluster of each sample, and the clusters' bounds.

#include "lab/techniques/clustered_samples/unique_keys.h"

namespace manylights::lab {

enum class UniqueBy { sort, page_table, bitmap };

struct ClusterOptions {
    std::uint32_t tile_size = 32;
    UniqueBy unique = UniqueBy::sort;
    bool has_normals = false;
    bool is_explicit = false; ///< bounds of the samples instead of the cells'
};

class SampleClusters {
  public:
    SampleClusters(gpu::Device& device, const ClusterOptions& options);

    /// Finds them and waits; the device's time in milliseconds. Throws InputError where there are too many keys.
    double find(const Frame& frame, const DeviceView& view);

    std::uint32_t count() const { return keys_->count(); }
    const gpu::Buffer& ids() const { return keys_->ids(); } ///< a word for each pixel, unused where it is sky
    const gpu::Buffer& clusters() const { return clusters_.buffer(); } ///< Cluster of cluster.glsl each

  private:
    double bound(const Frame& frame);

    gpu::Device& device_;
    ClusterOptions options_;
    SampleGrid grid_;
    std::unique_ptr<UniqueKeys> keys_;
    std::optional<gpu::ComputePipeline> members_pipeline_;
    gpu::ComputePipeline bounds_pipeline_;
    FittedBuffer clusters_, extents_;
};

} // namespace manylights::lab
