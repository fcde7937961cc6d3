#include "lab/scene/generated_cameras.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace manylights::lab {
namespace {

constexpr float kMostCells = 800'000.0f;

/// What the cells of a uniform grid over the bounds hold: how many triangles, and where they face on the whole.
class Occupancy {
  public:
    explicit Occupancy(const Scene& scene) : lower_(scene.bounds.lower) {
        const glm::vec3 extent = scene.bounds.upper - scene.bounds.lower;
        // Flat scenes get about as many cells as cubic ones, and no axis more than 1,000.
        edge_ = 0.001f * std::max({extent.x, extent.y, extent.z, 1e-6f});
        const auto cells = [&] {
            return (extent.x / edge_ + 1.0f) * (extent.y / edge_ + 1.0f) * (extent.z / edge_ + 1.0f);
        };
        while (cells() > kMostCells) edge_ *= 1.05f;
        for (int axis = 0; axis < 3; ++axis) size_[axis] = int(extent[axis] / edge_) + 1;
        cells_.resize(std::size_t(size_.x) * std::size_t(size_.y) * std::size_t(size_.z));
        for (std::size_t i = 0; i + 2 < scene.indices.size(); i += 3)
            add(scene.vertices[scene.indices[i]].position, scene.vertices[scene.indices[i + 1]].position,
                scene.vertices[scene.indices[i + 2]].position);
    }

    float edge() const { return edge_; }

    bool inside(const glm::vec3& p) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(p[axis] >= lower_[axis] && p[axis] < lower_[axis] + edge_ * float(size_[axis]))) return false;
        }
        return true;
    }

    bool full(const glm::vec3& p) const { return cells_[index(cell(p))].triangles != 0; }

    struct Ray {
        float length;
        std::uint32_t triangles; ///< in the cell that it hit; 0: it left the bounds
        bool front;              ///< that cell faces the ray's origin, or faces both ways
    };

    Ray trace(const glm::vec3& from, const glm::vec3& direction) const {
        for (float t = 0.0f;; t += 0.5f * edge_) {
            const glm::vec3 p = from + direction * t;
            if (!inside(p)) return {t, 0, false};
            const Cell& hit = cells_[index(cell(p))];
            if (hit.triangles != 0) return {t, hit.triangles, glm::dot(hit.facing, direction) <= 0.0f};
        }
    }

  private:
    struct Cell {
        std::uint32_t triangles = 0;
        glm::vec3 facing{0.0f}; ///< sum of unit normals
    };

    glm::ivec3 cell(const glm::vec3& p) const {
        glm::ivec3 c;
        for (int axis = 0; axis < 3; ++axis)
            c[axis] = int(std::clamp((p[axis] - lower_[axis]) / edge_, 0.0f, float(size_[axis] - 1)));
        return c;
    }

    std::size_t index(const glm::ivec3& c) const {
        return (std::size_t(c.z) * std::size_t(size_.y) + std::size_t(c.y)) * std::size_t(size_.x) + std::size_t(c.x);
    }

    /// Cells of the triangle's box that its plane passes through.
    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const glm::ivec3 first = cell(glm::min(a, glm::min(b, c))), last = cell(glm::max(a, glm::max(b, c)));
        const glm::vec3 normal = glm::cross(b - a, c - a);
        const float length = std::sqrt(glm::dot(normal, normal));
        if (!(length > 0.0f)) return;
        const float reach = 0.5f * edge_ * (std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z));
        for (int z = first.z; z <= last.z; ++z) {
            for (int y = first.y; y <= last.y; ++y) {
                for (int x = first.x; x <= last.x; ++x) {
                    const glm::vec3 center = lower_ + edge_ * (glm::vec3(x, y, z) + 0.5f);
                    if (std::fabs(glm::dot(normal, center - a)) > reach) continue;
                    Cell& touched = cells_[index({x, y, z})];
                    ++touched.triangles;
                    touched.facing += normal / length;
                }
            }
        }
    }

    glm::vec3 lower_;
    glm::ivec3 size_;
    float edge_;
    std::vector<Cell> cells_;
};

struct View {
    glm::vec3 eye, direction;
    float free_length; ///< along the direction
    float score;
};

glm::vec3 normalized(const glm::vec3& v) { return v / std::sqrt(glm::dot(v, v)); }

/// How much there is to see, per ray: long rays that end at finely modelled surfaces count most, those that leave the
/// scene nothing; walls close to the eye and surfaces seen from behind (the inside of a hull) count against the view.
View judge(const Occupancy& grid, const glm::vec3& eye, const glm::vec3& direction, float diagonal) {
    const glm::vec3 right = normalized(glm::cross(direction, {0.0f, 1.0f, 0.0f})), up = glm::cross(right, direction);
    View view{eye, direction, 0.0f, 0.0f};
    for (int y = -2; y <= 2; ++y) {
        for (int x = -3; x <= 3; ++x) {
            const glm::vec3 toward = normalized(direction + right * (0.3f * float(x)) + up * (0.25f * float(y)));
            const Occupancy::Ray ray = grid.trace(eye, toward);
            if (x == 0 && y == 0) view.free_length = ray.length;
            const float share = ray.length / diagonal;
            float worth = 0.0f;
            if (ray.triangles != 0) worth = share * float(std::bit_width(ray.triangles));
            if (ray.triangles != 0 && !ray.front) worth = -1.0f;
            if (share < 0.04f) worth = -1.0f;
            view.score += worth / 35.0f;
        }
    }
    return view;
}

