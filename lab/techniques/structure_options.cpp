#include "lab/techniques/structure_options.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab {

namespace {

constexpr const char* kProducers[] = {"library", "paper"};
constexpr const char* kBuilds[] = {"host", "device"};
constexpr const char* kListing4[] = {"corrected", "printed"};
constexpr const char* kSortKeys[] = {"centre", "near"};
constexpr const char* kSorts[] = {"global", "cell"};
constexpr const char* kTrees[] = {"bottom_up", "top_down"};
constexpr const char* kEntries[] = {"root", "slice"};
constexpr const char* kListBounds[] = {"infinite", "lights"};
constexpr const char* kCellTests[] = {"box", "tight"};
constexpr const char* kLoops[] = {"lane", "wave"};
constexpr const char* kPaths[] = {"one", "three"};
constexpr const char* kSwitch[] = {"off", "on"};
constexpr const char* kLights[] = {"indexed", "duplicated"};
// In the order of paper::Heuristic: "e" always makes trees, "lists" never does.
constexpr const char* kHeuristics[] = {"a", "b", "c", "d", "e", "lists"};

bool has_trees(StructureKind kind) { return kind == StructureKind::trees || kind == StructureKind::hybrid; }

// The paper's switches: the library has one setting of each.
void refuse_papers_switches(const TechniqueInfo& info, const OptionReader& reader) {
    for (const char* key : {"tree", "entry"})
        if (reader.given(key)) throw InputError(fmt::format("{}: option {} needs producer=paper", info.name, key));
    for (const char* key : {"heuristic", "listing4", "sort_key", "sort", "list_bounds"})
        if (reader.given(key))
            throw InputError(fmt::format("{}: option {} needs producer=paper or build=device", info.name, key));
}

// What the passes on the device have no form of.
void refuse_hosts_switches(const TechniqueInfo& info, const OptionReader& reader) {
    for (const char* key : {"producer", "cell_test", "tree", "entry"})
        if (reader.given(key)) throw InputError(fmt::format("{}: option {}: not with build=device", info.name, key));
}

// A tile's tree has slices only where its walk begins at one.
void refuse_unused_slices(const TechniqueInfo& info, const OptionReader& reader, const StructureOptions& options) {
    if (options.kind != StructureKind::trees || options.tree_entry == paper::TreeEntry::per_slice) return;
    for (const char* key : {"slice_count", "slice_near", "slice_far", "listing4"})
        if (reader.given(key)) throw InputError(fmt::format("{}: option {} needs entry=slice", info.name, key));
}

// Tight cells are the paper's pipeline's alone, and only its lists ascend by light: so these values choose it.
void choose_producer(const TechniqueInfo& info, const OptionReader& reader, StructureOptions& options) {
    const bool is_tight = options.cell_test == paper::CellTest::tight;
    if (!is_tight && options.loop == ListLoop::lane) return;
    if (options.on_device) return; // whose lists ascend as well
    if (reader.given("producer") && options.producer == ProducerKind::library)
        throw InputError(
            fmt::format("{}: option {} needs producer=paper", info.name, is_tight ? "cell_test=tight" : "loop=wave"));
    options.producer = ProducerKind::paper;
}

void read_builder(const TechniqueInfo& info, const OptionReader& reader, StructureOptions& options) {
    options.producer = static_cast<ProducerKind>(reader.choice("producer", kProducers));
    options.on_device = reader.choice("build", kBuilds) == 1;
    options.cell_test = static_cast<paper::CellTest>(reader.choice("cell_test", kCellTests));
    options.loop = static_cast<ListLoop>(reader.choice("loop", kLoops));
    choose_producer(info, reader, options);
}

void read_papers_switches(const TechniqueInfo& info, const OptionReader& reader, StructureOptions& options) {
    if (options.producer == ProducerKind::library && !options.on_device) refuse_papers_switches(info, reader);
    options.heuristic = static_cast<paper::Heuristic>(reader.choice("heuristic", kHeuristics));
    options.slice_formula = static_cast<paper::SliceFormula>(reader.choice("listing4", kListing4));
    options.sort_key = static_cast<paper::SortKey>(reader.choice("sort_key", kSortKeys));
    options.sort_scope = static_cast<paper::SortScope>(reader.choice("sort", kSorts));
    options.tree_build = static_cast<paper::TreeBuild>(reader.choice("tree", kTrees));
    options.tree_entry = static_cast<paper::TreeEntry>(reader.choice("entry", kEntries));
    options.list_bounds = static_cast<paper::ListBounds>(reader.choice("list_bounds", kListBounds));
    if (options.on_device) refuse_hosts_switches(info, reader);
    refuse_unused_slices(info, reader, options);
}

void read_walk(const TechniqueInfo& info, const OptionReader& reader, StructureOptions& options) {
    options.has_three_paths = reader.choice("paths", kPaths) == 1;
    options.copies_trees = reader.choice("lds", kSwitch) == 1;
    options.has_records = reader.choice("lights", kLights) == 1;
    if (options.has_records && options.loop == ListLoop::wave)
        throw InputError(fmt::format("{}: option lights=duplicated: not with loop=wave", info.name));
}

void add_tree_infos(StructureKind kind, std::vector<OptionInfo>& infos) {
    if (!has_trees(kind)) return;
    if (kind == StructureKind::hybrid) {
        infos.push_back({"heuristic", "list or tree, with producer=paper or build=device",
                         "a (default), b, c, d, e (always a tree), lists (never one)"});
        infos.push_back({"list_bounds", "depths of a list's node, with producer=paper or build=device",
                         "infinite (default): it is always walked, or lights: those of its lights"});
    }
    infos.push_back({"sort_key", "depth that lights are sorted by, with producer=paper or build=device",
                     "centre (default) or near"});
    infos.push_back({"sort", "what is sorted by depth, with producer=paper or build=device",
                     "global (default): all lights once, or cell: the lights of each cell"});
    infos.push_back({"tree", "how trees are built, with producer=paper",
                     "bottom_up (default): perfect ones, or top_down: split where the modelled cost is least"});
    if (kind == StructureKind::trees)
        infos.push_back({"entry", "where the walk begins, with producer=paper",
                         "root (default), or slice: at the subtree that holds the lights of the depth's slice"});
}

void add_walk_infos(StructureKind kind, std::vector<OptionInfo>& infos) {
    if (kind == StructureKind::hybrid)
        infos.push_back({"paths", "loops of the shader, chosen by a workgroup's vote",
                         "one (default), or three: for lists, for trees, for both"});
    if (has_trees(kind))
        infos.push_back({"lds", "a tree that a whole workgroup walks is copied to its memory first",
                         "off (default) or on: trees of up to 1024 nodes"});
    infos.push_back({"lights", "how lists and leaves hold lights",
                     "indexed (default), or duplicated: a record of 32 bytes per reference"});
}

} // namespace

