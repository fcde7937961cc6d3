#include "lab/techniques/device/froxel_grid.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace manylights::lab {

namespace {

constexpr const char* kDivisions[] = {"exponential", "view_uniform", "screen_uniform"};
constexpr std::uint32_t kUniformSlices = 128, kMostSlices = 4096;

/// What the buffer begins with; the edges follow.
struct Header {
    TileGrid tiles;
    std::uint32_t slice_count;
};
static_assert(sizeof(Header) == 20);

// 1 + 2 tan(field / 2) / tiles of a column: a slice is as deep as a tile is high where the slice begins, so that cells
// are about cubes (Olsson, Billeter, Assarsson, Clustered Deferred and Forward Shading, 2012).
float cubic_ratio(const Frame& frame, std::uint32_t tiles_y) {
    const CameraBasis basis = camera_basis(frame.camera, frame.width, frame.height);
    return 1.0f + 2.0f * basis.tan_half_y / static_cast<float>(tiles_y);
}

SliceEdges edges_of(const Frame& frame, const FroxelOptions& options) {
    const float near_edge = frame.camera.near_plane;
    const float far_edge = std::max(frame.scene.view_extent, 2.0f * near_edge);
    const std::uint32_t count = options.slices != 0 ? options.slices : kUniformSlices;
    switch (options.division) {
    case DepthDivision::exponential:
        if (options.slices != 0) return geometric_slices(near_edge, far_edge, count);
        return self_similar_slices(near_edge, far_edge, cubic_ratio(frame, options.tiles[1]));
    case DepthDivision::view_uniform:
        return uniform_slices(near_edge, far_edge, count);
    case DepthDivision::screen_uniform:
        break;
    }
    return screen_uniform_slices(near_edge, far_edge, count);
}

void check_count(const TileGrid& tiles, std::uint32_t slices) {
    if (std::uint64_t{tiles.tile_count()} * slices > std::numeric_limits<std::uint32_t>::max())
        throw InputError(fmt::format("option tiles={}x{}: with {} slices these are more froxels than 32 bits number",
                                     tiles.tiles_x, tiles.tiles_y, slices));
}

} // namespace

std::vector<OptionInfo> froxel_option_infos() {
    return {
        {"tiles", "how many tiles the image has across and down",
         fmt::format("two numbers from 1 to {} with an x between them, default 30x17", kMostTilesOfAxis)},
        {"division", "how depths are divided into slices",
         "exponential (default): equal ratios; view_uniform: equal depths; screen_uniform: equal steps of the depth "
         "buffer of a projection"},
        {"slices", "how many of them",
         fmt::format("1 to {}; by default {}, or if exponential so that they are as deep as a tile is high",
                     kMostSlices, kUniformSlices)}};
}

FroxelOptions read_froxel_options(const OptionReader& reader) {
    FroxelOptions options;
    options.tiles = reader.counts("tiles", options.tiles, kMostTilesOfAxis);
    options.division = static_cast<DepthDivision>(reader.choice("division", kDivisions));
    options.slices = reader.whole_number("slices", 0, 1, kMostSlices);
    return options;
}

void FroxelGrid::lay_out(const Frame& frame, const FroxelOptions& options) {
    const SliceEdges edges = edges_of(frame, options);
    tiles_ = tile_grid_of_counts(frame.width, frame.height, options.tiles[0], options.tiles[1]);
    slice_count_ = lab::slice_count(edges);
    check_count(tiles_, slice_count_);
    const Header header{tiles_, slice_count_};
    buffer_.fit(sizeof header + edges.size() * sizeof(float));
    buffer_.buffer().upload(std::span<const Header>(&header, 1));
    buffer_.buffer().upload(edges, sizeof header);
}

} // namespace manylights::lab