/// Views from free cells at a few heights, eight directions each; slightly downwards from higher up.
std::vector<View> inside_views(const Scene& scene, const Occupancy& grid, float diagonal) {
    const glm::vec3 lower = scene.bounds.lower, extent = scene.bounds.upper - scene.bounds.lower;
    std::vector<View> views;
    for (int z = 0; z < 12; ++z) {
        for (int x = 0; x < 12; ++x) {
            for (const float height : {0.06f, 0.12f, 0.2f, 0.35f, 0.5f}) {
                const glm::vec3 eye =
                    lower + extent * glm::vec3((float(x) + 0.5f) / 12.0f, height, (float(z) + 0.5f) / 12.0f);
                if (grid.full(eye) || !grid.trace(eye, {0.0f, -1.0f, 0.0f}).front) continue;
                for (int k = 0; k < 8; ++k) {
                    constexpr float kHalf = 0.70710678f;
                    constexpr float kAround[8][2] = {{1, 0},  {kHalf, kHalf},   {0, 1},  {-kHalf, kHalf},
                                                     {-1, 0}, {-kHalf, -kHalf}, {0, -1}, {kHalf, -kHalf}};
                    const glm::vec3 direction = normalized({kAround[k][0], 0.05f - 0.5f * height, kAround[k][1]});
                    if (grid.trace(eye, direction).length > 0.05f * diagonal)
                        views.push_back(judge(grid, eye, direction, diagonal));
                }
            }
        }
    }
    std::stable_sort(views.begin(), views.end(), [](const View& a, const View& b) { return a.score > b.score; });
    return views;
}

/// The best views that differ from each other in place or direction.
std::vector<View> choose_different(const std::vector<View>& views, std::size_t count, float diagonal) {
    std::vector<View> chosen;
    for (const View& view : views) {
        const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const View& other) {
            const glm::vec3 apart = view.eye - other.eye;
            return std::sqrt(glm::dot(apart, apart)) < 0.25f * diagonal &&
                   glm::dot(view.direction, other.direction) > 0.3f;
        });
        if (!known) chosen.push_back(view);
        if (chosen.size() == count) break;
    }
    return chosen;
}

Camera camera_at(const std::string& name, const glm::vec3& eye, const glm::vec3& direction, float diagonal) {
    Camera camera;
    camera.name = name;
    camera.position = eye;
    camera.forward = direction;
    camera.near_plane = std::clamp(0.002f * diagonal, 1e-6f, 0.1f);
    return camera;
}

void use_inside_views(Scene& scene, const std::vector<View>& views, float diagonal) {
    for (std::size_t i = 0; scene.cameras.size() < 4; ++i)
        scene.cameras.push_back(
            camera_at("inside" + std::to_string(i + 1), views[i].eye, views[i].direction, diagonal));
    // Four frames per view, along its own free line, so that the path never enters a wall.
    for (int frame = 0; frame < 16; ++frame) {
        const View& view = views[std::size_t(frame / 4)];
        const glm::vec3 eye = view.eye + view.direction * (view.free_length * 0.2f * float(frame % 4));
        scene.path.push_back(camera_at("path", eye, view.direction, diagonal));
    }
}

/// From outside, around the bounds: an orbit on the circle's rational parametrisation, looking at the centre.
Camera outside_camera(const Scene& scene, const std::string& name, float turn, float height, float diagonal) {
    const float quarter_turns = 4.0f * turn;
    const int quarter = int(quarter_turns) % 4;
    const float t = quarter_turns - float(int(quarter_turns));
    const float c = (1.0f - t * t) / (1.0f + t * t), s = 2.0f * t / (1.0f + t * t);
    const glm::vec3 around[4] = {{c, height, s}, {-s, height, c}, {-c, height, -s}, {s, height, -c}};
    const glm::vec3 outwards = normalized(around[quarter]);
    const glm::vec3 center = 0.5f * (scene.bounds.lower + scene.bounds.upper);
    return camera_at(name, center + outwards * (0.95f * diagonal), -outwards, diagonal);
}

void use_outside_views(Scene& scene, float diagonal) {
    for (int i = 0; scene.cameras.size() < 4; ++i)
        scene.cameras.push_back(
            outside_camera(scene, "corner" + std::to_string(i + 1), 0.125f + 0.25f * float(i), 0.45f, diagonal));
    for (int frame = 0; frame < 16; ++frame)
        scene.path.push_back(outside_camera(scene, "path", float(frame) / 16.0f, 0.3f, diagonal));
}

} // namespace

void add_generated_cameras(Scene& scene) {
    const glm::vec3 extent = scene.bounds.upper - scene.bounds.lower;
    const float diagonal = std::max(std::sqrt(glm::dot(extent, extent)), 1e-6f);
    const Occupancy grid(scene);
    std::vector<View> views = choose_different(inside_views(scene, grid, diagonal), 4, diagonal);
    std::stable_sort(views.begin(), views.end(),
                     [](const View& a, const View& b) { return a.free_length > b.free_length; });
    float score = 0.0f;
    for (const View& view : views) score += view.score / 4.0f;
    // Rooms score 0.5 to 1.2, streets 0.2, a lone object with its surroundings in view 0.13, open terrain less than 0.
    if (views.size() == 4 && score > 0.18f)
        use_inside_views(scene, views, diagonal);
    else
        use_outside_views(scene, diagonal);
}

} // namespace manylights::lab
