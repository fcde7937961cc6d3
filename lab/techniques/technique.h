#pragma once
// A technique finds, for every shaded point, the lights that reach it. One interface for all of them, brute force
// included, so that one harness proves and measures them alike.

#include "lab/scene/scene.h"
#include "lab/techniques/wave_cost.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace manylights::lab {

namespace gpu {
class Device;
class Buffer;
} // namespace gpu
struct PointLists; // lab/techniques/point_lists.h: the lights of each point
class PointBuffer; // lab/renderer/point_buffer.h: what is shaded

/// What shading one pixel found. The sums of hashes identify the set of affecting lights whatever the order was; the
/// `front` set holds those with N.L > 0. Radiance is fixed point, 2^-20, so its sum does not depend on the order
/// either. 64 bytes, the same text as record.glsl's.
struct PixelRecord {
    std::uint32_t affecting, hash_a, hash_b;
    std::uint32_t front, front_hash_a, front_hash_b;
    std::uint32_t tested, nodes, references;
    std::uint32_t shaded; ///< 0: sky, nothing was shaded
    std::int64_t radiance[3];
};
static_assert(sizeof(PixelRecord) == 64);

struct OptionInfo {
    std::string key, meaning, values; ///< values: the range or the choices, and the default
};

struct TechniqueInfo {
    std::string name, summary;
    std::vector<OptionInfo> options;
    bool needs_depth = false;
    bool serves_translucent = true;
    bool serves_air = true;
    bool exact = true;
};

using OptionValues = std::vector<std::pair<std::string, std::string>>;

/// One frame's input: what a renderer has at hand.
struct Frame {
    const Scene& scene;
    Camera camera;
    std::uint32_t width, height;
    std::span<const Light> lights;
    const PointBuffer& points; ///< on the device
    /// Of its points, where the caller has them already; `exact` finds its own otherwise.
    const PointLists* lists = nullptr;
};

/// A part of the work by its name, and what it took in each repeat.
struct NamedTimes {
    std::string name;
    std::vector<double> ms;
};

struct TechniqueStats {
    std::uint64_t visible_lights = 0;
    std::uint64_t references = 0;
    std::uint64_t structure_bytes = 0;
    std::vector<double> build_ms; ///< of each repeat; empty where there is no build that a frame could pay
    std::vector<double> shade_ms;
    std::vector<NamedTimes> stages; ///< of each build: CPU time by stage
};

/// How pixels of an image map to what kind of cell served them (figure 3 of Tiled Light Trees).
enum class CellClass : std::uint8_t { none, list, tree, mixed };

class Technique {
  public:
    virtual ~Technique() = default;
    virtual const TechniqueInfo& info() const = 0;

    /// Builds the frame's structures and makes them ready on the device. May be called again with another frame, which
    /// starts the times anew.
    virtual void prepare(const Frame& frame) = 0;

    /// Builds the frame of the last prepare once more, into the memory that is there: what a renderer pays every frame.
    /// Adds to build_ms.
    virtual void rebuild(const Frame& frame) = 0;

    /// Shades every point and hands back a record per pixel, row by row. Counters are always filled here.
    virtual std::vector<PixelRecord> record(const Frame& frame) = 0;

    /// Shades every point without counters into linear radiance, RGB floats per pixel. Repeatable; adds to shade_ms.
    virtual std::vector<float> shade(const Frame& frame) = 0;

    /// What the sampled waves of this frame do: the modelled cost (docs/measuring.md). The same in every run.
    virtual WaveSummary waves(const Frame& frame) = 0;

    /// Mean over the shaded points of the references that are read and whose own depths hold the point's: as few as
    /// could be compared without a rectangle. Empty where references have no depths.
    virtual std::optional<double> references_in_range(const Frame& frame);

    /// Per pixel of the image: which kind of cell a tile's pixels walk. Empty where the technique has no cells.
    virtual std::vector<CellClass> classify(const Frame& frame) = 0;

    /// Test hook: takes one light that affects a point of this frame out of one cell of the built structure, so that a
    /// test can watch the proof fail. False where the technique cannot.
    virtual bool remove_one_reference(const Frame& frame) = 0;

    const TechniqueStats& stats() const { return stats_; }
    /// Drops the times so far, not the counts.
    void forget_times();

  protected:
    TechniqueStats stats_;
};

std::vector<TechniqueInfo> technique_infos();

/// Throws InputError: unknown technique, unknown option, value out of range; each names the choices.
std::unique_ptr<Technique> make_technique(gpu::Device& device, const std::string& name, const OptionValues& options);

} // namespace manylights::lab
