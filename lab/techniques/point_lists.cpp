#include "lab/techniques/point_lists.h"

#include "lab/scene/error.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/shared_work.h"
#include "reference/oracle/grid.h"

#include <fmt/format.h>

#include <atomic>
#include <utility>

namespace manylights::lab {

namespace {

struct RowLists {
    std::vector<std::size_t> ends; ///< per pixel of the row: where its list ends
    std::vector<std::uint32_t> lights;
};

RowLists find_row(const oracle::LightGrid& grid, std::span<const PointPosition> points) {
    RowLists row;
    row.ends.reserve(points.size());
    for (const PointPosition& point : points) {
        if (point.depth > 0.0f)
            grid.append_affecting({point.position.x, point.position.y, point.position.z}, row.lights);
        row.ends.push_back(row.lights.size());
    }
    return row;
}

oracle::LightGrid grid_of(const Frame& frame) {
    const float eye[3] = {frame.camera.position.x, frame.camera.position.y, frame.camera.position.z};
    return oracle::LightGrid(oracle::relative_lights(public_lights(frame), eye));
}

PointLists joined(std::vector<RowLists> rows, std::size_t pixels, std::uint64_t lights) {
    PointLists lists;
    lists.first.reserve(pixels + 1);
    lists.lights.reserve(lights);
    lists.first.push_back(0);
    for (RowLists& row : rows) {
        const std::size_t before = lists.lights.size();
        for (const std::size_t end : row.ends) lists.first.push_back(before + end);
        lists.lights.insert(lists.lights.end(), row.lights.begin(), row.lights.end());
        row = {}; // so that the lists are not held twice
    }
    return lists;
}

} // namespace

PointLists find_point_lists(const Frame& frame, std::span<const PointPosition> points, unsigned threads,
                            std::uint64_t most) {
    const oracle::LightGrid grid = grid_of(frame);
    std::vector<RowLists> rows(frame.height);
    std::atomic<std::uint64_t> listed = 0;
    share_work(rows.size(), threads, [&](std::size_t y) {
        if (listed > most) return; // refused below
        rows[y] = find_row(grid, points.subspan(y * frame.width, frame.width));
        listed += rows[y].lights.size();
    });
    if (listed > most)
        throw InputError(
            fmt::format("the lists of all points: must hold at most {} lights together; take fewer lights, "
                        "shorter ranges or a smaller size",
                        most));
    return joined(std::move(rows), points.size(), listed);
}

} // namespace manylights::lab
