#pragma once
// A structure read back to the host and walked there with the very query that the shaders run.

#include "lab/techniques/light_stream.h"
#include "lab/techniques/structure_buffers.h"

#include <manylights/format.h>

#include <optional>

namespace manylights::lab {

struct PointPosition;

struct HostStructure {
    /// has_records: lights are in the place of the references to them.
    explicit HostStructure(const StructureBindings& buffers, bool has_records = false);

    MlView view{};
    std::vector<float> slice_edges;
    std::vector<MlCell> cells;
    std::vector<MlNode> nodes;
    std::vector<std::uint32_t> references;
};

/// Per pixel: what the shaded pixels of its tile walk, as figure 3 of Tiled Light Trees colours tiles. Cells without
/// lights do not count; a tile of windows is a list.
std::vector<CellClass> classify_tiles(const HostStructure& structure, std::span<const PointPosition> points);

/// Of windows: the references of a point's window whose depths hold the point's, wherever in the tile it is; the mean
/// over the shaded points, 0 without any.
double mean_references_in_range(const HostStructure& structure, std::span<const PointPosition> points);

/// A reference, by the index of the word that names its light, to a light that affects a shaded point, as the point's
/// own cursor finds it. Empty where no light affects any point.
std::optional<std::uint64_t> find_affecting_reference(const HostStructure& structure,
                                                      std::span<const PointPosition> points, const LightStream& lights);

} // namespace manylights::lab
