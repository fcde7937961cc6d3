#include "lab/techniques/culling_2_5d/culling_2_5d.h"

#include "lab/renderer/point_buffer.h"
#include "lab/techniques/device/list_structure.h"
#include "lab/techniques/device/tile_depths.h"
#include "lab/techniques/options.h"
#include "lab/techniques/pass_technique.h"
#include "lab/techniques/structure_technique.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kCellsCode[] =
#include "culling_2_5d_cells.comp.inc"
    ;
constexpr std::uint32_t kListsCode[] =
#include "culling_2_5d_lists.comp.inc"
    ;
constexpr std::uint32_t kRecordCode[] =
#include "culling_2_5d_record.comp.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "culling_2_5d_shade.comp.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "culling_2_5d_log.comp.inc"
    ;

// As culling_2_5d_lists.comp numbers them.
enum class Lists : std::uint32_t { per_tile, with_masks, per_cell };
constexpr const char* kVariants[] = {"a", "b", "c"};
constexpr const char* kCellCounts[] = {"32", "8", "16", "64"};
constexpr std::uint32_t kCellNumbers[] = {32, 8, 16, 64};
constexpr const char* kIntervals[] = {"narrowed", "sphere"};

struct Options {
    Lists lists;
    std::uint32_t cells, tile_size, is_whole;

    std::uint32_t lists_per_tile() const { return lists == Lists::per_cell ? cells : 1; }
    std::uint32_t words_per_reference() const { return lists == Lists::with_masks ? 1 + (cells + 31) / 32 : 1; }
};

Options read_options(const OptionValues& values) {
    const OptionReader reader(culling_2_5d_info(), values);
    return {static_cast<Lists>(reader.choice("variant", kVariants)), kCellNumbers[reader.choice("cells", kCellCounts)],
            reader.whole_number("tile_size", 16, 8, 64),
            static_cast<std::uint32_t>(reader.choice("interval", kIntervals))};
}

// A list per tile has the library's format.
PassShaders shaders(const Options& options) {
    const QueryShaders cursor = cursor_shaders();
    if (options.lists == Lists::per_tile) return {"culling_2_5d", cursor.record, cursor.shade, cursor.log, 5};
    return {"culling_2_5d", kRecordCode, kShadeCode, kLogCode, 4};
}

/// What culling_2_5d.glsl knows of the tiles.
struct CellGrid {
    std::uint32_t tile_size, tiles_x, cell_count, has_masks;
};

struct CellsPush {
    std::uint32_t width, height;
    TileGrid grid;
    std::uint32_t cell_count;
};

class Culling25D : public PassTechnique {
  public:
    Culling25D(gpu::Device& device, const Options& options)
        : PassTechnique(device, culling_2_5d_info(), shaders(options)), options_(options), visible_(device),
          depths_(device), cells_pipeline_(device, {"culling_2_5d (cells)", kCellsCode, 4, sizeof(CellsPush), {}}),
          lists_(device, {"culling_2_5d",
                          kListsCode,
                          3,
                          {static_cast<std::uint32_t>(options.lists), options.cells, options.is_whole}}),
          list_structure_(device), cell_grid_(device, "grid of cells"), scales_(device, "scales of cells"),
          occupied_(device, "cells with points") {}

  protected:
    void build(const Frame& frame) override {
        const DeviceView view = device_view(frame);
        const TileGrid grid = tile_grid(frame.width, frame.height, options_.tile_size);
        double milliseconds = visible_.find(view, spheres(), light_count());
        milliseconds += depths_.find(frame.points, grid);
        milliseconds += find_cells(frame.points, grid);
        milliseconds += lists_.build({{view, grid, visible_},
                                      {{depths_.depths()}, {scales_.buffer()}, {occupied_.buffer()}},
                                      options_.lists_per_tile(),
                                      options_.words_per_reference()});
        fit_structure(frame, grid);
        stats_.build_ms.push_back(milliseconds);
        stats_.visible_lights = visible_.count();
        stats_.references = lists_.reference_count();
        stats_.structure_bytes = bytes_of(structure());
    }

    std::vector<const gpu::Buffer*> structure() const override {
        if (options_.lists == Lists::per_tile) return list_structure_.buffers(lists_);
        return {&cell_grid_.buffer(), &scales_.buffer(), &lists_.cells(), &lists_.references()};
    }

  private:
    double find_cells(const PointBuffer& points, const TileGrid& grid) {
        scales_.fit(std::uint64_t{grid.tile_count()} * 2 * sizeof(float));
        occupied_.fit(std::uint64_t{grid.tile_count()} * 2 * sizeof(std::uint32_t));
        const CellsPush push{points.width(), points.height(), grid, options_.cells};
        gpu::Commands commands(device());
        const std::uint32_t start = commands.timestamp();
        commands.dispatch(cells_pipeline_,
                          {{points.positions()}, {depths_.depths()}, {scales_.buffer()}, {occupied_.buffer()}}, push,
                          {grid.tiles_x, grid.tiles_y, 1});
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("cells with points");
        return commands.milliseconds(start, end);
    }

    void fit_structure(const Frame& frame, const TileGrid& grid) {
        list_structure_.fit(frame.width, frame.height, options_.tile_size);
        const CellGrid cells{options_.tile_size, grid.tiles_x, options_.cells,
                             options_.lists == Lists::with_masks ? 1u : 0u};
        cell_grid_.fit(sizeof cells);
        cell_grid_.buffer().upload(std::span<const CellGrid>(&cells, 1));
    }

    Options options_;
    VisibleLights visible_;
    TileDepths depths_;
    gpu::ComputePipeline cells_pipeline_;
    TileLists lists_;
    ListStructure list_structure_;
    FittedBuffer cell_grid_, scales_, occupied_;
};

} // namespace

TechniqueInfo culling_2_5d_info() {
    TechniqueInfo info;
    info.name = "culling_2_5d";
    info.summary = "tiled, without the lights that reach only depths of a tile where it has no points";
    info.options = {
        {"variant", "what the cells of a tile's depths are for",
         "a (default): lights that reach no cell with points go; b: each reference has a mask of cells, and "
         "a point reads those of its own; c: a list per cell"},
        {"cells", "how many equal cells a tile's depths have", "8, 16, 32 (default) or 64"},
        {"tile_size", "edge of a tile in pixels", "8 to 64, default 16"},
        {"interval", "which depths of a light count",
         "narrowed (default): those of its sphere within the tile; sphere: all"}};
    info.needs_depth = true;
    info.serves_translucent = info.serves_air = false;
    return info;
}

std::unique_ptr<Technique> make_culling_2_5d(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<Culling25D>(device, read_options(options));
}

} // namespace manylights::lab
