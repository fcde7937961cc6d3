#include "lab/techniques/structure_options.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab {

namespace {

constexpr const char* kProducers[] = {"library", "paper"};
constexpr const char* kListing4[] = {"corrected", "printed"};
constexpr const char* kSortKeys[] = {"centre", "near"};
constexpr const char* kCellTests[] = {"box", "tight"};
constexpr const char* kLoops[] = {"lane", "wave"};
constexpr const char* kPaths[] = {"one", "three"};
constexpr const char* kSwitch[] = {"off", "on"};
constexpr const char* kLights[] = {"indexed", "duplicated"};
// In the order of paper::Heuristic: "e" always makes trees, "lists" never does.
constexpr const char* kHeuristics[] = {"a", "b", "c", "d", "e", "lists"};

bool has_slices(StructureKind kind) { return kind == StructureKind::lists || kind == StructureKind::hybrid; }
bool has_trees(StructureKind kind) { return kind == StructureKind::trees || kind == StructureKind::hybrid; }

// The paper's switches: the library has one setting of each.
void refuse_papers_switches(const TechniqueInfo& info, const OptionReader& reader) {
    for (const char* key : {"heuristic", "listing4", "sort_key"})
        if (reader.given(key)) throw InputError(fmt::format("{}: option {} needs producer=paper", info.name, key));
}

// Tight cells are the paper's pipeline's alone, and only its lists ascend by light: so these values choose it.
void choose_producer(const TechniqueInfo& info, const OptionReader& reader, StructureOptions& options) {
    const bool is_tight = options.cell_test == paper::CellTest::tight;
    if (!is_tight && options.loop == ListLoop::lane) return;
    if (reader.given("producer") && options.producer == ProducerKind::library)
        throw InputError(
            fmt::format("{}: option {} needs producer=paper", info.name, is_tight ? "cell_test=tight" : "loop=wave"));
    if (options.loop == ListLoop::wave && reader.given("lights"))
        throw InputError(fmt::format("{}: option lights: not with loop=wave", info.name));
    options.producer = ProducerKind::paper;
}

void read_walk(const OptionReader& reader, StructureOptions& options) {
    options.has_three_paths = reader.choice("paths", kPaths) == 1;
    options.copies_trees = reader.choice("lds", kSwitch) == 1;
    options.has_records = reader.choice("lights", kLights) == 1;
}

} // namespace

std::vector<OptionInfo> structure_option_infos(StructureKind kind) {
    if (kind == StructureKind::windows)
        return {{"tile_size", "edge of a tile in pixels", "8 to 4096, default the library's choice for the lights"}};
    std::vector<OptionInfo> infos{{"tile_size", "edge of a tile in pixels", "8 to 4096, default 48"}};
    if (has_slices(kind)) {
        infos.push_back({"slice_count", "depth slices", "1 to 128, default 16"});
        infos.push_back({"slice_near", "end of the first slice", "above 0, default 5, at most a tenth of slice_far"});
        infos.push_back(
            {"slice_far", "start of the last, open slice's depths", "above slice_near, default the scene's"});
    }
    if (has_trees(kind)) infos.push_back({"leaf_size", "most lights in a leaf", "1 to 65535, default 4"});
    infos.push_back({"producer", "who builds the structure", "library (default) or paper"});
    if (kind == StructureKind::hybrid)
        infos.push_back({"heuristic", "list or tree, with producer=paper",
                         "a (default), b, c, d, e (always a tree), lists (never one)"});
    if (kind == StructureKind::lists) {
        infos.push_back({"cell_test", "cells of its tiles and slices that a light goes to",
                         "box (default): all, or tight: those it meets, with producer=paper"});
        infos.push_back({"loop", "who walks the lists",
                         "lane (default): each its own, or wave: all their union, with producer=paper"});
    }
    if (has_slices(kind))
        infos.push_back({"listing4", "slice formula, with producer=paper", "corrected (default) or printed"});
    if (has_trees(kind))
        infos.push_back(
            {"sort_key", "depth that lights are sorted by, with producer=paper", "centre (default) or near"});
    if (kind == StructureKind::hybrid)
        infos.push_back({"paths", "loops of the shader, chosen by a workgroup's vote",
                         "one (default), or three: for lists, for trees, for both"});
    if (has_trees(kind))
        infos.push_back({"lds", "a tree that a whole workgroup walks is copied to its memory first",
                         "off (default) or on: trees of up to 1024 nodes"});
    infos.push_back({"lights", "how lists and leaves hold lights",
                     "indexed (default), or duplicated: a record of 32 bytes per reference"});
    return infos;
}

StructureOptions read_structure_options(const TechniqueInfo& info, StructureKind kind, const OptionValues& values) {
    const OptionReader reader(info, values);
    StructureOptions options;
    options.kind = kind;
    if (kind == StructureKind::windows) options.tile_size = 0;
    options.tile_size = reader.whole_number("tile_size", options.tile_size, 8, 4096);
    options.slice_count = reader.whole_number("slice_count", options.slice_count, 1, 128);
    options.leaf_size = reader.whole_number("leaf_size", options.leaf_size, 1, 65535);
    options.slice_near = reader.positive_number("slice_near");
    options.slice_far = reader.positive_number("slice_far");
    options.producer = static_cast<ProducerKind>(reader.choice("producer", kProducers));
    options.cell_test = static_cast<paper::CellTest>(reader.choice("cell_test", kCellTests));
    options.loop = static_cast<ListLoop>(reader.choice("loop", kLoops));
    choose_producer(info, reader, options);
    if (options.producer == ProducerKind::library) refuse_papers_switches(info, reader);
    options.heuristic = static_cast<paper::Heuristic>(reader.choice("heuristic", kHeuristics));
    options.slice_formula = static_cast<paper::SliceFormula>(reader.choice("listing4", kListing4));
    options.sort_key = static_cast<paper::SortKey>(reader.choice("sort_key", kSortKeys));
    read_walk(reader, options);
    if (options.slice_near && options.slice_far && !(*options.slice_near < *options.slice_far))
        throw InputError(fmt::format("{}: option slice_near={}: must be below slice_far={}", info.name,
                                     *options.slice_near, *options.slice_far));
    return options;
}

SliceRange slice_range(const StructureOptions& options, const Scene& scene) {
    const float far_edge = options.slice_far.value_or(scene.view_extent);
    const float near_edge = options.slice_near.value_or(std::min(5.0f, 0.1f * far_edge));
    if (!(near_edge < far_edge))
        throw InputError(fmt::format("option slice_near={}: must be below slice_far={}, the view distance of the scene "
                                     "unless slice_far is set",
                                     near_edge, far_edge));
    return {near_edge, far_edge};
}

} // namespace manylights::lab
