#include "lab/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace manylights::lab {
namespace {

/// A vertex in camera space: x and y along the image, w the view depth.
struct CameraVertex {
    float x, y, w;
};

/// A polygon of 3 or 4 corners that lies in front of the near plane.
struct Clipped {
    std::array<CameraVertex, 4> corners;
    int count = 0;
};

Clipped clip_near(const std::array<CameraVertex, 3>& triangle, float near_plane) {
    Clipped result;
    for (int i = 0; i < 3; ++i) {
        const CameraVertex &a = triangle[std::size_t(i)], &b = triangle[std::size_t((i + 1) % 3)];
        if (a.w >= near_plane) result.corners[std::size_t(result.count++)] = a;
        if ((a.w >= near_plane) != (b.w >= near_plane)) {
            const float t = (near_plane - a.w) / (b.w - a.w);
            result.corners[std::size_t(result.count++)] = {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, near_plane};
        }
    }
    return result;
}

/// A depth buffer of 1 / depth, which is linear over the image, and the triangle seen.
class DepthBuffer {
  public:
    DepthBuffer(std::uint32_t width, std::uint32_t height, float near_plane)
        : width_(int(width)), height_(int(height)), farthest_inverse_(1.0f / near_plane),
          inverse_(std::size_t(width) * height, 0.0f), triangle_(inverse_.size(), kNone) {}

    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// Corners in pixels with 1 / depth in w. Both windings: files are not always oriented.
    void draw(CameraVertex a, CameraVertex b, CameraVertex c, std::uint32_t triangle) {
        const double area = (double(b.x) - a.x) * (double(c.y) - a.y) - (double(b.y) - a.y) * (double(c.x) - a.x);
        if (area == 0.0) return;
        const int x0 = first_center(std::min({a.x, b.x, c.x}), width_);
        const int x1 = first_center(std::max({a.x, b.x, c.x}), width_);
        const int y0 = first_center(std::min({a.y, b.y, c.y}), height_);
        const int y1 = first_center(std::max({a.y, b.y, c.y}), height_);
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                const double px = x + 0.5, py = y + 0.5;
                const double wb = ((px - a.x) * (double(c.y) - a.y) - (py - a.y) * (double(c.x) - a.x)) / area;
                const double wc = ((py - a.y) * (double(b.x) - a.x) - (px - a.x) * (double(b.y) - a.y)) / area;
                if (wb < 0.0 || wc < 0.0 || wb + wc > 1.0) continue;
                put(x, y, float(a.w + wb * (double(b.w) - a.w) + wc * (double(c.w) - a.w)), triangle);
            }
        }
    }

    float inverse(int x, int y) const { return inverse_[std::size_t(y * width_ + x)]; }
    std::uint32_t triangle(int x, int y) const { return triangle_[std::size_t(y * width_ + x)]; }

  private:
    /// The first pixel whose centre is at or right of the coordinate, within [0, size].
    static int first_center(float coordinate, int size) {
        return int(std::clamp(std::ceil(coordinate - 0.5f), 0.0f, float(size)));
    }

    void put(int x, int y, float inverse_depth, std::uint32_t triangle) {
        const auto at = std::size_t(y * width_ + x);
        if (inverse_depth <= inverse_[at]) return;
        inverse_[at] = std::min(inverse_depth, farthest_inverse_);
        triangle_[at] = triangle;
    }

    int width_, height_;
    float farthest_inverse_;
    std::vector<float> inverse_;
    std::vector<std::uint32_t> triangle_;
};

/// World space to image: camera axes, and pixels per unit of slope.
struct Projection {
    CameraBasis basis;
    glm::vec3 eye;
    float near_plane, scale, center_x, center_y;

    Projection(const Camera& camera, std::uint32_t width, std::uint32_t height)
        : basis(camera_basis(camera, width, height)), eye(camera.position), near_plane(camera.near_plane),
          scale(0.5f * float(height) / basis.tan_half_y), center_x(0.5f * float(width)),
          center_y(0.5f * float(height)) {}

    CameraVertex to_camera(const glm::vec3& position) const {
        const glm::vec3 p = position - eye;
        return {glm::dot(p, basis.right), glm::dot(p, basis.up), glm::dot(p, basis.forward)};
    }

    CameraVertex to_pixels(const CameraVertex& v) const {
        const float inverse = 1.0f / v.w;
        return {center_x + v.x * inverse * scale, center_y - v.y * inverse * scale, inverse};
    }

    glm::vec3 to_world(int x, int y, float depth) const {
        const float right = (float(x) + 0.5f - center_x) / scale, up = (center_y - float(y) - 0.5f) / scale;
        return eye + (basis.forward + basis.right * right + basis.up * up) * depth;
    }

    /// Every corner on the far side of one side of the image.
    bool outside(const std::array<CameraVertex, 3>& t) const {
        const auto all = [&](auto beyond) { return beyond(t[0]) && beyond(t[1]) && beyond(t[2]); };
        return all([&](const CameraVertex& v) { return v.w < near_plane; }) ||
               all([&](const CameraVertex& v) { return v.x > v.w * basis.tan_half_x; }) ||
               all([&](const CameraVertex& v) { return -v.x > v.w * basis.tan_half_x; }) ||
               all([&](const CameraVertex& v) { return v.y > v.w * basis.tan_half_y; }) ||
               all([&](const CameraVertex& v) { return -v.y > v.w * basis.tan_half_y; });
    }
};

void draw_scene(const Scene& scene, const Projection& projection, DepthBuffer& buffer) {
    for (std::size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
        std::array<CameraVertex, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = projection.to_camera(scene.vertices[scene.indices[i + k]].position);
        if (projection.outside(corners)) continue;
        const Clipped polygon = clip_near(corners, projection.near_plane);
        for (int k = 2; k < polygon.count; ++k)
            buffer.draw(projection.to_pixels(polygon.corners[0]),
                        projection.to_pixels(polygon.corners[std::size_t(k - 1)]),
                        projection.to_pixels(polygon.corners[std::size_t(k)]), std::uint32_t(i));
    }
}

} // namespace

std::vector<SurfacePoint> visible_points(const Scene& scene, const Camera& camera, std::uint32_t width,
                                         std::uint32_t height) {
    const Projection projection(camera, width, height);
    DepthBuffer buffer(width, height, camera.near_plane);
    draw_scene(scene, projection, buffer);
    std::vector<SurfacePoint> points;
    for (int y = 0; y < int(height); ++y) {
        for (int x = 0; x < int(width); ++x) {
            const std::uint32_t triangle = buffer.triangle(x, y);
            if (triangle == DepthBuffer::kNone) continue;
            const glm::vec3 position = projection.to_world(x, y, 1.0f / buffer.inverse(x, y));
            const Vertex& corner = scene.vertices[scene.indices[triangle]];
            glm::vec3 normal = corner.normal;
            if (glm::dot(normal, position - camera.position) > 0.0f) normal = -normal;
            points.push_back({position, normal, corner.material});
        }
    }
    return points;
}

} // namespace manylights::lab
