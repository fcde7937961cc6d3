#pragma once
// Depth slices of grids on the device: a table of edges that the host makes once and both sides compare with, so that
// no two of them can disagree at an edge. depth_slices.glsl finds a depth's slice.

#include "lab/gpu/buffer.h"

#include <vector>

namespace manylights::lab {

/// Ascending: the first is 0, the last +inf; a slice holds its lower edge.
using SliceEdges = std::vector<float>;

/// The slices of Tiled Light Trees: the first up to near_edge, equal ratios from there to far_edge, the last one open.
SliceEdges exponential_slices(float near_edge, float far_edge, std::uint32_t count);
/// Equal ratios from near_edge on, as many as reach far_edge; ratio > 1 (Olsson, Billeter, Assarsson, Clustered
/// Deferred and Forward Shading, 2012, where it makes cells as deep as they are wide).
SliceEdges self_similar_slices(float near_edge, float far_edge, float ratio);
/// Equal ratios from near_edge to far_edge, the last one open.
SliceEdges geometric_slices(float near_edge, float far_edge, std::uint32_t count);
/// Equal depths from near_edge to far_edge, the last one open.
SliceEdges uniform_slices(float near_edge, float far_edge, std::uint32_t count);
/// Equal steps of the depth buffer's z / w of a projection from near_edge to far_edge, the last one open.
SliceEdges screen_uniform_slices(float near_edge, float far_edge, std::uint32_t count);

inline std::uint32_t slice_count(const SliceEdges& edges) { return static_cast<std::uint32_t>(edges.size() - 1); }

} // namespace manylights::lab
