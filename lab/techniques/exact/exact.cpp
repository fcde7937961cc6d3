#include "lab/techniques/exact/exact.h"

#include "lab/techniques/exact/list_bands.h"
#include "lab/techniques/options.h"
#include "lab/techniques/shading_pass.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kRecordCode[] =
#include "exact_record.comp.inc"
    ;
constexpr std::uint32_t kShadeCode[] =
#include "exact_shade.comp.inc"
    ;
constexpr std::uint32_t kLogCode[] =
#include "exact_log.comp.inc"
    ;

// Lights that affect any point.
std::uint64_t count_distinct(std::span<const std::uint32_t> lights, std::size_t light_count) {
    std::vector<bool> is_listed(light_count, false);
    for (const std::uint32_t light : lights) is_listed.at(light) = true;
    return static_cast<std::uint64_t>(std::ranges::count(is_listed, true));
}

class Exact : public Technique {
  public:
    Exact(gpu::Device& device, const OptionValues& options)
        : device_(device), info_(exact_info()),
          pass_(device, {info_.name, kRecordCode, kShadeCode, kLogCode, 2}, LightSplit::none) {
        const OptionReader checked(info_, options);
    }

    const TechniqueInfo& info() const override { return info_; }

    // No time: it would be the oracle's, and no frame could pay it.
    void prepare(const Frame& frame) override {
        lights_.emplace(device_, frame);
        stats_ = {};
        if (frame.lists != nullptr)
            take(*frame.lists, frame);
        else
            take(find_point_lists(frame, frame.points.download_positions()), frame);
    }

    void rebuild(const Frame&) override {}

    std::vector<PixelRecord> record(const Frame& frame) override {
        return pass_.record(frame, lights_.value(), lists_.value().bands());
    }

    std::vector<float> shade(const Frame& frame) override {
        return pass_.shade(frame, lights_.value(), lists_.value().bands(), stats_.shade_ms);
    }

    WaveSummary waves(const Frame& frame) override {
        return pass_.waves(frame, lights_.value(), lists_.value().bands());
    }

    std::vector<CellClass> classify(const Frame&) override { return {}; }

    // Every light of a list affects its point, so any will do: it becomes the padding light behind the last.
    bool remove_one_reference(const Frame&) override {
        return lists_.value().overwrite_first(lights_.value().stream.light_count());
    }

  private:
    void take(const PointLists& lists, const Frame& frame) {
        if (lists.first.size() != std::size_t{frame.width} * frame.height + 1)
            throw std::invalid_argument("exact: the frame's lists are of an image of another size");
        lists_.emplace(device_, lists, frame.width, frame.height);
        stats_.visible_lights = count_distinct(lists.lights, frame.lights.size());
        stats_.references = lists.lights.size();
        stats_.structure_bytes = lists_->bytes();
    }

    gpu::Device& device_;
    TechniqueInfo info_;
    std::optional<FrameLights> lights_;
    std::optional<ListBands> lists_;
    ShadingPass pass_;
};

} // namespace

TechniqueInfo exact_info() {
    TechniqueInfo info;
    info.name = "exact";
    info.summary = "each pixel's perfect list, precomputed: the limit";
    return info;
}

std::unique_ptr<Technique> make_exact(gpu::Device& device, const OptionValues& options) {
    return std::make_unique<Exact>(device, options);
}

} // namespace manylights::lab
