// The waves' figures of every technique against unions made on the host: the library's query is replayed lane by lane
// over the structure read back, and the oracle says which lights affect a point.

#include "lab/scene/error.h"
#include "lab/techniques/host_structure.h"
#include "lab/techniques/producer.h"
#include "lab/techniques/shading_pass.h"
#include "tests/parity/techniques_fixture.h"

#include <array>
#include <functional>
#include <set>

namespace manylights::lab {

namespace {

// With the log form in all places: the pass dispatches no other here.
constexpr std::uint32_t kLogCode[] =
#include "cursor_log.comp.inc"
    ;
constexpr std::uint32_t kMadeCode[] =
#include "waves_made.comp.inc"
    ;

struct ImageSize {
    std::uint32_t width, height;
};
// One lane, less than a block, blocks cut by the image's edges, and so many blocks that one in eight is sampled.
constexpr ImageSize kSizes[] = {{1, 1}, {7, 3}, {8, 5}, {47, 33}, {97, 60}, {130, 75}};

using Lanes = std::array<std::set<MlUint>, kTouchKinds>; ///< of a wave, by kind

struct Query {
    const HostStructure& structure;
    Lanes& lanes;

    bool has_windows() const { return structure.view.structure == ML_STRUCTURE_WINDOWS; }

    const MlNode& touched_node(MlUint i) {
        lanes[kTouchNode].insert(2 * i);
        return structure.nodes[i];
    }
    const MlCell& touched_cell(MlUint i) {
        lanes[kTouchNode].insert(i / 2 * 2 + 1);
        return structure.cells[i];
    }
    MlUint touched_reference(MlUint i) {
        if (has_windows() && i % 2 == 1) lanes[kTouchCheck].insert(i / 2);
        return structure.references[i];
    }
#define ML_SLICE_EDGE(i) structure.slice_edges[i]
#define ML_CELL(i) touched_cell(i)
#define ML_NODE(i) touched_node(i)
#define ML_REFERENCE(i) touched_reference(i)
#include <manylights/query.h>
};

bool affects(const PointPosition& point, const glm::vec4& sphere) {
    const MlFloat3 position{point.position.x, point.position.y, point.position.z};
    return ml_affects(position, {sphere.x, sphere.y, sphere.z}, sphere.w);
}

/// The lights by the query over a structure; without one, those that affect the point.
void touch_pixel(const View& view, std::size_t pixel, const HostStructure* structure, const LightStream& lights,
                 Lanes& lanes) {
    const PointPosition& point = view.positions[pixel];
    if (point.depth == 0.0f) return;
    lanes[kTouchLane].insert(0);
    if (structure == nullptr) {
        for (const MlUint light : affecting_lights(lights, point.position)) lanes[kTouchAffecting].insert(light);
        return;
    }
    Query query{*structure, lanes};
    const MlFloat2 center{static_cast<float>(pixel % view.width) + 0.5f, static_cast<float>(pixel / view.width) + 0.5f};
    Query::MlCursor cursor = query.ml_begin(structure->view, center, point.depth);
    MlUint light = 0;
    while (query.ml_next(cursor, light)) {
        lanes[kTouchTested].insert(light);
        if (affects(point, lights.spheres[light])) lanes[kTouchAffecting].insert(light);
    }
}

using StructureOfRow = std::function<const HostStructure*(std::uint32_t y)>;

WaveWork expected_work(const View& view, std::uint32_t wave_rows, const StructureOfRow& structure_of) {
    const LightStream lights = make_light_stream(view.frame());
    const std::uint32_t blocks_x = (view.width + 7) / 8;
    WaveWork work;
    for (const std::uint32_t block : sampled_blocks(view.width, view.height)) {
        for (std::uint32_t row = 0; row < 8; row += wave_rows) {
            Lanes lanes;
            for (std::uint32_t y = block / blocks_x * 8 + row; y < block / blocks_x * 8 + row + wave_rows; ++y)
                for (std::uint32_t x = block % blocks_x * 8; x < block % blocks_x * 8 + 8; ++x)
                    if (x < view.width && y < view.height)
                        touch_pixel(view, std::size_t{y} * view.width + x, structure_of(y), lights, lanes);
            work.waves += lanes[kTouchLane].size();
            work.tested += lanes[kTouchTested].size();
            work.affecting += lanes[kTouchAffecting].size();
            work.nodes += lanes[kTouchNode].size();
            work.checks += lanes[kTouchCheck].size();
        }
    }
    return work;
}

/// The structure of a technique with default options, as its own buffers have it.
class Built {
  public:
    Built(gpu::Device& device, StructureKind kind, const Frame& frame) : buffers_(device) {
        StructureOptions options;
        options.kind = kind;
        if (kind == StructureKind::windows) options.tile_size = 0;
        const std::unique_ptr<Producer> producer = make_library_producer(options);
        buffers_.reserve(producer->plan(frame));
        producer->write(buffers_.targets());
        buffers_.finish();
    }
    HostStructure on_host() const { return HostStructure(buffers_.bindings()); }
    std::vector<PassBand> band(const Frame& frame) const { return one_band(frame, buffers_.bindings()); }

