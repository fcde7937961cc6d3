#include "lab/techniques/device_build/device_build.h"

#include "lab/gpu/device.h"
#include "lab/techniques/device/list_structure.h"
#include "lab/techniques/device/spread.h"
#include "lab/techniques/device_build/cell_trees.h"
#include "lab/techniques/light_records.h"
#include "reference/paper/slices.h"

#include <manylights/format.h>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kCellsCode[] =
#include "tile_lists_cells.comp.inc"
    ;
constexpr std::uint32_t kReferencesCode[] =
#include "references_write.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64;

MlUint structure_code(StructureKind kind) {
    if (kind == StructureKind::lists) return ML_STRUCTURE_LISTS;
    return kind == StructureKind::trees ? ML_STRUCTURE_TREES : ML_STRUCTURE_HYBRID;
}

class DeviceBuild : public StructureBuild {
  public:
    DeviceBuild(gpu::Device& device, const std::string& name, const StructureOptions& options);
    BuiltStructure build(const Frame& frame, const FrameLights& lights) override;

  private:
    void update_slices(const SliceRange& range);
    void write_view(const Frame& frame);
    double sort_lights();
    double write_cells(std::uint32_t cell_count);
    double write_references(const FrameLights& lights);
    void add_stage(const char* name, double ms);

    bool has_trees() const { return options_.kind != StructureKind::lists; }
    // Lists need no order.
    paper::SortScope scope() const { return has_trees() ? options_.sort_scope : paper::SortScope::all_lights; }

    gpu::Device& device_;
    StructureOptions options_;
    paper::SliceTable slices_;
    VisibleLights visible_;
    DepthOrder order_;
    GridReferences grid_references_;
    CellTrees trees_;
    gpu::ComputePipeline cells_pipeline_, references_pipeline_;
    FittedBuffer views_, slice_edges_, cells_, no_nodes_, references_;
};

DeviceBuild::DeviceBuild(gpu::Device& device, const std::string& name, const StructureOptions& options)
    : device_(device), options_(options), visible_(device),
      order_(device, options.sort_key == paper::SortKey::near_depth), grid_references_(device, name),
      trees_(device, options), cells_pipeline_(device, {"cells", kCellsCode, 3, sizeof(std::uint32_t), {}}),
      references_pipeline_(device, {"references", kReferencesCode, 8, sizeof(std::uint32_t), {options.has_records}}),
      views_(device, "view"), slice_edges_(device, "slice edges"), cells_(device, "cells"), no_nodes_(device, "nodes"),
      references_(device, "references") {}

BuiltStructure DeviceBuild::build(const Frame& frame, const FrameLights& lights) {
    const TileGrid tiles = tile_grid(frame.width, frame.height, options_.tile_size);
    const SliceRange range = slice_range(options_, frame.scene);
    const DeviceView view = device_view(frame);
    stages_.clear();
    milliseconds_ = 0.0;
    update_slices(range);
    write_view(frame);
    add_stage("cull", visible_.find(view, lights.spheres, lights.stream.light_count()));
    add_stage("sort", sort_lights());
    const CellGrid grid{tiles, slices_.count(), slice_edges_.buffer()};
    add_stage("bin", grid_references_.find(grid, visible_, order_, scope()));
    if (has_trees())
        add_stage("tree",
                  trees_.build(grid, visible_, order_, grid_references_, {frame.camera.near_plane, range.far_edge}));
    add_stage("write", write_cells(static_cast<std::uint32_t>(grid.cell_count())) + write_references(lights));
    no_nodes_.fit(0);
    visible_lights_ = visible_.count();
    gpu::Buffer& nodes = has_trees() ? trees_.nodes() : no_nodes_.buffer();
    return {{&views_.buffer(), &slice_edges_.buffer(), &cells_.buffer(), &nodes, &references_.buffer()},
            grid_references_.count()};
}

void DeviceBuild::update_slices(const SliceRange& range) {
    paper::Options options;
    options.slice_near = range.near_edge;
    options.slice_far = range.far_edge;
    options.slice_formula = options_.slice_formula;
    slices_.update(options, options_.kind == StructureKind::trees ? 1 : options_.slice_count);
    slice_edges_.fit(slices_.edges().size() * sizeof(float));
    slice_edges_.buffer().upload(slices_.edges());
}

void DeviceBuild::write_view(const Frame& frame) {
    MlView view =
        structure_view(frame.width, frame.height, options_.tile_size, slices_.count(), structure_code(options_.kind));
    view.slice_scale = slices_.guess_scale();
    view.slice_bias = slices_.guess_bias();
    views_.fit(sizeof view);
    views_.buffer().upload(std::span<const MlView>(&view, 1));
}

// Lists need no order, and ascend by light.
double DeviceBuild::sort_lights() {
    order_.reserve(visible_.count());
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    order_.record(commands, visible_, has_trees() && scope() == paper::SortScope::all_lights);
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("lights by depth");
    return commands.milliseconds(start, end);
}

double DeviceBuild::write_cells(std::uint32_t cell_count) {
    cells_.fit(std::uint64_t{cell_count} * sizeof(MlCell));
    const gpu::Buffer& counts = has_trees() ? trees_.counts() : grid_references_.counts();
    const gpu::Buffer& places = has_trees() ? trees_.places() : grid_references_.places();
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(cells_pipeline_, {{counts}, {places}, {cells_.buffer()}}, cell_count,
                      {gpu::group_count(cell_count, kGroupSize * kGroupSize), 1, 1});
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("cells");
    return commands.milliseconds(start, end);
}

double DeviceBuild::write_references(const FrameLights& lights) {
    const std::uint32_t count = grid_references_.count();
    references_.fit(count * (options_.has_records ? sizeof(LightRecord) : sizeof(std::uint32_t)));
    if (count == 0) return 0.0;
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(references_pipeline_,
                      {{visible_.lights()},
                       {order_.order()},
                       {grid_references_.ranks()},
                       {grid_references_.counts()},
                       {grid_references_.places()},
                       {lights.spheres},
                       {lights.colors},
                       {references_.buffer()}},
                      count, spread_groups(gpu::group_count(count, kGroupSize)));
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("references");
    return commands.milliseconds(start, end);
}

void DeviceBuild::add_stage(const char* name, double ms) {
    stages_.push_back({name, ms});
    milliseconds_ += ms;
}

} // namespace

std::unique_ptr<StructureBuild> make_device_build(gpu::Device& device, const std::string& name,
                                                  const StructureOptions& options) {
    return std::make_unique<DeviceBuild>(device, name, options);
}

} // namespace manylights::lab
