#include "lab/techniques/device/depth_slices.h"

#include "reference/paper/slices.h"

#include <cmath>
#include <limits>

namespace manylights::lab {

namespace {

constexpr float kOpen = std::numeric_limits<float>::infinity();

/// edge(i): the lower edge of slice i, from 1 to count - 1.
template <typename Edge>
SliceEdges table_of(std::uint32_t count, Edge edge) {
    SliceEdges edges{0.0f};
    for (std::uint32_t i = 1; i < count; ++i) edges.push_back(static_cast<float>(edge(i)));
    edges.push_back(kOpen);
    return edges;
}

} // namespace

SliceEdges exponential_slices(float near_edge, float far_edge, std::uint32_t count) {
    paper::Options options;
    options.slice_near = near_edge;
    options.slice_far = far_edge;
    paper::SliceTable table;
    table.update(options, count);
    return table.edges();
}

SliceEdges self_similar_slices(float near_edge, float far_edge, float ratio) {
    SliceEdges edges{0.0f};
    for (double edge = double(near_edge) * ratio; edge < far_edge; edge *= ratio)
        edges.push_back(static_cast<float>(edge));
    edges.push_back(kOpen);
    return edges;
}

SliceEdges geometric_slices(float near_edge, float far_edge, std::uint32_t count) {
    const double ratio = double(far_edge) / near_edge;
    return table_of(count, [&](std::uint32_t i) { return near_edge * std::pow(ratio, double(i) / count); });
}

SliceEdges uniform_slices(float near_edge, float far_edge, std::uint32_t count) {
    const double step = (double(far_edge) - near_edge) / count;
    return table_of(count, [&](std::uint32_t i) { return near_edge + step * i; });
}

// z / w = far / (far - near) * (1 - near / depth), solved for the depth at i / count.
SliceEdges screen_uniform_slices(float near_edge, float far_edge, std::uint32_t count) {
    const double reach = 1.0 - double(near_edge) / far_edge;
    return table_of(count, [&](std::uint32_t i) { return near_edge / (1.0 - reach * i / count); });
}

} // namespace manylights::lab