  private:
    StructureBuffers buffers_;
};

struct Kind {
    const char* technique;
    StructureKind kind;
};
constexpr Kind kKinds[] = {{"clustered", StructureKind::lists},
                           {"tiled_light_trees", StructureKind::trees},
                           {"hybrid_light_trees", StructureKind::hybrid},
                           {"depth_windows", StructureKind::windows}};

WaveSummary waves_of(gpu::Device& device, const char* name, const Frame& frame) {
    const std::unique_ptr<Technique> technique = make_technique(device, name, {});
    technique->prepare(frame);
    const WaveSummary summary = technique->waves(frame);
    EXPECT_EQ(technique->waves(frame), summary) << name << ", a second time";
    return summary;
}

std::string text_of(const char* technique, ImageSize size) {
    return std::string(technique) + ", " + std::to_string(size.width) + "x" + std::to_string(size.height);
}

WaveWork expected_work(const View& view, std::uint32_t wave_rows, const HostStructure* structure) {
    return expected_work(view, wave_rows, [structure](std::uint32_t) { return structure; });
}

WaveWork brute_force_work(const View& view, std::uint32_t wave_rows) {
    WaveWork work = expected_work(view, wave_rows, nullptr);
    work.tested = work.waves * view.lights.size();
    return work;
}

class Waves : public TechniquesTest {};

} // namespace

void PrintTo(const WaveWork& work, std::ostream* out) {
    *out << work.waves << " waves, " << work.tested << " tested, " << work.affecting << " affecting, " << work.nodes
         << " nodes, " << work.checks << " checks, " << work.batches << " batches";
}

TEST_F(Waves, of_structures_are_unions_of_what_the_query_touches) {
    for (const ImageSize size : kSizes) {
        const View view = made_view(device(), size.width, size.height, 700);
        for (const Kind& kind : kKinds) {
            const HostStructure structure = Built(device(), kind.kind, view.frame()).on_host();
            const WaveSummary summary = waves_of(device(), kind.technique, view.frame());
            EXPECT_EQ(summary.lanes_64, expected_work(view, 8, &structure)) << text_of(kind.technique, size);
            EXPECT_EQ(summary.lanes_32, expected_work(view, 4, &structure)) << text_of(kind.technique, size);
            EXPECT_EQ(summary.lanes_64.nodes > 0, summary.lanes_64.waves > 0);
            EXPECT_EQ(summary.lanes_64.checks > 0, kind.kind == StructureKind::windows && summary.lanes_64.waves > 0);
        }
    }
}

// Where every rectangle is the whole tile, the query hands out what holds the depth, and nothing else.
TEST_F(Waves, references_in_range_are_those_handed_out_whatever_their_rectangles) {
    const View view = made_view(device(), 130, 75, 3000);
    HostStructure structure = Built(device(), StructureKind::windows, view.frame()).on_host();
    const double in_range = mean_references_in_range(structure, view.positions);
    EXPECT_GT(in_range, 0.0);
    for (std::size_t i = 1; i < structure.references.size(); i += 2)
        structure.references[i] = (structure.references[i] & 0xFFFFu) | ml_pack_bounds(0, 0, 0, 15, 0, 15);
    EXPECT_EQ(mean_references_in_range(structure, view.positions), in_range);
    std::uint64_t handed_out = 0, shaded = 0;
    Lanes lanes;
    Query query{structure, lanes};
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
        if (view.positions[pixel].depth == 0.0f) continue;
        ++shaded;
        const MlFloat2 center{static_cast<float>(pixel % view.width) + 0.5f,
                              static_cast<float>(pixel / view.width) + 0.5f};
        Query::MlCursor cursor = query.ml_begin(structure.view, center, view.positions[pixel].depth);
        for (MlUint light = 0; query.ml_next(cursor, light);) ++handed_out;
    }
    EXPECT_EQ(in_range, static_cast<double>(handed_out) / static_cast<double>(shaded));
}

