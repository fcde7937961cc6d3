#include "lab/techniques/clustered_samples/clustered_samples.h"

#include "lab/scene/error.h"
#include "lab/techniques/clustered_samples/cluster_lists.h"
#include "lab/techniques/options.h"
#include "lab/techniques/pass_technique.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kSamplesRecord[] =
#include "samples_record.comp.inc"
    ;
constexpr std::uint32_t kSamplesShade[] =
#include "samples_shade.comp.inc"
    ;
constexpr std::uint32_t kSamplesLog[] =
#include "samples_log.comp.inc"
    ;
constexpr std::uint32_t kHierarchyRecord[] =
#include "hierarchy_record.comp.inc"
    ;
constexpr std::uint32_t kHierarchyShade[] =
#include "hierarchy_shade.comp.inc"
    ;
constexpr std::uint32_t kHierarchyLog[] =
#include "hierarchy_log.comp.inc"
    ;

// The first of each is what it is by default.
constexpr const char* kTileSizes[] = {"32", "16"};
constexpr const char* kSwitch[] = {"off", "on"};
constexpr const char* kUnique[] = {"sort", "page_table", "bitmap"};
constexpr const char* kBounds[] = {"implicit", "explicit"};
constexpr const char* kFanOuts[] = {"32", "16", "8"};
constexpr const char* kQueries[] = {"clusters", "hierarchy"};

constexpr std::uint32_t kFanOutOf[] = {32, 16, 8};

struct Options {
    ClusterOptions clusters;
    std::uint32_t fan_out;
    bool is_query_of_hierarchy;
};

Options read_options(const OptionValues& values) {
    const TechniqueInfo info = clustered_samples_info();
    const OptionReader reader(info, values);
    Options options;
    options.clusters.tile_size = reader.choice("tile_size", kTileSizes) == 0 ? 32 : 16;
    options.clusters.has_normals = reader.choice("normals", kSwitch) != 0;
    options.clusters.unique = static_cast<UniqueBy>(reader.choice("unique", kUnique));
    options.clusters.is_explicit = reader.choice("bounds", kBounds) != 0;
    options.fan_out = kFanOutOf[reader.choice("fan_out", kFanOuts)];
    options.is_query_of_hierarchy = reader.choice("query", kQueries) != 0;
    for (const char* key : {"tile_size", "normals", "unique", "bounds"})
        if (options.is_query_of_hierarchy && reader.given(key))
            throw InputError(info.name + ": option " + key + " needs query=clusters: the hierarchy has none");
    return options;
}

TechniqueInfo info_of(const Options& options) {
    TechniqueInfo info = clustered_samples_info();
    info.exact = !options.clusters.has_normals;
    if (options.is_query_of_hierarchy) {
        info.needs_depth = false;
        info.serves_translucent = info.serves_air = true;
    }
    return info;
}

/// Pixel, cluster, list.
class ClusteredSamples : public PassTechnique {
  public:
    ClusteredSamples(gpu::Device& device, const Options& options)
        : PassTechnique(device, info_of(options), {"clustered_samples", kSamplesRecord, kSamplesShade, kSamplesLog, 3}),
          hierarchy_(device, options.fan_out), clusters_(device, options.clusters), lists_(device) {}

  protected:
    void build(const Frame& frame) override {
        const DeviceView view = device_view(frame);
        double milliseconds = hierarchy_.build(view, spheres(), light_count());
        milliseconds += clusters_.find(frame, view);
        milliseconds += lists_.find(hierarchy_, clusters_);
        stats_.build_ms.push_back(milliseconds);
        stats_.visible_lights = hierarchy_.light_count();
        stats_.references = lists_.reference_count();
        stats_.structure_bytes = 0;
        for (const gpu::Buffer* buffer : structure()) stats_.structure_bytes += buffer->bytes();
    }

    std::vector<const gpu::Buffer*> structure() const override {
        return {&clusters_.ids(), &lists_.ranges(), &lists_.references()};
    }

  private:
    LightHierarchy hierarchy_;
    SampleClusters clusters_;
    ClusterLists lists_;
};

/// Each point by itself, through the hierarchy.
class HierarchyQuery : public PassTechnique {
  public:
    HierarchyQuery(gpu::Device& device, const Options& options)
        : PassTechnique(device, info_of(options),
                        {"clustered_samples", kHierarchyRecord, kHierarchyShade, kHierarchyLog, 3}),
          hierarchy_(device, options.fan_out) {}

  protected:
    void build(const Frame& frame) override {
        stats_.build_ms.push_back(hierarchy_.build(device_view(frame), spheres(), light_count()));
        stats_.visible_lights = stats_.references = hierarchy_.light_count();
        stats_.structure_bytes = 0;
        for (const gpu::Buffer* buffer : structure()) stats_.structure_bytes += buffer->bytes();
    }

    std::vector<const gpu::Buffer*> structure() const override {
        return {&hierarchy_.shape(), &hierarchy_.nodes(), &hierarchy_.indices()};
    }

  private:
    LightHierarchy hierarchy_;
};

} // namespace

TechniqueInfo clustered_samples_info() {
    TechniqueInfo info;
    info.name = "clustered_samples";
    info.summary = "clusters of the view's samples, each with a list from a hierarchy of all lights";
    info.options = {
        {"tile_size", "pixels of a tile's edge", "32 (default) or 16"},
        {"normals",
         "clusters of one direction each, without the lights behind them; lossy: a surface that is lit from "
         "behind loses lights",
         "off (default) or on"},
        {"unique", "how the clusters that have samples are found", "sort (default), page_table or bitmap"},
        {"bounds", "of a cluster: its cell's, or its samples'", "implicit (default) or explicit"},
        {"fan_out", "children of a node of the hierarchy", "32 (default), 16 or 8"},
        {"query", "what a pixel walks: its cluster's list, or the hierarchy by itself, which serves any point",
         "clusters (default) or hierarchy"},
    };
    info.needs_depth = true;
    info.serves_translucent = info.serves_air = false;
    return info;
}

std::unique_ptr<Technique> make_clustered_samples(gpu::Device& device, const OptionValues& options) {
    const Options read = read_options(options);
    if (read.is_query_of_hierarchy) return std::make_unique<HierarchyQuery>(device, read);
    return std::make_unique<ClusteredSamples>(device, read);
}

} // namespace manylights::lab
