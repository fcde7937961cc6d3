#include "lab/techniques/hybrid_lighting/hybrid_lighting.h"

#include "lab/techniques/device/froxel_lists.h"
#include "lab/techniques/device/list_structure.h"
#include "lab/techniques/device/occupied_froxels.h"
#include "lab/techniques/device/tile_links.h"
#include "lab/techniques/device/tile_lists.h"
#include "lab/techniques/options.h"
#include "lab/techniques/pass_technique.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kListsCode[] =
#include "hybrid_lists.comp.inc"
    ;
constexpr std::uint32_t kLinksCode[] =
#include "hybrid_links.comp.inc"
    ;
constexpr std::uint32_t kBillboardsCode[] =
#include "hybrid_billboards.vert.inc"
    ;
constexpr std::uint32_t kListsFragmentCode[] =
#include "hybrid_lists.frag.inc"
    ;
constexpr std::uint32_t kLinksFragmentCode[] =
#include "hybrid_links.frag.inc"
    ;

// The first of each is what it is by default.
constexpr const char* kLists[] = {"contiguous", "linked"};
constexpr const char* kCells[] = {"all", "occupied"};
constexpr const char* kBillboards[] = {"compute", "raster"};
constexpr const char* kCoverages[] = {"tile", "centre_ray", "plain"}; // as coverage.glsl numbers them

struct Options {
    FroxelOptions froxels;
    bool is_linked, only_occupied, is_raster;
    std::uint32_t coverage;
};

Options read_options(const OptionValues& values) {
    const OptionReader reader(hybrid_lighting_info(), values);
    return {read_froxel_options(reader), reader.choice("lists", kLists) != 0, reader.choice("cells", kCells) != 0,
            reader.choice("billboards", kBillboards) != 0,
            static_cast<std::uint32_t>(reader.choice("coverage", kCoverages))};
}

TechniqueInfo info_with(const Options& options) {
    TechniqueInfo info = hybrid_lighting_info();
    info.needs_depth = options.only_occupied;
    info.serves_translucent = info.serves_air = !options.only_occupied;
    info.exact = options.coverage == 0;
    return info;
}

PassShaders shaders(const Options& options) {
    return options.is_linked ? froxel_link_shaders("hybrid_lighting") : froxel_list_shaders("hybrid_lighting");
}

TilePassShader pass_shader(const Options& options) {
    using Code = std::span<const std::uint32_t>;
    const Code compute = options.is_linked ? Code(kLinksCode) : Code(kListsCode);
    const Code fragment = options.is_linked ? Code(kLinksFragmentCode) : Code(kListsFragmentCode);
    return {"hybrid_lighting",
            options.is_raster ? fragment : compute,
            2,
            {options.coverage, options.only_occupied ? 1u : 0u},
            options.is_raster ? Code(kBillboardsCode) : Code()};
}

class HybridLighting : public PassTechnique {
  public:
    HybridLighting(gpu::Device& device, const Options& options)
        : PassTechnique(device, info_with(options), shaders(options)), options_(options), visible_(device),
          grid_(device), occupied_(device) {
        if (options.is_linked)
            links_.emplace(device, pass_shader(options));
        else
            lists_.emplace(device, pass_shader(options));
    }

  protected:
    void build(const Frame& frame) override {
        const DeviceView view = device_view(frame);
        grid_.lay_out(frame, options_.froxels);
        double milliseconds = visible_.find(view, spheres(), light_count());
        if (options_.only_occupied) milliseconds += occupied_.find(frame.points, grid_);
        milliseconds += fill_lists({view, grid_.tiles(), visible_});
        stats_.build_ms.push_back(milliseconds);
        stats_.visible_lights = visible_.count();
        stats_.references = links_ ? links_->link_count() : lists_->reference_count();
        stats_.structure_bytes = links_ ? grid_.buffer().bytes() + links_->bytes() : bytes_of(structure());
    }

    std::vector<const gpu::Buffer*> structure() const override {
        if (links_) return {&grid_.buffer(), &links_->heads(), &links_->links()};
        return {&grid_.buffer(), &lists_->cells(), &lists_->references()};
    }

  private:
    double fill_lists(const TilePassInput& input) {
        // Where all froxels are wanted the shader asks for none of them, and any buffer will do.
        const gpu::Buffer& occupied = options_.only_occupied ? occupied_.bits() : visible_.lights();
        const std::vector<gpu::Binding> buffers{{grid_.buffer()}, {occupied}};
        if (links_) return links_->build(input, buffers, grid_.froxel_count());
        return lists_->build({input, buffers, grid_.slice_count()});
    }

    Options options_;
    VisibleLights visible_;
    FroxelGrid grid_;
    OccupiedFroxels occupied_;
    std::optional<TileLists> lists_; // one of the two
    std::optional<TileLinks> links_;
};

} // namespace

TechniqueInfo hybrid_lighting_info() {
    TechniqueInfo info;
    info.name = "hybrid_lighting";
    info.summary = "a list of lights per froxel: each light goes over the tiles that its billboard covers";
    info.options = froxel_option_infos();
    info.options.insert(
        info.options.end(),
        {{"lists", "how a froxel's lights are kept",
          "contiguous (default): counted, then written; linked: a list of links, in one pass"},
         {"billboards", "what goes over the tiles that a light covers",
          "compute (default): a thread or more per light; raster: the rasteriser, which draws a rectangle per light, "
          "with a pixel per tile"},
         {"cells", "which froxels have lists", "all (default), or occupied: those that hold points"},
         {"coverage", "when a light covers a tile, and at which depths",
          "tile (default): where its sphere meets the tile's pyramid; lossy: centre_ray, where the ray through the "
          "tile's centre meets the sphere; plain, where the tile's centre is in the light's rectangle"}});
    return info;
}

std::unique_ptr<Technique> make_hybrid_lighting(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<HybridLighting>(device, read_options(options));
}

} // namespace manylights::lab
