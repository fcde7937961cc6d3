// The library as any user would call it: create once, then plan and write every frame.

#include "lab/scene/error.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/producer.h"

#include <fmt/format.h>

namespace manylights::lab {

namespace {

struct Destroy {
    void operator()(ManylightsBuilder* builder) const { manylights_destroy(builder); }
};

void check(ManylightsStatus status, const ManylightsReport& report) {
    if (status == MANYLIGHTS_OK) return;
    throw InputError(
        fmt::format("{}: {} {} (element {})", manylights_status_name(status), report.field, report.rule, report.index));
}

std::uint32_t structure_of(StructureKind kind) {
    switch (kind) {
    case StructureKind::lists:
        return MANYLIGHTS_STRUCTURE_LISTS;
    case StructureKind::trees:
        return MANYLIGHTS_STRUCTURE_TREES;
    case StructureKind::windows:
        return MANYLIGHTS_STRUCTURE_WINDOWS;
    case StructureKind::hybrid:
        break;
    }
    return MANYLIGHTS_STRUCTURE_HYBRID;
}

class LibraryProducer : public Producer {
  public:
    explicit LibraryProducer(const StructureOptions& options) : options_(options) {}

    ManylightsSizes plan(const Frame& frame) override {
        create_for(slice_range(options_, frame.scene));
        const ManylightsView view = make_view(frame.camera, frame.width, frame.height);
        const ManylightsLights lights = public_lights(frame);
        ManylightsSizes sizes{};
        ManylightsReport report{};
        check(manylights_plan(builder_.get(), &view, 1, &lights, &sizes, &report), report);
        return sizes;
    }

    void write(const ManylightsBuffers& buffers) override {
        ManylightsReport report{};
        check(manylights_write(builder_.get(), &buffers, &report), report);
    }

    ProducerStats stats() const override {
        ManylightsStats stats{};
        manylights_stats(builder_.get(), &stats);
        return {stats.visible_lights, stats.references};
    }

  private:
    // The slices' range is the scene's, so the builder stays the same from frame to frame of one scene.
    void create_for(const SliceRange& slices) {
        if (builder_ && slices.near_edge == slices_.near_edge && slices.far_edge == slices_.far_edge) return;
        ManylightsSettings settings{};
        settings.size = sizeof settings;
        settings.structure = structure_of(options_.kind);
        settings.tile_px = options_.tile_size;
        settings.slice_count = options_.slice_count;
        settings.leaf_size = options_.leaf_size;
        settings.slice_near = slices.near_edge;
        settings.slice_far = slices.far_edge;
        ManylightsBuilder* builder = nullptr;
        ManylightsReport report{};
        check(manylights_create(&settings, &builder, &report), report);
        builder_.reset(builder);
        slices_ = slices;
    }

    StructureOptions options_;
    SliceRange slices_{};
    std::unique_ptr<ManylightsBuilder, Destroy> builder_;
};

} // namespace

std::unique_ptr<Producer> make_library_producer(const StructureOptions& options) {
    return std::make_unique<LibraryProducer>(options);
}

} // namespace manylights::lab
