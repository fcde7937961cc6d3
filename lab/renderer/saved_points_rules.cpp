#include "lab/renderer/saved_points.h"

#include <algorithm>
#include <cmath>

namespace manylights::lab {

namespace {

constexpr double kDepthAgreement = 0x1p-20; ///< relative: what the library promises for
constexpr float kFarthest = 1e18f;          ///< the renderer calls what lies farther away sky
constexpr double kUnitTolerance = 1e-3;     ///< of a direction's length

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double length_of(const glm::vec3& v) { return std::sqrt(glm::dot(glm::dvec3(v), glm::dvec3(v))); }

bool is_unit(const glm::vec3& v) { return is_finite(v) && std::abs(length_of(v) - 1.0) <= kUnitTolerance; }

// Names are printed in messages of one line.
std::string broken_name(const char* field, const std::string& name) {
    if (name.size() > kLongestSavedName)
        return std::string(field) + ": must be at most " + std::to_string(kLongestSavedName) + " bytes long";
    const bool is_plain = std::none_of(name.begin(), name.end(), [](char c) { return (c >= 0 && c < 32) || c == 127; });
    return is_plain ? "" : std::string(field) + ": must have no control characters";
}

std::string broken_camera(const Camera& camera) {
    if (!is_finite(camera.position)) return "camera position: must be finite";
    if (!is_unit(camera.forward)) return "camera forward: must have the length 1";
    if (!is_finite(camera.up) || !(length_of(camera.up) > 0.0)) return "camera up: must be finite and not zero";
    const double cosine = glm::dot(glm::dvec3(camera.forward), glm::dvec3(camera.up)) / length_of(camera.up);
    if (std::abs(cosine) > 0.999) return "camera up: must not be parallel to forward";
    if (!(camera.vertical_fov >= 0.01f && camera.vertical_fov <= 3.0f))
        return "camera field of view: must be from 0.01 to 3 radians";
    if (!(camera.near_plane > 0.0f && camera.near_plane <= 1e6f))
        return "camera near plane: must be above 0, at most 1e6";
    return "";
}

std::string broken_size(const SavedPoints& saved) {
    for (const auto& [field, side] : {std::pair("width", saved.width), std::pair("height", saved.height)})
        if (side < 1 || side > kLargestSavedSide)
            return std::string(field) + " " + std::to_string(side) + ": must be from 1 to " +
                   std::to_string(kLargestSavedSide);
    return "";
}

/// The camera in double precision, with the float axes that points were made from.
struct Projection {
    glm::dvec3 right, up, forward;
    double tan_half_x, tan_half_y;
    double depth_slack; ///< relative
    double near_plane;
};

// A point is (right x + up y + forward) depth in floats, |x| <= tan_half_x and |y| <= tan_half_y: a product, two sums
// and a product lie on the way of each term, so a coordinate is off by 4 half units in the last place of the terms'
// magnitudes at most, and so is the depth along the unit vector forward: 4 * 2^-24 (tan_half_x + tan_half_y + 1). The
// axes are floats too: what they lack in unit length and right angles shifts the depth by the dot products below.
// Where a point falls in its pixel needs no slack: the renderer aims at the centre, half a pixel from the edge. Only in
// views of a degree and thousands of pixels does rounding take it farther than that, and out of the promise with it.
Projection projection_of(const SavedPoints& saved) {
    const CameraBasis basis = camera_basis(saved.camera, saved.width, saved.height);
    const glm::dvec3 right(basis.right), up(basis.up), forward(basis.forward);
    const double x = basis.tan_half_x, y = basis.tan_half_y;
    const double rounding = 0x1p-22 * (x + y + 1.0);
    const double axes = std::abs(glm::dot(forward, forward) - 1.0) + std::abs(glm::dot(forward, right)) * x +
                        std::abs(glm::dot(forward, up)) * y;
    return {right, up, forward, x, y, kDepthAgreement + rounding + axes, saved.camera.near_plane};
}

std::string broken_projection(const SavedPoint& point, const Projection& camera, const SavedPoints& saved) {
    const glm::dvec3 position(point.position);
    const double depth = glm::dot(position, camera.forward);
    if (!(std::abs(depth - point.depth) <= camera.depth_slack * point.depth))
        return "depth: must be the position's own, within 2^-20";
    // The division near / depth of a device may be off by a few units in the last place.
    if (!(point.depth >= camera.near_plane * (1.0 - kDepthAgreement)))
        return "depth: must not be before the near plane";
    const double x = glm::dot(position, camera.right) / (depth * camera.tan_half_x);
    const double y = glm::dot(position, camera.up) / (depth * camera.tan_half_y);
    const double off_x = (0.5 + 0.5 * x) * saved.width - (point.pixel % saved.width + 0.5);
    const double off_y = (0.5 - 0.5 * y) * saved.height - (point.pixel / saved.width + 0.5);
    if (!(std::abs(off_x) <= 0.5 && std::abs(off_y) <= 0.5)) return "position: must project into its pixel";
    return "";
}

std::string broken_point(const SavedPoint& point, const Projection& camera, const SavedPoints& saved) {
    if (!is_finite(point.position)) return "position: must be finite";
    if (!(point.depth > 0.0f && point.depth < kFarthest)) return "depth: must be above 0 and below 1e18";
    if (!is_unit(point.normal)) return "normal: must have the length 1";
    return broken_projection(point, camera, saved);
}

std::string broken_order(const SavedPoints& saved) {
    const std::uint64_t pixels = std::uint64_t{saved.width} * saved.height;
    for (std::size_t i = 0; i < saved.points.size(); ++i) {
        const std::string field = "point " + std::to_string(i) + ": pixel " + std::to_string(saved.points[i].pixel);
        if (saved.points[i].pixel >= pixels) return field + ": must be below " + std::to_string(pixels);
        if (i > 0 && saved.points[i].pixel <= saved.points[i - 1].pixel)
            return field + ": must be above the one before";
    }
    return "";
}

} // namespace

std::string broken_rule(const SavedPoints& saved) {
    for (const std::string& broken :
         {broken_size(saved), broken_name("scene name", saved.scene), broken_name("camera name", saved.camera.name),
          broken_camera(saved.camera), broken_order(saved)})
        if (!broken.empty()) return broken;
    const Projection projection = projection_of(saved);
    for (const SavedPoint& point : saved.points) {
        const std::string broken = broken_point(point, projection, saved);
        if (!broken.empty()) return "point of pixel " + std::to_string(point.pixel) + ": " + broken;
    }
    return "";
}

std::string broken_material(const SavedPoints& saved, std::size_t material_count) {
    for (const SavedPoint& point : saved.points)
        if (point.material >= material_count)
            return "point of pixel " + std::to_string(point.pixel) + ": material " + std::to_string(point.material) +
                   ": must be below " + std::to_string(material_count) + ", the scene's number of them";
    return "";
}

} // namespace manylights::lab
