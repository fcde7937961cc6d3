#include "tests/parity/pruned_windows.h"

#include <gtest/gtest.h>

#include <manylights/manylights.h>

namespace manylights::lab {

namespace {

struct Query {
    const HostStructure& structure;
#define ML_SLICE_EDGE(i) structure.slice_edges[i]
#define ML_CELL(i) structure.cells.at(i)
#define ML_NODE(i) structure.nodes[i]
#define ML_REFERENCE(i) structure.references.at(i)
#include <manylights/query.h>
};

// What a pixel's cursor is handed: places of references, and their lights.
struct Handed {
    std::vector<std::uint32_t> references, lights;
};

Handed handed_to(const HostStructure& structure, std::size_t pixel, float depth) {
    Query query{structure};
    const std::size_t width = structure.view.width;
    const MlFloat2 position{static_cast<float>(pixel % width) + 0.5f, static_cast<float>(pixel / width) + 0.5f};
    Query::MlCursor cursor = query.ml_begin(structure.view, position, depth);
    Handed handed;
    MlUint light = 0;
    while (query.ml_next(cursor, light)) {
        handed.references.push_back(cursor.reference - 1);
        handed.lights.push_back(light);
    }
    return handed;
}

// The rule that the buffers break; empty where they are valid.
std::string broken_rule(const BuiltStructure& built, std::uint32_t light_count) {
    std::vector<std::uint32_t> words[5];
    for (std::size_t i = 0; i < 5; ++i) words[i] = built.buffers[i]->download<std::uint32_t>();
    const auto bytes = [&](std::size_t i) { return std::uint64_t{4} * words[i].size(); };
    const ManylightsBuffers buffers{words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                                    words[4].data()};
    const ManylightsSizes sizes{bytes(0), bytes(1), bytes(2), bytes(3), bytes(4)};
    ManylightsSettings settings{};
    settings.size = sizeof settings;
    ManylightsBuilder* builder = nullptr;
    ManylightsReport report{};
    if (manylights_create(&settings, &builder, &report) != MANYLIGHTS_OK) return report.rule;
    const ManylightsStatus status = manylights_validate(builder, &buffers, &sizes, light_count, &report);
    manylights_destroy(builder);
    return status == MANYLIGHTS_OK ? "" : std::string(report.field) + " " + report.rule;
}

bool is_subsequence(const std::vector<std::uint32_t>& part, const std::vector<std::uint32_t>& whole) {
    auto next = part.begin();
    for (const std::uint32_t element : whole)
        if (next != part.end() && *next == element) ++next;
    return next == part.end();
}

std::size_t tile_count(const HostStructure& structure) {
    return std::size_t{structure.view.tiles_x} * structure.view.tiles_y;
}

} // namespace

Pruned prune(DepthPruning& pruning, gpu::Device& device, const Frame& frame, std::uint32_t tile_size) {
    StructureOptions options;
    options.kind = StructureKind::windows;
    options.tile_size = tile_size;
    const std::unique_ptr<Producer> producer = make_library_producer(options);
    StructureBuffers buffers(device);
    buffers.reserve(producer->plan(frame));
    producer->write(buffers.targets());
    buffers.finish();
    const BuiltStructure left = pruning.prune(frame.points, {buffers.bindings(), producer->stats().references});
    EXPECT_EQ(left.buffers[4]->bytes(), 8 * left.references);
    return {HostStructure(buffers.bindings()), HostStructure(left.buffers),
            broken_rule(left, static_cast<std::uint32_t>(frame.lights.size())), left.references};
}

Pruned prune(gpu::Device& device, const Frame& frame, std::uint32_t tile_size) {
    DepthPruning pruning(device);
    return prune(pruning, device, frame, tile_size);
}

Kept expect_all_handed(const Pruned& pruned, const std::vector<PointPosition>& points, const std::string& what) {
    EXPECT_EQ(pruned.broken, "") << what;
    std::set<std::uint32_t> needed;
    Kept kept;
    for (std::size_t pixel = 0; pixel < points.size(); ++pixel) {
        if (points[pixel].depth == 0.0f) continue;
        const Handed whole = handed_to(pruned.whole, pixel, points[pixel].depth);
        const Handed left = handed_to(pruned.left, pixel, points[pixel].depth);
        needed.insert(whole.references.begin(), whole.references.end());
        kept.handed += left.lights.size();
        kept.handed_by_whole += whole.lights.size();
        if (is_subsequence(whole.lights, left.lights)) continue;
        ADD_FAILURE() << what << ": pixel " << pixel << " lacks a light";
        break;
    }
    kept.needed = needed.size();
    EXPECT_GE(pruned.references, kept.needed) << what;
    EXPECT_LE(pruned.references, pruned.whole_references()) << what;
    return kept;
}

void expect_small_tables(const HostStructure& structure) {
    for (std::size_t tile = 0; tile < tile_count(structure); ++tile) {
        const MlTileForm form = ml_tile_form(structure.cells[2 * tile + 1].count);
        const std::size_t next =
            tile + 1 < tile_count(structure) ? structure.cells[2 * tile + 2].first : structure.references.size() / 2;
        const std::size_t references = next - structure.cells[2 * tile].first;
        if (form.last_slice == 0) continue;
        EXPECT_GT(references, 8u) << "tile " << tile;
        EXPECT_GE(form.last_slice, 2u) << "tile " << tile;
        EXPECT_LT(form.last_slice, references * 3 / 4) << "tile " << tile;
    }
}

std::map<std::string, int> kinds_of_tiles(const HostStructure& structure) {
    std::map<std::string, int> kinds;
    for (std::size_t tile = 0; tile < tile_count(structure); ++tile) {
        const MlUint packed = structure.cells[2 * tile + 1].count;
        const MlTileForm form = ml_tile_form(packed);
        const std::string classes = form.two_classes != 0 ? "two classes" : "one class";
        if (packed == 0)
            ++kinds["empty"];
        else if (form.flat_count != 0)
            ++kinds["flat"];
        else
            ++kinds[classes + (form.wide != 0 ? ", wide" : "")];
    }
    return kinds;
}

std::set<std::uint32_t> lights_left(const Pruned& pruned) {
    std::set<std::uint32_t> lights;
    for (std::size_t i = 0; i < pruned.left.references.size(); i += 2) lights.insert(pruned.left.references[i]);
    return lights;
}

} // namespace manylights::lab
