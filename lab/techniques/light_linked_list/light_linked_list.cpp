#include "lab/techniques/light_linked_list/light_linked_list.h"

#include "lab/gpu/device.h"
#include "lab/renderer/point_buffer.h"
#include "lab/scene/error.h"
#include "lab/techniques/device/tile_grid.h"
#include "lab/techniques/device/visible_lights.h"
#include "lab/techniques/options.h"
#include "lab/techniques/pass_technique.h"
#include "lab/techniques/summary.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kDepthCode[] =
#include "light_linked_list_depth.comp.inc"
    ;
constexpr std::uint32_t kVertexCode[] =
#include "light_linked_list.vert.inc"
    ;
constexpr std::uint32_t kFragmentCode[] =
#include "light_linked_list.frag.inc"
    ;
constexpr std::uint32_t kRecordCode[] =
#include "light_linked_list_record.comp.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "light_linked_list_shade.comp.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "light_linked_list_log.comp.inc"
    ;

// The pool is so many buffers, of as many links each: light_links.glsl.
constexpr std::uint32_t kPages = 8, kPageLinks = 1u << 23, kMostLinks = kPages * kPageLinks;
constexpr std::uint32_t kStructureBuffers = 3 + kPages, kBuildBuffers = 4 + kPages;
constexpr std::uint32_t kRectangleVertices = 6;
constexpr std::uint32_t kNoLink = 0xFFFFFFFF;
constexpr std::uint64_t kWord = sizeof(std::uint32_t);

// Of links of two words: the rank of a light has 8 bits, and the next link 24, of which one code means none.
constexpr std::uint32_t kShortWords = 2, kWideWords = 3;
constexpr std::uint32_t kMostShortLights = 256, kMostShortLinks = 0xFFFFFF;

// In the order of the shaders.
constexpr const char* kLossy[] = {"off", "centre", "coverage", "rounding"};
constexpr std::uint32_t kByCentre = 1;

struct Options {
    std::uint32_t texel_size, link_words, lossy, first_links;
    bool has_depth_test;
};

Options read_options(const OptionValues& values) {
    const OptionReader reader(light_linked_list_info(), values);
    constexpr const char *kResolutions[] = {"eighth", "quarter", "full"}, *kLinks[] = {"8", "12", "16"},
                         *kTests[] = {"on", "off"};
    constexpr std::uint32_t kTexelSizes[] = {8, 4, 1};
    return {kTexelSizes[reader.choice("resolution", kResolutions)],
            static_cast<std::uint32_t>(kShortWords + reader.choice("link_bytes", kLinks)),
            static_cast<std::uint32_t>(reader.choice("lossy", kLossy)), reader.whole_number("first_links", 8, 0, 256),
            reader.choice("depth_test", kTests) == 0};
}

TechniqueInfo info_with(const Options& options) {
    TechniqueInfo info = light_linked_list_info();
    info.needs_depth = options.has_depth_test;
    info.exact = options.lossy == 0;
    return info;
}

struct DepthPush {
    std::uint32_t width, height;
    TileGrid grid;
};

struct LinksPush {
    DeviceView view;
    TileGrid grid;
    std::uint32_t link_words, capacity;
};

/// Of light_linked_list.glsl.
struct Header {
    TileGrid grid;
    std::uint32_t link_words;
};

gpu::RasterShader links_shader(const Options& options) {
    gpu::RasterShader shader;
    shader.name = "light_linked_list, links";
    shader.vertex = kVertexCode;
    shader.fragment = kFragmentCode;
    shader.buffer_count = kBuildBuffers;
    shader.push_constant_bytes = sizeof(LinksPush);
    shader.specialization = {options.has_depth_test, options.lossy};
    return shader;
}

class LightLinkedList : public PassTechnique {
  public:
    LightLinkedList(gpu::Device& device, const Options& options)
        : PassTechnique(device, info_with(options),
                        {"light_linked_list", kRecordCode, kShadeCode, kLogCode, kStructureBuffers}),
          options_(options), visible_(device),
          depth_pipeline_(
              device, {"light_linked_list, depths", kDepthCode, 2, sizeof(DepthPush), {options.lossy == kByCentre}}),
          links_pipeline_(device, links_shader(options), {}), farthest_(device, "farthest depths of texels"),
          counter_(device, "links, their number"), heads_(device, "first links of texels"),
          header_(device, "light_linked_list") {
        for (std::uint32_t i = 0; i < kPages; ++i) pages_.emplace_back(device, "links");
    }

    std::optional<double> references_in_range(const Frame& frame) override {
        return summarize(record(frame)).tested_mean;
    }

  protected:
    void build(const Frame& frame) override;
    std::vector<const gpu::Buffer*> structure() const override {
        std::vector<const gpu::Buffer*> buffers{&header_.buffer(), &heads_.buffer(), &visible_.lights()};
        for (const FittedBuffer& page : pages_) buffers.push_back(&page.buffer());
        return buffers;
    }

  private:
    void fit(const Frame& frame);
    void fit_pool();
    void make_room(std::uint64_t links);
    std::uint64_t capacity() const;
    double find_depths(const Frame& frame);
    double draw(const DeviceView& view);
    void write_header();
    void count();

    std::uint64_t link_bytes() const { return link_words_ * kWord; }
    std::uint64_t links() const { return counter_.buffer().download<std::uint32_t>(1).front(); }

