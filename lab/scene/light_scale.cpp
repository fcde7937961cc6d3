#include "lab/scene/light_scale.h"

#include <algorithm>
#include <cmath>

namespace manylights::lab {
namespace {

/// Points sorted into the cells of a uniform grid.
class PointGrid {
  public:
    explicit PointGrid(std::span<const glm::vec3> points) {
        lower_ = upper_ = points.front();
        for (const glm::vec3& point : points) {
            lower_ = glm::min(lower_, point);
            upper_ = glm::max(upper_, point);
        }
        const glm::vec3 extent = upper_ - lower_;
        edge_ = std::max({extent.x, extent.y, extent.z, 1e-6f}) / float(kMostCells);
        for (int axis = 0; axis < 3; ++axis) size_[axis] = int(extent[axis] / edge_) + 1;
        sort(points);
    }

    /// Calls visit(squared distance) for the points closer than radius.
    template <typename Visit>
    void for_each_within(const glm::vec3& center, float radius, Visit&& visit) const {
        const glm::ivec3 first = cell(center - radius), last = cell(center + radius);
        const double limit = double(radius) * double(radius);
        for (int axis = 0; axis < 3; ++axis) {
            if (center[axis] + radius < lower_[axis] || center[axis] - radius > upper_[axis]) return;
        }
        for (int z = first.z; z <= last.z; ++z) {
            for (int y = first.y; y <= last.y; ++y) {
                // Cells of a row lie side by side, and so do their points.
                const std::size_t begin = starts_[index({first.x, y, z})], end = starts_[index({last.x, y, z}) + 1];
                for (std::size_t i = begin; i < end; ++i) {
                    const double squared = squared_distance(points_[i], center);
                    if (squared < limit) visit(squared);
                }
            }
        }
    }

  private:
    static constexpr int kMostCells = 64; // along the longest axis

    static double squared_distance(const glm::vec3& a, const glm::vec3& b) {
        const double x = double(a.x) - b.x, y = double(a.y) - b.y, z = double(a.z) - b.z;
        return x * x + y * y + z * z;
    }

    glm::ivec3 cell(const glm::vec3& point) const {
        glm::ivec3 result;
        for (int axis = 0; axis < 3; ++axis)
            result[axis] = int(std::clamp((point[axis] - lower_[axis]) / edge_, 0.0f, float(size_[axis] - 1)));
        return result;
    }

    std::size_t index(const glm::ivec3& c) const {
        return (std::size_t(c.z) * std::size_t(size_.y) + std::size_t(c.y)) * std::size_t(size_.x) + std::size_t(c.x);
    }

    void sort(std::span<const glm::vec3> points) {
        starts_.assign(std::size_t(size_.x) * std::size_t(size_.y) * std::size_t(size_.z) + 2, 0);
        for (const glm::vec3& point : points) ++starts_[index(cell(point)) + 2];
        for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
        points_.resize(points.size());
        for (const glm::vec3& point : points) points_[starts_[index(cell(point)) + 1]++] = point;
        starts_.pop_back();
    }

    glm::vec3 lower_, upper_;
    glm::ivec3 size_;
    float edge_ = 1.0f;
    std::vector<std::size_t> starts_;
    std::vector<glm::vec3> points_;
};

/// (distance / radius)^2 of all pairs where it is below scale^2: the pair's light affects its point from there on.
std::vector<double> ratios_below(const PointGrid& grid, std::span<const Light> lights, float scale) {
    std::vector<double> ratios;
    for (const Light& light : lights) {
        const auto& [center, range] = light.sphere;
        const double inverse = 1.0 / (double(range) * double(range));
        if (!(range > 0.0f)) continue;
        grid.for_each_within({center[0], center[1], center[2]}, scale * range,
                             [&](double squared) { ratios.push_back(squared * inverse); });
    }
    return ratios;
}

} // namespace

float find_radius_scale(std::span<const glm::vec3> points, std::span<const Light> lights, double wanted, float cap) {
    if (points.empty() || lights.empty()) return cap;
    const PointGrid grid(points);
    const auto pairs = std::size_t(wanted * double(points.size()));
    // The number of pairs grows with the cube of the scale, so start small and stop as soon as there are enough.
    for (float scale = cap / 64.0f;; scale = std::min(2.0f * scale, cap)) {
        std::vector<double> ratios = ratios_below(grid, lights, scale);
        if (ratios.size() > pairs) {
            std::nth_element(ratios.begin(), ratios.begin() + std::ptrdiff_t(pairs), ratios.end());
            return float(std::sqrt(ratios[pairs]));
        }
        if (scale >= cap) return cap;
    }
}

} // namespace manylights::lab
