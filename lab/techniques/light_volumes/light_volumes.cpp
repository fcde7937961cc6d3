#include "lab/techniques/light_volumes/light_volumes.h"

#include "lab/gpu/commands.h"
#include "lab/gpu/device.h"
#include "lab/gpu/image.h"
#include "lab/renderer/point_buffer.h"
#include "lab/scene/error.h"
#include "lab/techniques/device/depth_order.h"
#include "lab/techniques/device_technique.h"
#include "lab/techniques/light_volumes/proxy_mesh.h"
#include "lab/techniques/options.h"

#include <array>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kVertexCode[] =
#include "light_volumes.vert.inc"
    ;
constexpr std::uint32_t kDepthCode[] =
#include "light_volumes_depth.frag.inc"
    ;
constexpr std::uint32_t kRecordCode[] =
#include "light_volumes_record.frag.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "light_volumes_shade.frag.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "light_volumes_log.frag.inc"
    ;

constexpr VkFormat kColorFormat = VK_FORMAT_R32G32B32A32_SFLOAT, kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr std::uint32_t kBuffers = 9, kRectangleVertices = 6;

// As volumes.glsl and light_volumes.vert number them.
enum Shape : std::uint32_t { kMesh, kRectangle, kImage };
enum Faces : std::uint32_t { kBackFaces, kFrontFaces };
enum Group : std::uint32_t { kAllLights, kNotAround, kAround };

enum class Volume { back, front, all, rectangle };

struct Options {
    Volume volume;
    std::uint32_t mesh_level;
    bool by_near_end;

    bool compares_depths() const { return volume == Volume::back || volume == Volume::front; }
};

Options read_options(const OptionValues& values) {
    const OptionReader reader(light_volumes_info(), values);
    constexpr const char *kVolumes[] = {"back", "front", "all", "rectangle"}, *kOrders[] = {"index", "near"};
    const Options options{static_cast<Volume>(reader.choice("volume", kVolumes)),
                          reader.whole_number("mesh_level", 1, 0, 3), reader.choice("order", kOrders) == 1};
    if (options.volume == Volume::rectangle && reader.given("mesh_level"))
        throw InputError("light_volumes: option mesh_level: volume=rectangle has no mesh");
    return options;
}

TechniqueInfo info_with(const Options& options) {
    TechniqueInfo info = light_volumes_info();
    info.needs_depth = options.compares_depths();
    return info;
}

struct Push {
    DeviceView view;
    float mesh_reach;
    std::uint32_t group;
};

/// What one draw over all lights does.
struct Pass {
    gpu::RasterPipeline pipeline;
    Group group;
};

/// The shaders' forms: what fragments write.
struct Form {
    const char* name;
    std::span<const std::uint32_t> code;
    bool has_color;
};

gpu::RasterShader shader_of(const Form& form, Shape shape, Faces faces) {
    gpu::RasterShader shader;
    shader.name = std::string("light_volumes (") + form.name + ")";
    shader.vertex = kVertexCode;
    shader.fragment = form.code;
    shader.buffer_count = kBuffers;
    shader.push_constant_bytes = sizeof(Push);
    shader.specialization = {shape, faces};
    return shader;
}

// Reversed depths: a fragment is behind the scene where its own are smaller.
Pass mesh_pass(gpu::Device& device, const Form& form, gpu::RasterState state, Faces faces, Group group) {
    state.cull = faces == kBackFaces ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
    state.clamps_depth = true;
    if (state.depth != VK_FORMAT_UNDEFINED)
        state.depth_passes = faces == kBackFaces ? VK_COMPARE_OP_LESS_OR_EQUAL : VK_COMPARE_OP_GREATER_OR_EQUAL;
    return {gpu::RasterPipeline(device, shader_of(form, kMesh, faces), state), group};
}

/// The draws of a form: the image without lights, and then the lights.
class Drawing {
  public:
    Drawing(gpu::Device& device, const Form& form, const Options& options)
        : begin_(device, shader_of(form, kImage, kBackFaces), state_of(form, options)) {
        const gpu::RasterState state = state_of(form, options);
        if (options.volume == Volume::rectangle) {
            passes_.push_back(
                {gpu::RasterPipeline(device, shader_of(form, kRectangle, kBackFaces), state), kAllLights});
        } else if (options.volume == Volume::front) {
            passes_.push_back(mesh_pass(device, form, state, kFrontFaces, kNotAround));
            passes_.push_back(mesh_pass(device, form, state, kBackFaces, kAround));
        } else {
            passes_.push_back(mesh_pass(device, form, state, kBackFaces, kAllLights));
        }
    }

    const gpu::RasterPipeline& begin() const { return begin_; }
    std::span<const Pass> passes() const { return passes_; }

  private:
    static gpu::RasterState state_of(const Form& form, const Options& options) {
        gpu::RasterState state;
        if (form.has_color) state.color = kColorFormat;
        state.adds_color = form.has_color;
        if (options.compares_depths()) state.depth = kDepthFormat;
        return state;
    }