// A wave of 64 and one of 32 see different points together, whatever the waves of the device are.
TEST_F(Waves, that_work_together_are_those_of_the_model) {
    for (const ImageSize size : kSizes) {
        const View view = made_view(device(), size.width, size.height, 700);
        const HostStructure structure = Built(device(), StructureKind::windows, view.frame()).on_host();
        const WaveWork alone_64 = expected_work(view, 8, &structure), alone_32 = expected_work(view, 4, &structure);
        const WaveSummary summary = waves_of(device(), "depth_windows_wave", view.frame());
        for (const char* wave : {"4", "64"}) {
            const std::unique_ptr<Technique> other = make_technique(device(), "depth_windows_wave", {{"wave", wave}});
            other->prepare(view.frame());
            EXPECT_EQ(other->waves(view.frame()), summary) << text_of(wave, size);
        }
        EXPECT_EQ(summary.lanes_64.waves, alone_64.waves);
        EXPECT_EQ(summary.lanes_32.waves, alone_32.waves);
        EXPECT_EQ(summary.lanes_64.affecting, alone_64.affecting);
        EXPECT_EQ(summary.lanes_32.affecting, alone_32.affecting);
        EXPECT_GE(summary.lanes_64.tested, alone_64.affecting);
        EXPECT_GE(summary.lanes_32.tested, alone_32.affecting);
        EXPECT_LT(summary.lanes_64.checks, alone_64.checks);
        EXPECT_GT(summary.lanes_64.batches, 0u);
        if (size.width < 47) continue;
        EXPECT_GT(summary.lanes_32.batches * summary.lanes_64.waves, summary.lanes_64.batches * summary.lanes_32.waves)
            << "batches are of fewer candidates";
    }
}

TEST_F(Waves, of_brute_force_test_every_light) {
    for (const ImageSize size : kSizes) {
        const View view = made_view(device(), size.width, size.height, 300);
        const WaveSummary summary = waves_of(device(), "brute_force", view.frame());
        EXPECT_EQ(summary.lanes_64, brute_force_work(view, 8)) << text_of("brute_force", size);
        EXPECT_EQ(summary.lanes_32, brute_force_work(view, 4)) << text_of("brute_force", size);
    }
}

// Two submissions for so many: the second continues the lanes' logs where the first stopped.
TEST_F(Waves, of_brute_force_go_on_from_one_submission_to_the_next) {
    const View view = made_view(device(), 56, 72, 38000);
    ASSERT_EQ(light_ranges(LightSplit::bounded, 38000, 56 * 72).size(), 2u);
    EXPECT_EQ(waves_of(device(), "brute_force", view.frame()).lanes_64, brute_force_work(view, 8));
}

TEST_F(Waves, of_sky_do_not_count) {
    View view = made_view(device(), 40, 32, 200);
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel)
        if (pixel % 40 < 16 || pixel / 40 >= 28) view.positions[pixel].depth = 0.0f;
    view.points.positions().upload(view.positions);
    for (const Kind& kind : kKinds) {
        const WaveSummary summary = waves_of(device(), kind.technique, view.frame());
        EXPECT_EQ(summary.lanes_64.waves, 12u);
        EXPECT_EQ(summary.lanes_32.waves, 21u);
    }
    for (PointPosition& point : view.positions) point.depth = 0.0f;
    view.points.positions().upload(view.positions);
    for (const Kind& kind : kKinds) EXPECT_EQ(waves_of(device(), kind.technique, view.frame()), WaveSummary{});
}

