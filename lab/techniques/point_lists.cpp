#include "lab/techniques/point_lists.h"

#include "lab/techniques/light_stream.h"
#include "lab/techniques/shared_work.h"
#include "reference/oracle/grid.h"

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

} // namespace

PointLists find_point_lists(const Frame& frame, std::span<const PointPosition> points, unsigned threads) {
    const oracle::LightGrid grid = grid_of(frame);
    std::vector<RowLists> rows(frame.height);
    share_work(rows.size(), threads,
               [&](std::size_t y) { rows[y] = find_row(grid, points.subspan(y * frame.width, frame.width)); });
    PointLists lists;
    lists.first.reserve(points.size() + 1);
    lists.first.push_back(0);
    for (const RowLists& row : rows) {
        for (const std::size_t end : row.ends) lists.first.push_back(lists.lights.size() + end);
        lists.lights.insert(lists.lights.end(), row.lights.begin(), row.lights.end());
    }
    return lists;
}

} // namespace manylights::lab