    gpu::RasterPipeline begin_;
    std::vector<Pass> passes_;
};

gpu::RasterPipeline make_depth_pipeline(gpu::Device& device) {
    gpu::RasterState state;
    state.depth = kDepthFormat;
    state.writes_depth = true;
    return gpu::RasterPipeline(device, shader_of({"depths", kDepthCode, false}, kImage, kBackFaces), state);
}

class LightVolumes : public DeviceTechnique {
  public:
    LightVolumes(gpu::Device& device, const Options& options)
        : DeviceTechnique(device, info_with(options)), options_(options), visible_(device),
          order_(device, options.by_near_end), depth_pipeline_(make_depth_pipeline(device)),
          record_(device, {"record", kRecordCode, false}, options),
          shade_(device, {"shade", kShadeCode, true}, options), log_(device, {"log", kLogCode, false}, options),
          mesh_(make_proxy_mesh(options.mesh_level)),
          corners_(device, "mesh of light volumes", std::span<const glm::vec4>(mesh_.corners)) {}

    std::vector<PixelRecord> record(const Frame& frame) override;
    std::vector<float> shade(const Frame& frame) override;
    WaveSummary waves(const Frame& frame) override;

  protected:
    void build(const Frame& frame) override;

  private:
    double find_order();
    double draw_depths(const Frame& frame);
    gpu::Image make_image(const Frame& frame, const char* name, VkFormat format, VkImageUsageFlags usage) const;
    std::vector<gpu::Binding> bindings(const Frame& frame, const gpu::Buffer& output) const;
    std::vector<gpu::Binding> log_bindings(const Frame& frame, const LogBuffers& log) const;
    gpu::Targets targets(const Frame& frame, const gpu::Image* color) const;
    void draw_image(gpu::Commands& commands, const Drawing& drawing, const std::vector<gpu::Binding>& buffers) const;
    void draw_lights(gpu::Commands& commands, const Pass& pass, const std::vector<gpu::Binding>& buffers) const;
    void run(const Frame& frame, const Drawing& drawing, const std::vector<gpu::Binding>& buffers,
             const char* what) const;

    Options options_;
    VisibleLights visible_;
    DepthOrder order_;
    gpu::RasterPipeline depth_pipeline_;
    Drawing record_, shade_, log_;
    ProxyMesh mesh_;
    gpu::Buffer corners_;
    std::optional<gpu::Image> depth_; ///< of the frame's points, where it is compared
    DeviceView view_{};
    bool is_warm_ = false; ///< the shade pipelines have their machine code
};

void LightVolumes::build(const Frame& frame) {
    view_ = device_view(frame);
    double milliseconds = visible_.find(view_, spheres(), light_count());
    milliseconds += find_order();
    if (options_.compares_depths()) milliseconds += draw_depths(frame);
    stats_.build_ms.push_back(milliseconds);
    stats_.visible_lights = visible_.count();
    const std::uint64_t mesh_bytes = options_.volume == Volume::rectangle ? 0 : corners_.bytes();
    stats_.structure_bytes = mesh_bytes + visible_.count() * (sizeof(VisibleLight) + sizeof(std::uint32_t));
}

double LightVolumes::find_order() {
    order_.reserve(visible_.count());
    gpu::Commands commands(device());
    const std::uint32_t start = commands.timestamp();
    order_.record(commands, visible_, options_.by_near_end);
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("the order of light volumes");
    return commands.milliseconds(start, end);
}

gpu::Image LightVolumes::make_image(const Frame& frame, const char* name, VkFormat format,
                                    VkImageUsageFlags usage) const {
    return gpu::Image(device().context(), name, {frame.width, frame.height, format, usage});
}

