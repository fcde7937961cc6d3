#include "lab/techniques/brute_force/brute_force.h"

#include "lab/techniques/options.h"
#include "lab/techniques/shading_pass.h"

#include <optional>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kRecordCode[] =
#include "brute_force_record.comp.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "brute_force_shade.comp.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "brute_force_log.comp.inc"
    ;

class BruteForce : public Technique {
  public:
    BruteForce(gpu::Device& device, const OptionValues& options)
        : device_(device), info_(brute_force_info()),
          pass_(device, {info_.name, kRecordCode, kShadeCode, kLogCode, 0}, LightSplit::bounded) {
        const OptionReader checked(info_, options);
    }

    const TechniqueInfo& info() const override { return info_; }

    void prepare(const Frame& frame) override {
        lights_.emplace(device_, frame);
        stats_ = {};
        stats_.visible_lights = frame.lights.size();
    }

    void rebuild(const Frame&) override {}

    std::vector<PixelRecord> record(const Frame& frame) override {
        return pass_.record(frame, lights_.value(), one_band(frame, {}));
    }

    std::vector<float> shade(const Frame& frame) override {
        return pass_.shade(frame, lights_.value(), one_band(frame, {}), stats_.shade_ms);
    }

    // The union of what a wave's lanes test is all lights by definition, so the log is spared them.
    WaveSummary waves(const Frame& frame) override {
        return pass_.waves(frame, lights_.value(), one_band(frame, {}), frame.lights.size());
    }

    std::vector<CellClass> classify(const Frame&) override { return {}; }
    bool remove_one_reference(const Frame&) override { return false; }

  private:
    gpu::Device& device_;
    TechniqueInfo info_;
    std::optional<FrameLights> lights_;
    ShadingPass pass_;
};

} // namespace

TechniqueInfo brute_force_info() {
    TechniqueInfo info;
    info.name = "brute_force";
    info.summary = "every light for every point: what is right";
    return info;
}

std::unique_ptr<Technique> make_brute_force(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<BruteForce>(device, options);
}

} // namespace manylights::lab
