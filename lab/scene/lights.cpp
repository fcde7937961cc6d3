#include "lab/scene/lights.h"

#include "lab/scene/error.h"
#include "lab/scene/light_placement.h"
#include "lab/scene/light_scale.h"
#include "lab/scene/random.h"
#include "lab/scene/scene.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace manylights::lab {
namespace {

// Channels of a light's random numbers; those below 8 are its position's.
constexpr std::uint32_t kRadiusChannel = 8, kLargeChannel = 9, kHueChannel = 10, kMixChannel = 11;

constexpr double kWantedLights = 6.0; // per visible point, with radius `auto`

enum class RadiusKind { automatic, mix, interval };

struct RadiusOption {
    RadiusKind kind = RadiusKind::automatic;
    RadiusTable table;
};

[[noreturn]] void fail_radius(const std::string& text) {
    throw InputError("radius \"" + text + "\": must be auto, mix, or MIN:MAX with 0 <= MIN <= MAX <= 1e18");
}

float parse_radius(const std::string& option, const char* begin, const char* end) {
    float value = -1.0f;
    const auto [rest, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || rest != end || !(value >= 0.0f && value <= 1e18f)) fail_radius(option);
    return value;
}

RadiusOption parse_radius_option(const std::string& text, const Scene& scene) {
    if (text == "auto") return {RadiusKind::automatic, scene.radii};
    if (text == "mix") return {RadiusKind::mix, {1.0f, 6.0f, 20.0f, 40.0f, 0.002f, 1.0f}};
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) fail_radius(text);
    const float lower = parse_radius(text, text.data(), text.data() + colon);
    const float upper = parse_radius(text, text.data() + colon + 1, text.data() + text.size());
    if (lower > upper) fail_radius(text);
    return {RadiusKind::interval, {lower, upper, lower, upper, 0.0f, 1.0f}};
}

float unit_radius(const RadiusTable& table, std::uint32_t seed, std::uint32_t i) {
    const bool large = random_unit(seed, i, kLargeChannel) < table.large_share;
    return large ? random_between(seed, i, kRadiusChannel, table.large_lower, table.large_upper)
                 : random_between(seed, i, kRadiusChannel, table.small_lower, table.small_upper);
}

/// Lamps, mostly warm, some cool, softened towards a warm white; each colour has a luminance near 1, so that no hue
/// outshines the others.
glm::vec3 light_color(std::uint32_t seed, std::uint32_t i) {
    static constexpr float kPalette[][3] = {
        {2.0f, 0.85f, 0.22f}, {2.2f, 0.70f, 0.10f}, {1.6f, 0.95f, 0.45f}, {2.5f, 0.55f, 0.30f}, {2.3f, 0.45f, 0.95f},
        {1.3f, 0.60f, 2.6f},  {0.45f, 1.0f, 2.6f},  {0.25f, 1.2f, 1.6f},  {0.40f, 1.3f, 0.60f}, {1.1f, 1.0f, 0.85f}};
    constexpr std::uint32_t kColors = std::size(kPalette);
    const float position = float(kColors) * random_unit(seed, i, kHueChannel);
    const auto first = std::min(std::uint32_t(position), kColors - 1);
    const std::uint32_t second = (first + 1) % kColors;
    const float t = random_unit(seed, i, kMixChannel);
    glm::vec3 color;
    for (int c = 0; c < 3; ++c) color[c] = kPalette[first][c] * (1.0f - t) + kPalette[second][c] * t;
    return color * 0.6f + glm::vec3(0.48f, 0.39f, 0.29f);
}

/// Intensity grows with the square of the range, so that small and large lights are equally bright at the same share of
/// their range; with six lights on a surface of albedo 0.5 the reflected light is then about a third.
void set_color(Light& light, std::uint32_t seed, std::uint32_t i) {
    constexpr float kIntensity = 0.25f;
    const glm::vec3 color = light_color(seed, i) * (kIntensity * light.sphere.range * light.sphere.range);
    for (int c = 0; c < 3; ++c) light.color[c] = color[c];
}