double LightVolumes::draw_depths(const Frame& frame) {
    if (!depth_ || depth_->width() != frame.width || depth_->height() != frame.height)
        depth_ = make_image(frame, "depths of points", kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    gpu::Commands commands(device());
    const std::uint32_t start = commands.timestamp();
    commands.begin_drawing({frame.width, frame.height, {}, {&*depth_}});
    commands.draw(depth_pipeline_, bindings(frame, corners_), Push{view_, mesh_.reach, kAllLights},
                  {kRectangleVertices, 1});
    commands.end_drawing();
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("depths of points");
    return commands.milliseconds(start, end);
}

// Of the forms that shade; those without an output buffer read none in its place, and any will do.
std::vector<gpu::Binding> LightVolumes::bindings(const Frame& frame, const gpu::Buffer& output) const {
    return {{frame.points.positions()}, {frame.points.normals()}, {frame.points.materials()},
            {lights().spheres},         {lights().colors},        {output},
            {visible_.lights()},        {order_.order()},         {corners_}};
}

std::vector<gpu::Binding> LightVolumes::log_bindings(const Frame& frame, const LogBuffers& log) const {
    return {{frame.points.positions()}, {log.blocks},     {log.places}, {lights().spheres}, {log.ends}, {log.words},
            {visible_.lights()},        {order_.order()}, {corners_}};
}

gpu::Targets LightVolumes::targets(const Frame& frame, const gpu::Image* color) const {
    gpu::Targets targets{frame.width, frame.height, {color}};
    if (options_.compares_depths()) targets.depth = {&*depth_, true};
    return targets;
}

void LightVolumes::draw_image(gpu::Commands& commands, const Drawing& drawing,
                              const std::vector<gpu::Binding>& buffers) const {
    commands.draw(drawing.begin(), buffers, Push{view_, mesh_.reach, kAllLights}, {kRectangleVertices, 1});
}

void LightVolumes::draw_lights(gpu::Commands& commands, const Pass& pass,
                               const std::vector<gpu::Binding>& buffers) const {
    if (visible_.count() == 0) return;
    const std::size_t corners = options_.volume == Volume::rectangle ? kRectangleVertices : mesh_.corners.size();
    commands.draw(pass.pipeline, buffers, Push{view_, mesh_.reach, pass.group},
                  {static_cast<std::uint32_t>(corners), visible_.count()});
}

// Several draws write to the same words: one ends before the next begins.
void LightVolumes::run(const Frame& frame, const Drawing& drawing, const std::vector<gpu::Binding>& buffers,
                       const char* what) const {
    gpu::Commands commands(device());
    commands.begin_drawing(targets(frame, nullptr));
    draw_image(commands, drawing, buffers);
    commands.end_drawing();
    for (const Pass& pass : drawing.passes()) {
        commands.barrier();
        commands.begin_drawing(targets(frame, nullptr));
        draw_lights(commands, pass, buffers);
        commands.end_drawing();
    }
    commands.submit_and_wait(what);
}

std::vector<PixelRecord> LightVolumes::record(const Frame& frame) {
    gpu::Buffer records(device(), "light_volumes (record) output",
                        std::uint64_t{frame.width} * frame.height * sizeof(PixelRecord));
    records.fill(kPoison);
    run(frame, record_, bindings(frame, records), "light_volumes (record)");
    return records.download<PixelRecord>();
}

std::vector<float> LightVolumes::shade(const Frame& frame) {
    const gpu::Image image = make_image(frame, "light_volumes (shade) output", kColorFormat,
                                        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const gpu::Buffer pixels(device(), "pixels of light_volumes",
                             std::uint64_t{frame.width} * frame.height * sizeof(glm::vec4));
    const std::vector<gpu::Binding> buffers = bindings(frame, corners_);
    for (const bool is_timed : {false, true}) {
        if (!is_timed && is_warm_) continue;
        gpu::Commands commands(device());
        const std::uint32_t start = commands.timestamp();
        gpu::Targets area = targets(frame, &image);
        if (!is_timed) area.width = area.height = 1; // drivers make machine code at the first draw
        commands.begin_drawing(area);
        draw_image(commands, shade_, buffers);
        for (const Pass& pass : shade_.passes()) draw_lights(commands, pass, buffers);
        commands.end_drawing();
        const std::uint32_t end = commands.timestamp();
        commands.copy(image, pixels);
        commands.submit_and_wait("light_volumes (shade)");
        if (is_timed) stats_.shade_ms.push_back(commands.milliseconds(start, end));
        is_warm_ = true;
    }
    std::vector<float> radiance;
    radiance.reserve(std::size_t{3} * frame.width * frame.height);
    for (const glm::vec4& pixel : pixels.download<glm::vec4>())
        radiance.insert(radiance.end(), {pixel.x, pixel.y, pixel.z});
    return radiance;
}

WaveSummary LightVolumes::waves(const Frame& frame) {
    return find_waves(device(), "light_volumes (log)", frame, [&](const LogBuffers& log, std::size_t, std::size_t) {
        run(frame, log_, log_bindings(frame, log), "light_volumes (log)");
    });
}

} // namespace

TechniqueInfo light_volumes_info() {
    TechniqueInfo info;
    info.name = "light_volumes";
    info.summary = "each light a volume that is drawn over the points, whose fragments are lit";
    info.options = {{"volume", "what is drawn of a light, and which of its pixels are shaded",
                     "back (default): back faces behind the point; front: front faces before it; all: every pixel; "
                     "rectangle: of its "
                     "pixels, all"},
                    {"mesh_level", "how finely the mesh of a sphere is divided", "0 to 3, default 1"},
                    {"order", "of the lights", "index (default), near: by the near end of their spheres"}};
    info.needs_depth = true;
    info.serves_translucent = info.serves_air = false;
    return info;
}

std::unique_ptr<Technique> make_light_volumes(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<LightVolumes>(device, read_options(options));
}

} // namespace manylights::lab
