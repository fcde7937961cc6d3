#include "lab/techniques/tiled/tiled.h"

#include "lab/scene/error.h"
#include "lab/techniques/device/froxel_grid.h"
#include "lab/techniques/device/froxel_lists.h"
#include "lab/techniques/device/list_structure.h"
#include "lab/techniques/device/tile_depths.h"
#include "lab/techniques/options.h"
#include "lab/techniques/pass_technique.h"
#include "lab/techniques/structure_technique.h"

#include <fmt/format.h>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kListsCode[] =
#include "tiled_lists.comp.inc"
    ;

// As tiled_lists.comp numbers them.
constexpr const char* kDepths[] = {"minmax", "max", "none"};
constexpr const char* kTests[] = {"narrowed", "rectangle", "planes"};
constexpr std::uint32_t kNoDepths = 2;

struct Options {
    std::uint32_t tile_size;
    std::array<std::uint32_t, 2> tiles; ///< across and down; 0: as many as their size makes
    std::uint32_t depth, test;

    bool has_counts() const { return tiles[0] != 0; }

    bool has_depths() const { return depth != kNoDepths; }
};

Options read_options(const OptionValues& values) {
    const OptionReader reader(tiled_info(), values);
    if (reader.given("tiles") && reader.given("tile_size"))
        throw InputError("tiled: options tiles and tile_size: either says how large tiles are, and one is enough");
    return {reader.whole_number("tile_size", 16, 8, 64), reader.counts("tiles", {0, 0}, kMostTilesOfAxis),
            static_cast<std::uint32_t>(reader.choice("depth", kDepths)),
            static_cast<std::uint32_t>(reader.choice("test", kTests))};
}

TechniqueInfo info_with(const Options& options) {
    TechniqueInfo info = tiled_info();
    info.needs_depth = options.has_depths();
    info.serves_translucent = info.serves_air = !options.has_depths();
    return info;
}

// The library's query knows square tiles.
PassShaders shaders(const Options& options) {
    if (options.has_counts()) return froxel_list_shaders("tiled");
    const QueryShaders cursor = cursor_shaders();
    return {"tiled", cursor.record, cursor.shade, cursor.log, 5};
}

class Tiled : public PassTechnique {
  public:
    Tiled(gpu::Device& device, const Options& options)
        : PassTechnique(device, info_with(options), shaders(options)), options_(options), visible_(device),
          depths_(device), lists_(device, {"tiled", kListsCode, 1, {options.depth, options.test}}),
          square_tiles_(device), counted_tiles_(device) {}

  protected:
    void build(const Frame& frame) override {
        const DeviceView view = device_view(frame);
        const TileGrid grid = lay_out(frame);
        double milliseconds = visible_.find(view, spheres(), light_count());
        if (options_.has_depths()) milliseconds += depths_.find(frame.points, grid);
        // Without depths the shader reads none, and any buffer will do.
        const gpu::Buffer& depths = options_.has_depths() ? depths_.depths() : visible_.lights();
        milliseconds += lists_.build({{view, grid, visible_}, {{depths}}});
        stats_.build_ms.push_back(milliseconds);
        stats_.visible_lights = visible_.count();
        stats_.references = lists_.reference_count();
        stats_.structure_bytes = bytes_of(structure());
    }

    std::vector<const gpu::Buffer*> structure() const override {
        if (options_.has_counts()) return {&counted_tiles_.buffer(), &lists_.cells(), &lists_.references()};
        return square_tiles_.buffers(lists_);
    }

  private:
    TileGrid lay_out(const Frame& frame) {
        if (!options_.has_counts()) {
            square_tiles_.fit(frame.width, frame.height, options_.tile_size);
            return tile_grid(frame.width, frame.height, options_.tile_size);
        }
        counted_tiles_.lay_out(frame, {options_.tiles, DepthDivision::view_uniform, 1});
        return counted_tiles_.tiles();
    }

    Options options_;
    VisibleLights visible_;
    TileDepths depths_;
    TileLists lists_;
    ListStructure square_tiles_;
    FroxelGrid counted_tiles_; // of one slice
};

} // namespace

TechniqueInfo tiled_info() {
    TechniqueInfo info;
    info.name = "tiled";
    info.summary = "a list of lights per tile of the image, between the depths of its points";
    info.options = {{"tile_size", "edge of a tile in pixels", "8 to 64, default 16"},
                    {"tiles", "instead of their size: how many tiles the image has across and down",
                     fmt::format("two numbers from 1 to {} with an x between them", kMostTilesOfAxis)},
                    {"depth", "which depths of a tile's points bound its lights",
                     "minmax (default), max, or none: serves translucent layers and air as well"},
                    {"test", "how a light is held against a tile",
                     "narrowed (default): the depths of its sphere within the tile; rectangle: its pixels, and all its "
                     "depths; planes: the tile's four sides, and all its depths"}};
    info.needs_depth = true;
    info.serves_translucent = info.serves_air = false;
    return info;
}

std::unique_ptr<Technique> make_tiled(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<Tiled>(device, read_options(options));
}

} // namespace manylights::lab
