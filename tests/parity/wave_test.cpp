// The wave cursor on the device: lanes whose points lie anywhere in the image, lanes without a point, lanes that are
// missing or leave early; the device's own waves and emulated ones of every size.

#include "lab/gpu/commands.h"
#include "lab/gpu/compute_pipeline.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/shading_pass.h"
#include "lab/techniques/structure_buffers.h"
#include "reference/oracle/random.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <numeric>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kSubgroupCode[] =
#include "wave_masks_subgroup.comp.inc"
    ;
constexpr std::uint32_t kEmulatedCode[] =
#include "wave_masks_emulated.comp.inc"
    ;

/// As in wave_masks.glsl.
enum class Does : std::uint32_t { has_point, has_none, is_missing, leaves };
struct Lane {
    std::uint32_t pixel;
    Does does;
};
struct Found {
    std::uint32_t affecting, hash;
    bool operator==(const Found&) const = default;
};

/// wave_size 0: the device's own.
struct WaveKind {
    std::uint32_t wave_size, few;
};
constexpr WaveKind kOwn[] = {{0, 0}, {0, 12}, {0, 32}};
constexpr WaveKind kEmulated[] = {{4, 0}, {8, 0}, {8, 12}, {16, 0}, {32, 0}, {32, 12}, {64, 0}, {64, 12}, {64, 32}};

class WaveMasks : public TechniquesTest {
  protected:
    WaveMasks() : random_(31) {}

    void look_at(std::uint32_t width, std::uint32_t height, std::uint32_t light_count) {
        view_.emplace(made_view(device(), width, height, light_count));
        truth_ = records_of(device(), kBruteForce, view_->frame());
        lights_.emplace(device(), view_->frame());
    }

    void build(std::uint32_t tile_size) {
        StructureOptions options;
        options.kind = StructureKind::windows;
        options.tile_size = tile_size;
        const std::unique_ptr<Producer> producer = make_library_producer(options);
        buffers_.emplace(device());
        buffers_->reserve(producer->plan(view_->frame()));
        producer->write(buffers_->targets());
        buffers_->finish();
    }

    /// Every pixel once, and lanes without one up to a whole workgroup. rest: what lanes do that have no point.
    std::vector<Lane> make_lanes(bool in_disorder, const std::vector<Does>& rest) {
        std::vector<Lane> lanes(truth_.size());
        for (std::uint32_t i = 0; i < lanes.size(); ++i) lanes[i] = {i, Does::has_point};
        if (in_disorder)
            for (std::uint32_t i = static_cast<std::uint32_t>(lanes.size()); i > 1; --i)
                std::swap(lanes[i - 1], lanes[random_.below(i)]);
        for (Lane& lane : lanes)
            if (random_.chance(0.25)) lane.does = rest[random_.below(static_cast<std::uint32_t>(rest.size()))];
        lanes.resize((lanes.size() + 63) / 64 * 64, {0, rest.front()});
        return lanes;
    }

    std::vector<Found> run(const WaveKind& kind, const std::vector<Lane>& lanes) {
        gpu::ComputeShader shader;
        shader.name = "wave masks";
        shader.code = kind.wave_size == 0 ? std::span<const std::uint32_t>(kSubgroupCode) : kEmulatedCode;
        shader.buffer_count = 9;
        shader.push_constant_bytes = sizeof(std::uint32_t);
        shader.specialization = {std::max(kind.wave_size, 1u), kind.few};
        const gpu::ComputePipeline pipeline(device(), shader);
        const gpu::Buffer lane_buffer(device(), "lanes", std::span<const Lane>(lanes));
        gpu::Buffer found(device(), "found", lanes.size() * sizeof(Found));
        found.fill(0xCDCDCDCD);
        std::vector<gpu::Binding> bindings;
        for (const gpu::Buffer* buffer : buffers_->bindings()) bindings.push_back({*buffer});
        for (const gpu::Buffer* buffer : {&lights_->spheres, &view_->points.positions()}) bindings.push_back({*buffer});
        bindings.push_back({lane_buffer});
        bindings.push_back({found});
        gpu::Commands commands(device());
        commands.dispatch(pipeline, bindings, view_->width, {static_cast<std::uint32_t>(lanes.size() / 64), 1, 1});
        commands.submit_and_wait("wave masks");
        return found.download<Found>();
    }

    void expect_truth(const WaveKind& kind, const std::vector<Lane>& lanes, const std::string& what) {
        const std::vector<Found> found = run(kind, lanes);
        for (std::size_t i = 0; i < lanes.size(); ++i) {
            Found expected{0, 0};
            if (lanes[i].does == Does::is_missing) expected = {0xCDCDCDCD, 0xCDCDCDCD};
            if (lanes[i].does == Does::has_point)
                expected = {truth_[lanes[i].pixel].affecting, truth_[lanes[i].pixel].hash_a};
            ASSERT_EQ(found[i], expected)
                << what << ", waves of " << kind.wave_size << ", few " << kind.few << ", lane " << i << ": "
                << found[i].affecting << " lights instead of " << expected.affecting;
        }
    }

    void expect_truth(std::span<const WaveKind> kinds, const std::vector<Does>& rest) {
        for (const std::uint32_t tile_size : {8u, 20u, 24u, 32u, 4096u}) {
            build(tile_size);
            for (const WaveKind& kind : kinds)
                for (const bool in_disorder : {false, true})
                    ASSERT_NO_FATAL_FAILURE(
                        expect_truth(kind, make_lanes(in_disorder, rest), "tiles of " + std::to_string(tile_size)));
        }
    }

    const std::vector<PixelRecord>& truth() const { return truth_; }

  private:
    oracle::Random random_;
    std::optional<View> view_;
    std::vector<PixelRecord> truth_;
    std::optional<FrameLights> lights_;
    std::optional<StructureBuffers> buffers_;
};

} // namespace

TEST_F(WaveMasks, lanes_without_a_point_take_part_in_emulated_waves) {
    look_at(49, 35, 900);
    expect_truth(kEmulated, {Does::has_none});
}

TEST_F(WaveMasks, lanes_of_the_devices_waves_may_be_missing_and_may_leave) {
    ASSERT_TRUE(device().info().has_wave_operations);
    look_at(49, 35, 900);
    expect_truth(kOwn, {Does::has_none});
    expect_truth(kOwn, {Does::is_missing});
    expect_truth(kOwn, {Does::has_none, Does::is_missing, Does::leaves});
}

// Tiles of more than 65,535 references.
TEST_F(WaveMasks, wide_tiles_are_exact) {
    look_at(48, 48, 70000);
    build(4096);
    for (const WaveKind& kind : {kOwn[1], kEmulated[5], kEmulated[7]})
        expect_truth(kind, make_lanes(true, {Does::has_none}), "a wide tile");
}

} // namespace manylights::lab
