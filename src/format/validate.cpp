#include "src/format/validate.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace manylights::detail {

namespace {

Outcome count_elements(const ManylightsSizes& sizes, Counts& counts) {
    if (sizes.views % sizeof(MlView) != 0 || sizes.views == 0 || sizes.views / sizeof(MlView) > kMaxViews)
        return invalid("sizes.views", "must be 1 to 8 times 64 bytes");
    if (sizes.slice_edges % sizeof(float) != 0) return invalid("sizes.slice_edges", "must be a multiple of 4");
    if (sizes.cells % sizeof(MlCell) != 0) return invalid("sizes.cells", "must be a multiple of 8");
    if (sizes.nodes % sizeof(MlNode) != 0) return invalid("sizes.nodes", "must be a multiple of 16");
    if (sizes.references % sizeof(MlUint) != 0) return invalid("sizes.references", "must be a multiple of 4");
    counts = {sizes.views / sizeof(MlView), sizes.slice_edges / sizeof(float), sizes.cells / sizeof(MlCell),
              sizes.nodes / sizeof(MlNode), sizes.references / sizeof(MlUint)};
    constexpr std::uint64_t kMost = std::numeric_limits<MlUint>::max();
    if (counts.cells > kMost) return invalid("sizes.cells", "must hold fewer than 2^32 elements");
    if (counts.nodes > kMost) return invalid("sizes.nodes", "must hold fewer than 2^32 elements");
    if (counts.references > kMost) return invalid("sizes.references", "must hold fewer than 2^32 elements");
    return {};
}

bool is_power_of_two(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x807FFFFFu) == 0 && value >= 0x1p-126f && value <= 0x1p126f;
}

// How a view's tiles are cut in depth, and its cells.
Outcome validate_grid(const MlView& view, std::uint64_t index) {
    const std::uint64_t tiles = static_cast<std::uint64_t>(view.tiles_x) * view.tiles_y;
    if (view.structure == ML_STRUCTURE_WINDOWS) {
        if (view.slice_count != 0) return damaged("views", "slice_count must be 0 for windows", index);
        if (view.cell_count < 2 * tiles) return damaged("views", "cell_count must hold two cells per tile", index);
        if (!is_power_of_two(view.depth_scale))
            return damaged("views", "depth_scale must be a power of two in [2^-126, 2^126]", index);
        return {};
    }
    if (view.slice_count < 1 || view.slice_count > kMaxSlices ||
        (view.structure == ML_STRUCTURE_TREES && view.slice_count != 1))
        return damaged("views", "slice_count must be in [1, 128], and 1 for trees", index);
    if (tiles * view.slice_count != view.cell_count)
        return damaged("views", "cell_count must be tiles_x * tiles_y * slice_count", index);
    if (std::bit_cast<std::uint32_t>(view.depth_scale) != 0)
        return damaged("views", "depth_scale must be 0 without windows", index);
    return {};
}

Outcome validate_view(const MlView& view, const MlView& first, std::uint64_t index) {
    if (view.width < 1 || view.width > kMaxPixels || view.height < 1 || view.height > kMaxPixels)
        return damaged("views", "width and height must be in [1, 65536]", index);
    if (view.tile_px < 1) return damaged("views", "tile_px must be at least 1", index);
    if (view.tiles_x != divide_up(view.width, view.tile_px) || view.tiles_y != divide_up(view.height, view.tile_px))
        return damaged("views", "tiles_x and tiles_y must cover the image", index);
    if (view.structure < ML_STRUCTURE_LISTS || view.structure > ML_STRUCTURE_WINDOWS ||
        view.structure != first.structure)
        return damaged("views", "structure must be a known one, the same in all views", index);
    if (Outcome outcome = validate_grid(view, index); !outcome.ok()) return outcome;
    if (!std::isfinite(view.slice_scale) || !std::isfinite(view.slice_bias))
        return damaged("views", "slice_scale and slice_bias must be finite", index);
    if ((view.reserved1 | view.reserved2 | view.reserved3) != 0)
        return damaged("views", "reserved words must be 0", index);
    return {};
}

// Edges ascend from 0 to +inf, so every depth belongs to one slice. The edges decide; scale and bias only guess.
Outcome validate_edges(const Contents& contents, const MlView& view) {
    if (view.structure == ML_STRUCTURE_WINDOWS) return {}; // which have none
    const float* edges = contents.slice_edges + view.slice_offset;
    if (edges[0] != 0.0f) return damaged("slice_edges", "the first edge must be 0", view.slice_offset);
    for (std::uint64_t s = 1; s <= view.slice_count; ++s)
        if (!(edges[s] >= edges[s - 1])) return damaged("slice_edges", "must not descend", view.slice_offset + s);
    if (edges[view.slice_count] != std::numeric_limits<float>::infinity())
        return damaged("slice_edges", "the last edge must be +inf", view.slice_offset + view.slice_count);
    return {};
}