std::vector<OptionInfo> structure_option_infos(StructureKind kind) {
    if (kind == StructureKind::windows)
        return {{"tile_size", "edge of a tile in pixels", "8 to 4096, default the library's choice for the lights"}};
    std::vector<OptionInfo> infos{{"tile_size", "edge of a tile in pixels", "8 to 4096, default 48"}};
    const std::string with_entry = kind == StructureKind::trees ? ", with entry=slice" : "";
    infos.push_back({"slice_count", "depth slices" + with_entry, "1 to 128, default 16"});
    infos.push_back(
        {"slice_near", "end of the first slice" + with_entry, "above 0, default 5, at most a tenth of slice_far"});
    infos.push_back(
        {"slice_far", "start of the last, open slice's depths" + with_entry, "above slice_near, default the scene's"});
    if (has_trees(kind)) infos.push_back({"leaf_size", "most lights in a leaf", "1 to 65535, default 4"});
    infos.push_back({"producer", "who builds the structure", "library (default) or paper"});
    infos.push_back({"build", "where the structure is built",
                     "host (default): by the producer, or device: the paper's pipeline in passes of the GPU"});
    if (kind == StructureKind::lists) {
        infos.push_back({"cell_test", "cells of its tiles and slices that a light goes to",
                         "box (default): all, or tight: those it meets, with producer=paper"});
        infos.push_back({"loop", "who walks the lists",
                         "lane (default): each its own, or wave: all their union, with producer=paper"});
    }
    infos.push_back({"listing4", "slice formula, with producer=paper or build=device" + with_entry,
                     "corrected (default) or printed"});
    add_tree_infos(kind, infos);
    add_walk_infos(kind, infos);
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
    read_builder(info, reader, options);
    read_papers_switches(info, reader, options);
    read_walk(info, reader, options);
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