    Options options_;
    VisibleLights visible_;
    gpu::ComputePipeline depth_pipeline_;
    gpu::RasterPipeline links_pipeline_;
    FittedBuffer farthest_, counter_, heads_, header_;
    std::vector<FittedBuffer> pages_;
    TileGrid grid_{};
    std::uint32_t link_words_ = 0;
    std::uint64_t pool_links_ = 0; ///< never fewer than in an earlier frame
};

// What does not fit is counted all the same, so a second drawing has room for everything.
void LightLinkedList::build(const Frame& frame) {
    const DeviceView view = device_view(frame);
    double milliseconds = visible_.find(view, spheres(), light_count());
    fit(frame);
    if (options_.has_depth_test) milliseconds += find_depths(frame);
    milliseconds += draw(view);
    if (links() > capacity()) {
        make_room(links());
        milliseconds += draw(view);
    }
    write_header();
    stats_.build_ms.push_back(milliseconds);
    count();
}

void LightLinkedList::fit(const Frame& frame) {
    grid_ = tile_grid(frame.width, frame.height, options_.texel_size);
    link_words_ = options_.link_words;
    if (link_words_ == kShortWords && visible_.count() > kMostShortLights) link_words_ = kWideWords;
    farthest_.fit(grid_.tile_count() * sizeof(float));
    heads_.fit(grid_.tile_count() * kWord);
    counter_.fit(kWord);
    header_.fit(sizeof(Header));
    const std::uint64_t first_links = std::uint64_t{options_.first_links} * grid_.tile_count();
    pool_links_ = std::max<std::uint64_t>(pool_links_, std::min<std::uint64_t>(first_links, kMostLinks));
    fit_pool();
}

void LightLinkedList::fit_pool() {
    std::uint64_t rest = pool_links_;
    for (FittedBuffer& page : pages_) {
        const std::uint64_t links = std::min<std::uint64_t>(rest, kPageLinks);
        page.fit(links * link_bytes());
        rest -= links;
    }
}

void LightLinkedList::make_room(std::uint64_t links) {
    if (links > kMostLinks)
        throw InputError(fmt::format("light_linked_list: {} links; the most is {}: resolution=eighth needs the fewest",
                                     links, kMostLinks));
    if (link_words_ == kShortWords && links > kMostShortLinks) link_words_ = kWideWords;
    pool_links_ = std::max(pool_links_, links);
    fit_pool();
}

std::uint64_t LightLinkedList::capacity() const {
    return link_words_ == kShortWords ? std::min<std::uint64_t>(pool_links_, kMostShortLinks) : pool_links_;
}

double LightLinkedList::find_depths(const Frame& frame) {
    gpu::Commands commands(device());
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(depth_pipeline_, {{frame.points.positions()}, {farthest_.buffer()}},
                      DepthPush{frame.width, frame.height, grid_},
                      {gpu::group_count(grid_.tiles_x, kGroupEdge), gpu::group_count(grid_.tiles_y, kGroupEdge), 1});
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("farthest depths of texels");
    return commands.milliseconds(start, end);
}

double LightLinkedList::draw(const DeviceView& view) {
    std::vector<gpu::Binding> buffers{
        {visible_.lights()}, {farthest_.buffer()}, {counter_.buffer()}, {heads_.buffer()}};
    for (const FittedBuffer& page : pages_) buffers.push_back({page.buffer()});
    const LinksPush push{view, grid_, link_words_, static_cast<std::uint32_t>(capacity())};
    gpu::Commands commands(device());
    const std::uint32_t start = commands.timestamp();
    commands.fill(counter_.buffer(), 0);
    commands.fill(heads_.buffer(), kNoLink);
    commands.barrier();
    commands.begin_drawing({grid_.tiles_x, grid_.tiles_y});
    if (visible_.count() != 0) commands.draw(links_pipeline_, buffers, push, {kRectangleVertices, visible_.count()});
    commands.end_drawing();
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("linked lists of lights");
    return commands.milliseconds(start, end);
}

void LightLinkedList::write_header() {
    const Header header{grid_, link_words_};
    header_.buffer().upload(std::span<const Header>(&header, 1));
}

// Room in the pool that no link has taken is not counted. Short links lead to lights through the list of those in view.
void LightLinkedList::count() {
    stats_.visible_lights = visible_.count();
    stats_.references = links();
    stats_.structure_bytes = sizeof(Header) + heads_.buffer().bytes() + stats_.references * link_bytes() +
                             (link_words_ == kShortWords ? visible_.count() * sizeof(VisibleLight) : 0);
}

} // namespace

TechniqueInfo light_linked_list_info() {
    TechniqueInfo info;
    info.name = "light_linked_list";
    info.summary = "a linked list of lights per texel, with the depths of each, entered by the rasteriser";
    info.options = {
        {"resolution", "texels per pixel, along either side of the image", "eighth (default), quarter, full"},
        {"link_bytes", "of a link; 12 instead of 8 where lights or links are more than that numbers",
         "8 (default), 12, 16"},
        {"depth_test", "whether lights behind the farthest point of a texel are left out", "on (default), off"},
        {"first_links", "links per texel that the pool begins with", "0 to 256, default 8"},
        {"lossy", "a form that loses lights, for tests and for demonstration",
         "off (default); centre: texels and depths by their centre; coverage: texels by their centre; rounding: depths "
         "to the nearest half"}};
    info.needs_depth = true;
    return info;
}

std::unique_ptr<Technique> make_light_linked_list(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<LightLinkedList>(device, read_options(options));
}

} // namespace manylights::lab
