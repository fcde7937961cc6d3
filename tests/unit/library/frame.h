#pragma once
// What the library's tests share: cameras, lights, a builder that cleans up, and a frame's buffers with the shader's
// own query over them.

#include "manylights/manylights.h"

#include <manylights/format.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace manylights::test {

// SplitMix64: the same numbers everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    float between(double low, double high) { return static_cast<float>(low + (high - low) * unit()); }

  private:
    std::uint64_t state_;
};

// How clip_from_view is written down.
enum class Projection { kStandard, kReversed, kInfinite, kReversedInfinite, kOpenGl };

struct CameraOptions {
    std::array<double, 3> position = {0, 0, 0};
    double yaw = 0.0;                  // radians, about world y
    bool looks_down_negative_z = true; // either way the camera looks along world -z at yaw 0
    Projection projection = Projection::kReversedInfinite;
    double tangent = 0.8; // of half the vertical field of view
    double near_depth = 0.1;
    double far_depth = 1000.0;
    std::uint32_t width = 320;
    std::uint32_t height = 180;
};

ManylightsView make_view(const CameraOptions& options = {});

// Spheres in a box, ranges between two bounds.
std::vector<ManylightsSphere> make_lights(std::uint32_t count, std::uint64_t seed, double half_size, double min_range,
                                          double max_range);

ManylightsLights lights_of(const std::vector<ManylightsSphere>& spheres);
ManylightsSettings settings_of(std::uint32_t structure);

struct DestroyBuilder {
    void operator()(ManylightsBuilder* builder) const { manylights_destroy(builder); }
};
using BuilderPtr = std::unique_ptr<ManylightsBuilder, DestroyBuilder>;
BuilderPtr make_builder(const ManylightsSettings& settings);

struct Frame {
    ManylightsSizes sizes{};
    std::vector<MlView> views;
    std::vector<float> slice_edges;
    std::vector<MlCell> cells;
    std::vector<MlNode> nodes;
    std::vector<MlUint> references;

    bool has_windows() const { return views.at(0).structure == ML_STRUCTURE_WINDOWS; }
    std::size_t reference_count() const { return references.size() / (has_windows() ? 2 : 1); }
    // Cells that stand for lights of their own (windows: tiles, whose headers are two cells each).
    std::size_t list_count() const;
    std::uint32_t cells_each() const { return has_windows() ? 2 : 1; }

    void allocate(const ManylightsSizes& planned);
    ManylightsBuffers buffers();
    std::string bytes() const; // of all buffers, for comparisons
};

// Plans and writes; fails the test where either fails.
Frame build_frame(ManylightsBuilder* builder, const std::vector<ManylightsView>& views,
                  const std::vector<ManylightsSphere>& spheres);

// The report of validate.
ManylightsReport validate(ManylightsBuilder* builder, Frame& frame, std::uint32_t light_count);

// The lights that the shader text hands out, in its order.
std::vector<MlUint> lights_at(const Frame& frame, std::uint32_t view, float x, float y, float depth);

// Every light of a cell once, whatever the depth: its references in order. Windows: of the tile whose header begins
// there.
std::vector<MlUint> lights_of_cell(const Frame& frame, std::uint32_t cell);

} // namespace manylights::test
