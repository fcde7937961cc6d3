#pragma once
// The lights of each cluster, found in the light hierarchy on the device: counted, laid out and written.

#include "lab/techniques/clustered_samples/light_hierarchy.h"
#include "lab/techniques/clustered_samples/sample_clusters.h"

namespace manylights::lab {

class ClusterLists {
  public:
    explicit ClusterLists(gpu::Device& device);

    /// Finds them and waits; the device's time in milliseconds. Throws InputError where there are 2^32 references or
    /// more.
    double find(const LightHierarchy& hierarchy, const SampleClusters& clusters);

    const gpu::Buffer& ranges() const { return ranges_.buffer(); }         ///< of each cluster: first and end
    const gpu::Buffer& references() const { return references_.buffer(); } ///< lights
    std::uint64_t reference_count() const { return references_.buffer().bytes() / sizeof(std::uint32_t); }

  private:
    double count(const LightHierarchy& hierarchy, const SampleClusters& clusters);
    double write(const LightHierarchy& hierarchy, const SampleClusters& clusters);
    void dispatch(gpu::Commands& commands, const gpu::ComputePipeline& pipeline, const LightHierarchy& hierarchy,
                  const SampleClusters& clusters);

    gpu::Device& device_;
    gpu::PrefixSum prefix_sum_;
    gpu::ComputePipeline count_pipeline_, write_pipeline_;
    FittedBuffer counts_, places_, total_, ranges_, references_;
};

} // namespace manylights::lab
