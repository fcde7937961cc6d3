#include "lab/techniques/host_structure.h"

#include "lab/renderer/point_buffer.h"
#include "lab/techniques/light_records.h"

namespace manylights::lab {

namespace {

// The query's text inside a class whose members its accessors name.
struct Query {
    const HostStructure& structure;
#define ML_SLICE_EDGE(i) structure.slice_edges[i]
#define ML_CELL(i) structure.cells[i]
#define ML_NODE(i) structure.nodes[i]
#define ML_REFERENCE(i) structure.references[i]
#include <manylights/query.h>
};

MlFloat2 pixel_center(const MlView& view, std::size_t pixel) {
    return {static_cast<float>(pixel % view.width) + 0.5f, static_cast<float>(pixel / view.width) + 0.5f};
}

// A tree's root is an inner node. A list is a run of leaves: one, unless it has more than 65,535 lights.
CellClass class_of(const HostStructure& structure, const MlCell& cell) {
    if (cell.count == 0) return CellClass::none;
    if (structure.view.structure == ML_STRUCTURE_LISTS) return CellClass::list;
    return ml_node_is_leaf(structure.nodes[cell.first].bits) ? CellClass::list : CellClass::tree;
}

// A tile of windows counts as a list: where it has references, in whatever depth.
CellClass class_at(Query& query, std::size_t tile, std::size_t pixel, float depth) {
    const HostStructure& structure = query.structure;
    const MlView& view = structure.view;
    if (view.structure != ML_STRUCTURE_WINDOWS)
        return class_of(structure, structure.cells[query.ml_cell_index(view, pixel_center(view, pixel), depth)]);
    const std::size_t header = view.cell_offset + 2 * tile;
    const bool is_empty = ml_tile_from_cells(structure.cells[header], structure.cells[header + 1]).form == 0;
    return is_empty ? CellClass::none : CellClass::list;
}

CellClass joined(CellClass a, CellClass b) {
    if (a == CellClass::none) return b;
    return b == CellClass::none || b == a ? a : CellClass::mixed;
}

std::uint64_t references_holding(const HostStructure& structure, MlUint begin, MlUint end, MlUint code) {
    const MlUint whole_tile = ml_pack_bounds(0, 0, 0, 15, 0, 15);
    std::uint64_t count = 0;
    for (MlUint reference = begin; reference < end; ++reference) {
        const MlUint depths = structure.references[2 * std::size_t{reference} + 1] & 0xFFFFu;
        if (ml_bounds_hold(depths | whole_tile, code, 0, 0)) ++count;
    }
    return count;
}

std::optional<std::uint64_t> affecting_reference_of(Query& query, std::size_t pixel, const PointPosition& point,
                                                    const LightStream& lights) {
    const MlFloat3 position{point.position.x, point.position.y, point.position.z};
    const MlView& view = query.structure.view;
    Query::MlCursor cursor = query.ml_begin(view, pixel_center(view, pixel), point.depth);
    const std::uint64_t words = view.structure == ML_STRUCTURE_WINDOWS ? 2 : 1;
    MlUint light = 0;
    while (query.ml_next(cursor, light)) {
        const glm::vec4& sphere = lights.spheres[light];
        if (ml_affects(position, {sphere.x, sphere.y, sphere.z}, sphere.w))
            return std::uint64_t{cursor.reference - 1u} * words;
    }
    return std::nullopt;
}

std::vector<std::uint32_t> references_in(const gpu::Buffer& buffer, bool has_records) {
    if (!has_records) return buffer.download<std::uint32_t>();
    std::vector<std::uint32_t> references;
    for (const LightRecord& record : buffer.download<LightRecord>()) references.push_back(record.light);
    return references;
}

} // namespace

HostStructure::HostStructure(const StructureBindings& buffers, bool has_records)
    : view(buffers[0]->download<MlView>().at(0)), slice_edges(buffers[1]->download<float>()),
      cells(buffers[2]->download<MlCell>()), nodes(buffers[3]->download<MlNode>()),
      references(references_in(*buffers[4], has_records)) {}

std::vector<CellClass> classify_tiles(const HostStructure& structure, std::span<const PointPosition> points) {
    const MlView& view = structure.view;
    const auto tile_of = [&view](std::size_t pixel) {
        const std::size_t x = pixel % view.width, y = pixel / view.width;
        return y / view.tile_px * view.tiles_x + x / view.tile_px;
    };
    Query query{structure};
    std::vector<CellClass> tiles(std::size_t{view.tiles_x} * view.tiles_y, CellClass::none);
    for (std::size_t pixel = 0; pixel < points.size(); ++pixel) {
        if (points[pixel].depth == 0.0f) continue;
        CellClass& tile = tiles[tile_of(pixel)];
        tile = joined(tile, class_at(query, tile_of(pixel), pixel, points[pixel].depth));
    }
    std::vector<CellClass> classes(points.size());
    for (std::size_t pixel = 0; pixel < points.size(); ++pixel) classes[pixel] = tiles[tile_of(pixel)];
    return classes;
}

double mean_references_in_range(const HostStructure& structure, std::span<const PointPosition> points) {
    Query query{structure};
    std::uint64_t references = 0, shaded = 0;
    for (std::size_t pixel = 0; pixel < points.size(); ++pixel) {
        if (points[pixel].depth == 0.0f) continue;
        ++shaded;
        const Query::MlCursor c =
            query.ml_begin(structure.view, pixel_center(structure.view, pixel), points[pixel].depth);
        references += references_holding(structure, c.reference, c.reference_end, c.depth_code >> c.shift);
        references += references_holding(structure, c.node, c.node_end, c.depth_code >> c.large_shift);
    }
    return shaded == 0 ? 0.0 : static_cast<double>(references) / static_cast<double>(shaded);
}

std::optional<std::uint64_t> find_affecting_reference(const HostStructure& structure,
                                                      std::span<const PointPosition> points,
                                                      const LightStream& lights) {
    Query query{structure};
    for (std::size_t pixel = 0; pixel < points.size(); ++pixel) {
        if (points[pixel].depth == 0.0f) continue;
        if (auto reference = affecting_reference_of(query, pixel, points[pixel], lights)) return reference;
    }
    return std::nullopt;
}

} // namespace manylights::lab