Outcome validate_views(const Contents& contents) {
    std::uint64_t edges = 0;
    std::uint64_t cells = 0;
    for (std::uint64_t v = 0; v < contents.counts.views; ++v) {
        const MlView& view = contents.views[v];
        if (Outcome outcome = validate_view(view, contents.views[0], v); !outcome.ok()) return outcome;
        if (view.slice_offset != edges || view.cell_offset != cells)
            return damaged("views", "slice_offset and cell_offset must follow the view before", v);
        if (view.structure != ML_STRUCTURE_WINDOWS) edges += view.slice_count + 1u;
        cells += view.cell_count;
        if (edges > contents.counts.slice_edges) return damaged("views", "the slice edges must fit their buffer", v);
        if (cells > contents.counts.cells) return damaged("views", "the cells must fit their buffer", v);
        if (Outcome outcome = validate_edges(contents, view); !outcome.ok()) return outcome;
    }
    if (edges != contents.counts.slice_edges)
        return damaged("slice_edges", "must be as many as the views describe", edges);
    if (cells != contents.counts.cells) return damaged("cells", "must be as many as the views describe", cells);
    return {};
}

// Elements that the cells so far have claimed. No two cells share elements in a buffer that is made for a frame, and
// refusing it bounds the time that hostile bytes can cost.
struct Claims {
    std::uint64_t nodes = 0;
    std::uint64_t references = 0;
};

Outcome validate_cell(const Contents& contents, std::uint64_t index, std::uint32_t light_count, std::uint32_t* marks,
                      Claims& claims) {
    const MlCell cell = contents.cells[index];
    const std::uint64_t end = static_cast<std::uint64_t>(cell.first) + cell.count;
    ReferenceRange range = {cell.first, end};
    if (contents.views[0].structure != ML_STRUCTURE_LISTS) {
        if (end > contents.counts.nodes) return damaged("cells", "must lie within the nodes", index);
        claims.nodes += cell.count;
        if (claims.nodes > contents.counts.nodes) return damaged("cells", "must not share nodes", index);
        if (Outcome outcome = validate_nodes(contents, cell, range); !outcome.ok()) return outcome;
    }
    if (range.end > contents.counts.references) return damaged("cells", "must lie within the references", index);
    claims.references += range.end - range.begin;
    if (claims.references > contents.counts.references) return damaged("cells", "must not share references", index);
    return validate_references(contents, range, light_count, marks);
}

Outcome validate_cells(const Contents& contents, std::uint32_t light_count, std::uint32_t* marks) {
    Claims claims;
    for (std::uint64_t c = 0; c < contents.counts.cells; ++c)
        if (Outcome outcome = validate_cell(contents, c, light_count, marks, claims); !outcome.ok()) return outcome;
    return {};
}

// What windows do without, and the words of their references.
Outcome count_of_windows(Counts& counts) {
    if (counts.nodes != 0) return damaged("nodes", "windows must have none", 0);
    if (counts.references % 2 != 0)
        return damaged("references", "must have two words each in windows", counts.references);
    counts.reference_words = reference_words(ML_STRUCTURE_WINDOWS);
    counts.references /= counts.reference_words;
    return {};
}

} // namespace

// Marks each light; one that is marked already is there twice.
Outcome validate_references(const Contents& contents, ReferenceRange range, std::uint32_t light_count,
                            std::uint32_t* marks) {
    const std::uint64_t words = contents.counts.reference_words;
    for (std::uint64_t i = range.begin; i < range.end; ++i) {
        const MlUint light = contents.references[i * words];
        if (light >= light_count) return damaged("references", "must be less than light_count", i);
        const std::uint32_t bit = 1u << (light % 32);
        if ((marks[light / 32] & bit) != 0) return damaged("references", "must not name a light twice in a cell", i);
        marks[light / 32] |= bit;
    }
    for (std::uint64_t i = range.begin; i < range.end; ++i) marks[contents.references[i * words] / 32] = 0;
    return {};
}

Outcome validate_buffers(const ManylightsBuffers& buffers, const ManylightsSizes& sizes, std::uint32_t light_count,
                         std::uint32_t* marks) {
    Contents contents{static_cast<const MlView*>(buffers.views),      static_cast<const float*>(buffers.slice_edges),
                      static_cast<const MlCell*>(buffers.cells),      static_cast<const MlNode*>(buffers.nodes),
                      static_cast<const MlUint*>(buffers.references), {}};
    if (Outcome outcome = count_elements(sizes, contents.counts); !outcome.ok()) return outcome;
    if (Outcome outcome = validate_views(contents); !outcome.ok()) return outcome;
    if (light_count != 0) std::memset(marks, 0, mark_words(light_count) * sizeof(std::uint32_t));
    if (contents.views[0].structure != ML_STRUCTURE_WINDOWS) return validate_cells(contents, light_count, marks);
    if (Outcome outcome = count_of_windows(contents.counts); !outcome.ok()) return outcome;
    return validate_windows(contents, light_count, marks);
}

} // namespace manylights::detail