TEST_F(Waves, do_not_depend_on_the_size_of_a_log) {
    const View view = made_view(device(), 97, 60, 700);
    const FrameLights lights(device(), view.frame());
    const Built built(device(), StructureKind::hybrid, view.frame());
    ShadingPass pass(device(), {"small logs", kLogCode, kLogCode, kLogCode, 5}, LightSplit::none);
    const std::vector<PassBand> band = built.band(view.frame());
    const WaveSummary whole = pass.waves(view.frame(), lights, band);
    EXPECT_GT(whole.lanes_64.affecting, 0u);
    for (const std::uint64_t bytes : {1u, 400u, 5000u, 60000u})
        EXPECT_EQ(pass.waves(view.frame(), lights, band, 0, bytes), whole) << bytes << " bytes";
}

class MadeWaves : public Waves {
  protected:
    WaveSummary waves(const View& view, std::array<std::uint32_t, 2> faults) {
        const gpu::Buffer buffer(device(), "faults", std::span<const std::uint32_t>(faults));
        const gpu::Buffer* const structure[] = {&buffer};
        ShadingPass pass(device(), {"made", kMadeCode, kMadeCode, kMadeCode, 1}, LightSplit::none);
        return pass.waves(view.frame(), FrameLights(device(), view.frame()), one_band(view.frame(), structure));
    }

    View full_view() {
        View view = made_view(device(), 24, 16, 0);
        for (PointPosition& point : view.positions) point.depth = 1.0f;
        view.points.positions().upload(view.positions);
        return view;
    }
};

TEST_F(MadeWaves, checks_batches_and_wide_nodes_are_counted) {
    const WaveSummary summary = waves(full_view(), {0, 1000});
    EXPECT_EQ(summary.lanes_64, (WaveWork{6, 0, 0, 6 * 8, 6 * 8, 6 * 2}));
    EXPECT_EQ(summary.lanes_32, (WaveWork{12, 0, 0, 12 * 8, 12 * 8, 12}));
    EXPECT_EQ(summary.cost_64_p99, 0.5 * 8 + 0.25 * 8 + 3.0 * 2);
}

TEST_F(MadeWaves, a_lane_that_touches_more_than_was_counted_is_an_error) {
    try {
        waves(full_view(), {1, 0});
        ADD_FAILURE() << "accepted";
    } catch (const DeviceError& error) {
        EXPECT_STREQ(error.what(), "made (log): a pixel touched 6 things, and 5 when they were counted");
    }
}

TEST_F(MadeWaves, an_index_beyond_29_bits_is_an_error) {
    EXPECT_THROW(waves(full_view(), {0, 0x20000000}), InputError);
}

// Bands that cut blocks: a wave's lanes come from dispatches with buffers of their own.
TEST_F(Waves, come_together_from_bands) {
    const View view = made_view(device(), 47, 33, 700);
    const FrameLights lights(device(), view.frame());
    const Built lists(device(), StructureKind::lists, view.frame()),
        trees(device(), StructureKind::trees, view.frame());
    constexpr std::uint32_t kRows[] = {0, 5, 8, 9, 30, 33};
    std::vector<PassBand> bands;
    for (std::size_t i = 0; i + 1 < std::size(kRows); ++i) {
        bands.push_back((i % 2 == 0 ? lists : trees).band(view.frame()).front());
        bands.back().first_row = kRows[i];
        bands.back().row_count = kRows[i + 1] - kRows[i];
    }
    const HostStructure host_lists = lists.on_host(), host_trees = trees.on_host();
    const StructureOfRow structure_of = [&](std::uint32_t y) {
        const bool is_even = y < 5 || y == 8 || y >= 30;
        return is_even ? &host_lists : &host_trees;
    };
    ShadingPass pass(device(), {"bands", kLogCode, kLogCode, kLogCode, 5}, LightSplit::none);
    const WaveSummary summary = pass.waves(view.frame(), lights, bands);
    EXPECT_EQ(summary.lanes_64, expected_work(view, 8, structure_of));
    EXPECT_EQ(summary.lanes_32, expected_work(view, 4, structure_of));
}

} // namespace manylights::lab