std::vector<Light> place_lights(const Placement& place, const RadiusTable& table, const LightOptions& options) {
    std::vector<Light> lights(options.count);
    for (std::uint32_t i = 0; i < options.count; ++i) {
        const float radius = unit_radius(table, options.seed, i);
        const glm::vec3 position = place(options.seed, i, radius);
        lights[i].sphere = {{position.x, position.y, position.z}, radius};
    }
    return lights;
}

/// What the scene's first four cameras see, in a small image each: 20,736 points at most.
std::vector<glm::vec3> sample_points(const Scene& scene) {
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < std::min<std::size_t>(scene.cameras.size(), 4); ++i) {
        for (const SurfacePoint& point : visible_points(scene, scene.cameras[i], 96, 54))
            points.push_back(point.position);
    }
    return points;
}

LightSet lights_of_file(const Scene& scene, const LightOptions& options) {
    if (scene.lights.empty())
        throw InputError("distribution \"file\": scene \"" + scene.name + "\" has no point lights of its own");
    if (options.radius != "auto")
        throw InputError("radius \"" + options.radius +
                         "\": with distribution \"file\" the lights have their own; leave it at auto");
    LightSet set{scene.lights, 1.0f};
    if (set.lights.size() > options.count) set.lights.resize(options.count);
    return set;
}

/// The heavy-overlap workload reaches 201 m into the view with radii of 0.5 to 5 m; scenes smaller than 500 m get it
/// smaller in proportion.
LightSet lights_in_view(const Scene& scene, const Camera& camera, const RadiusOption& radius,
                        const LightOptions& options) {
    const float scale = std::min(1.0f, scene.view_extent / 500.0f);
    RadiusTable table = radius.table;
    if (radius.kind == RadiusKind::automatic) table = {0.5f * scale, 5.0f * scale, 0.0f, 0.0f, 0.0f, 1.0f};
    return {place_lights(place_in_view(camera, scale), table, options), 1.0f};
}

Placement placement(const Scene& scene, const std::string& distribution, RadiusKind kind) {
    // Published offsets are a quarter of the radius (surface) and up to half of it (surface-largest). With `auto` the
    // final radius is not known yet; it is about a quarter of the unit radius at 65,536 lights.
    const float share = kind == RadiusKind::automatic ? 0.25f : 1.0f;
    if (distribution == "volume") return place_in_volume(scene);
    if (distribution == "surface") return place_on_surface(scene, 0.25f * share);
    if (distribution == "surface-largest") return place_on_largest(scene, 0.5f * share);
    if (distribution == "groups") return place_in_groups(scene);
    std::string names;
    for (const DistributionInfo& info : distributions()) names += (names.empty() ? "" : ", ") + info.name;
    throw InputError("distribution \"" + distribution + "\": must be one of " + names);
}

} // namespace

std::vector<DistributionInfo> distributions() {
    return {{"volume", "uniform in the scene's light box"},
            {"surface", "near all triangles, by area; citadel: denser near its centre"},
            {"surface-largest", "near the 1,000 largest triangles, by area"},
            {"groups", "1,000 clusters with centres uniform in the light box"},
            {"view", "uniform in the camera's view depth: heavy overlap"},
            {"file", "the point lights of the glTF file itself"}};
}

LightSet make_lights(const Scene& scene, const Camera& camera, const LightOptions& options) {
    if (options.distribution == "file") return lights_of_file(scene, options);
    const RadiusOption radius = parse_radius_option(options.radius, scene);
    LightSet set;
    if (options.distribution == "view") {
        set = lights_in_view(scene, camera, radius, options);
    } else {
        set.lights = place_lights(placement(scene, options.distribution, radius.kind), radius.table, options);
        if (radius.kind == RadiusKind::automatic) {
            set.radius_scale =
                find_radius_scale(sample_points(scene), set.lights, kWantedLights, radius.table.scale_cap);
            for (Light& light : set.lights) light.sphere.range *= set.radius_scale;
        }
    }
    for (std::uint32_t i = 0; i < options.count; ++i) set_color(set.lights[i], options.seed, i);
    return set;
}

} // namespace manylights::lab
