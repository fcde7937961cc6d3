#include "lab/techniques/octree/octree.h"

#include "lab/techniques/device/counted_lists.h"
#include "lab/techniques/device/list_structure.h"
#include "lab/techniques/device/tile_pass.h"
#include "lab/techniques/octree/corner_table.h"
#include "lab/techniques/octree/octree_nodes.h"
#include "lab/techniques/options.h"
#include "lab/techniques/pass_technique.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kLightsCode[] =
#include "octree_lights.comp.inc"
    ;
constexpr std::uint32_t kTilesCode[] =
#include "octree_tiles.comp.inc"
    ;
constexpr std::uint32_t kFragmentCode[] =
#include "octree_tiles.frag.inc"
    ;
constexpr std::uint32_t kBillboardsCode[] =
#include "octree_billboards.vert.inc"
    ;
constexpr std::uint32_t kRecordCode[] =
#include "octree_record.comp.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "octree_shade.comp.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "octree_log.comp.inc"
    ;

constexpr std::uint32_t kAssignBuffers = 6; // of octree_place.glsl, besides the lights

// The first of each is what it is by default.
constexpr const char* kNodes[] = {"sparse", "dense"};
constexpr const char* kUnique[] = {"bitmask", "sort", "compact_sort"};
constexpr const char* kCorners[] = {"table", "computed"};
constexpr const char* kAssign[] = {"lights", "tiles", "billboards"};
constexpr const char* kInner[] = {"on", "off"};

struct Options {
    FroxelOptions froxels;
    std::size_t unique;
    bool is_sparse, has_corner_table, has_inner;
    std::size_t assign;

    std::vector<std::uint32_t> constants() const { return {has_inner ? 1u : 0u, has_corner_table ? 1u : 0u}; }
};

Options read_options(const OptionValues& values) {
    const TechniqueInfo info = octree_info();
    const OptionReader reader(info, values);
    return {read_froxel_options(reader),         reader.choice("unique", kUnique),
            reader.choice("nodes", kNodes) == 0, reader.choice("corners", kCorners) == 0,
            reader.choice("inner", kInner) == 0, reader.choice("assign", kAssign)};
}

std::unique_ptr<OccupiedCells> make_cells(gpu::Device& device, std::size_t choice) {
    return choice == 0 ? make_cells_by_bits(device) : make_cells_by_sort(device, choice == 2);
}

TilePassShader assign_shader(const Options& options) {
    using Code = std::span<const std::uint32_t>;
    const Code code[] = {kLightsCode, kTilesCode, kFragmentCode};
    const bool is_drawn = options.assign == 2;
    return {"octree (lists)", code[options.assign], kAssignBuffers, options.constants(),
            is_drawn ? Code(kBillboardsCode) : Code()};
}

class Octree : public PassTechnique {
  public:
    Octree(gpu::Device& device, const Options& options)
        : PassTechnique(device, octree_info(), {"octree", kRecordCode, kShadeCode, kLogCode, 5}), options_(options),
          visible_(device), grid_(device), levels_(device), cells_(make_cells(device, options.unique)),
          nodes_(options.is_sparse ? make_sparse_nodes(device) : make_dense_nodes(device)),
          assign_(device, assign_shader(options)), lists_(device, "octree") {
        if (options.has_inner && options.has_corner_table) corners_.emplace(device);
    }

  protected:
    void build(const Frame& frame) override {
        const DeviceView view = device_view(frame);
        grid_.lay_out(frame, options_.froxels);
        levels_.lay_out(grid_, options_.is_sparse);
        double milliseconds = visible_.find(view, spheres(), light_count());
        milliseconds += cells_->find(frame, grid_);
        milliseconds += nodes_->build(grid_, levels_, *cells_);
        if (corners_) milliseconds += corners_->update(frame, view, grid_);
        milliseconds += assign(view);
        stats_.build_ms.push_back(milliseconds);
        stats_.visible_lights = visible_.count();
        stats_.references = lists_.reference_count();
        stats_.structure_bytes = bytes_of(structure());
    }

    std::vector<const gpu::Buffer*> structure() const override {
        return {&grid_.buffer(), &levels_.buffer(), &nodes_->nodes(), &lists_.cells(), &lists_.references()};
    }

  private:
    double assign(const DeviceView& view) {
        // Without a table the shader reads none, and any buffer will do.
        const gpu::Buffer& corners = corners_ ? corners_->corners() : grid_.buffer();
        const auto record = [&](gpu::Commands& commands, const gpu::Buffer& counters, const gpu::Buffer& references,
                                bool is_fill) {
            assign_.record(
                commands, {view, grid_.tiles(), visible_},
                {{counters}, {references}, {grid_.buffer()}, {levels_.buffer()}, {nodes_->nodes()}, {corners}},
                is_fill ? 1 : 0);
        };
        return lists_.build(nodes_->count(), 1, record);
    }

    Options options_;
    VisibleLights visible_;
    FroxelGrid grid_;
    OctreeLevels levels_;
    std::unique_ptr<OccupiedCells> cells_;
    std::unique_ptr<OctreeNodes> nodes_;
    std::optional<CornerTable> corners_;
    TilePass assign_;
    CountedLists lists_;
};

} // namespace

TechniqueInfo octree_info() {
    TechniqueInfo info;
    info.name = "octree";
    info.summary =
        "an octree over the froxels that have samples; what reaches all froxels of a node is stored there once";
    info.options = froxel_option_infos();
    info.options.push_back({"unique",
                            "how the froxels with samples are found: a bit for each, or by sorting those of all "
                            "pixels, or of pixels that differ from the one before",
                            "bitmask (default), sort or compact_sort"});
    info.options.push_back({"nodes", "eight children of each node that has samples, or arrays of all nodes of a level",
                            "sparse (default) or dense"});
    info.options.push_back(
        {"corners", "of froxels: from a table, or computed where they are used", "table (default) or computed"});
    info.options.push_back(
        {"assign",
         "who goes down the octree: each light, or each light in each tile under its pixels, by a compute shader or "
         "by the rasteriser",
         "lights (default), tiles or billboards"});
    info.options.push_back({"inner", "whether nodes above froxels hold lights", "on (default) or off"});
    info.needs_depth = true;
    info.serves_translucent = info.serves_air = false;
    return info;
}

std::unique_ptr<Technique> make_octree(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<Octree>(device, read_options(options));
}

} // namespace manylights::lab
