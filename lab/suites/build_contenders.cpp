#include "lab/suites/build_contenders.h"

#include "lab/scene/error.h"
#include "reference/paper/pipeline.h"

#include <manylights/manylights.hpp>
#if defined(MANYLIGHTS_SUITES_HAVE_TBB)
#include <manylights/manylights_tbb.hpp>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace manylights::lab::suites {
namespace {

void check(const Status& status) {
    if (!status)
        throw InputError(fmt::format("build: {}: {} {}", status.name(), status.report.field, status.report.rule));
}

class PaperContender : public Contender {
  public:
    void build(const BuildFrame& frame) override {
        buffers_ = &pipeline_.build({&frame.view, 1}, frame.lights(), options_);
    }
    BuildCounts counts() const override {
        const paper::Buffers& b = *buffers_;
        return {options_.tile_px, b.cells.size() / (b.slice_edges.size() - 1), b.visible_lights, b.references.size(),
                b.views.size_bytes() + b.slice_edges.size_bytes() + b.cells.size_bytes() + b.nodes.size_bytes() +
                    b.references.size_bytes()};
    }

  private:
    paper::Options options_;
    paper::PaperPipeline pipeline_;
    const paper::Buffers* buffers_ = nullptr;
};

/// A buffer that only grows, aligned to 16 bytes.
class Memory {
  public:
    void* hold(std::uint64_t bytes) {
        const auto count = static_cast<std::size_t>(bytes / sizeof(Unit) + 1);
        if (units_.size() < count) units_.resize(count);
        return units_.data();
    }

  private:
    struct alignas(16) Unit {
        std::byte bytes[16];
    };
    std::vector<Unit> units_;
};

class LibraryContender : public Contender {
  public:
    explicit LibraryContender(const BuilderChoice& choice)
        : has_windows_(choice.structure == MANYLIGHTS_STRUCTURE_WINDOWS) {
        ManylightsSettings settings = make_settings();
        settings.structure = choice.structure;
        settings.tile_px = choice.tile_px;
#if defined(MANYLIGHTS_SUITES_HAVE_TBB)
        if (choice.threads > 1) {
            arena_ = std::make_unique<tbb::task_arena>(static_cast<int>(choice.threads));
            use_tbb(settings, arena_.get());
        }
#endif
        check(builder_.create(settings));
    }
    void build(const BuildFrame& frame) override {
        ManylightsSizes sizes{};
        check(builder_.plan({&frame.view, 1}, frame.lights(), sizes));
        check(builder_.write({memory_[0].hold(sizes.views), memory_[1].hold(sizes.slice_edges),
                              memory_[2].hold(sizes.cells), memory_[3].hold(sizes.nodes),
                              memory_[4].hold(sizes.references)}));
    }
    BuildCounts counts() const override {
        const ManylightsStats stats = builder_.stats();
        return {stats.tile_px, has_windows_ ? stats.cells : 0, stats.visible_lights, stats.references, stats.bytes};
    }

  private:
#if defined(MANYLIGHTS_SUITES_HAVE_TBB)
    std::unique_ptr<tbb::task_arena> arena_; // outlives the builder
#endif
    bool has_windows_;
    Builder builder_;
    Memory memory_[5];
};

class FloorContender : public Contender {
  public:
    explicit FloorContender(const BuildCounts& of) : counts_(of) {
        const std::uint64_t tiles = std::max<std::uint64_t>(of.tiles, 1);
        stream_.resize(of.references);
        scattered_.resize(of.references);
        begins_.resize(tiles + 1);
        for (std::uint64_t i = 0; i < of.references; ++i) ++begins_[tile_of(i) + 1];
        for (std::uint64_t t = 0; t < tiles; ++t) begins_[t + 1] += begins_[t];
        cursors_.resize(tiles);
    }
    void build(const BuildFrame& frame) override {
        const std::uint32_t sum = read(frame.spheres);
        for (std::uint64_t i = 0; i < stream_.size(); ++i)
            stream_[i] = {tile_of(i), sum + static_cast<std::uint32_t>(i)};
        std::copy(begins_.begin(), begins_.end() - 1, cursors_.begin());
        for (const Record& record : stream_) scattered_[cursors_[record.tile]++] = record;
    }
    BuildCounts counts() const override { return {counts_.tile_px, counts_.tiles, 0, counts_.references, 0}; }

  private:
    struct Record {
        std::uint32_t tile, light;
    };

    std::uint32_t tile_of(std::uint64_t i) const {
        const std::uint32_t hash = static_cast<std::uint32_t>(i) * 2654435761u; // Knuth, TAOCP 3, section 6.4
        return static_cast<std::uint32_t>((std::uint64_t{hash} * (begins_.size() - 1)) >> 32);
    }
    // Four sums that do not wait for each other; whole numbers, so the compiler may use vectors.
    static std::uint32_t read(const std::vector<ManylightsSphere>& spheres) {
        std::uint32_t sums[4] = {};
        for (const ManylightsSphere& sphere : spheres) {
            std::uint32_t words[4];
            static_assert(sizeof(words) == sizeof(sphere));
            std::memcpy(words, &sphere, sizeof(words));
            for (int i = 0; i < 4; ++i) sums[i] += words[i];
        }
        return sums[0] + sums[1] + sums[2] + sums[3];
    }

    BuildCounts counts_;
    std::vector<Record> stream_, scattered_;
    std::vector<std::uint64_t> begins_;
    std::vector<std::uint64_t> cursors_;
};

} // namespace

ManylightsLights BuildFrame::lights() const { return make_lights(spheres); }

std::unique_ptr<Contender> make_paper_contender() { return std::make_unique<PaperContender>(); }

std::unique_ptr<Contender> make_library_contender(const BuilderChoice& choice) {
    return std::make_unique<LibraryContender>(choice);
}

std::unique_ptr<Contender> make_floor_contender(const BuildCounts& of) { return std::make_unique<FloorContender>(of); }

bool has_threads() {
#if defined(MANYLIGHTS_SUITES_HAVE_TBB)
    return true;
#else
    return false;
#endif
}

} // namespace manylights::lab::suites
