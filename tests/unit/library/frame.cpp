#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace manylights::test {

namespace {

// Column-major, element [4 * column + row].
void set(float (&matrix)[16], int row, int column, double value) {
    matrix[4 * column + row] = static_cast<float>(value);
}

void set_placement(const CameraOptions& options, float (&matrix)[16]) {
    const double c = std::cos(options.yaw);
    const double s = std::sin(options.yaw);
    const double flip = options.looks_down_negative_z ? 1.0 : -1.0;
    const double rows[3][3] = {{c, 0, -s}, {0, 1, 0}, {flip * s, 0, flip * c}};
    for (int row = 0; row < 3; ++row) {
        double translation = 0.0;
        for (int k = 0; k < 3; ++k) {
            set(matrix, row, k, rows[row][k]);
            translation -=
                static_cast<double>(static_cast<float>(rows[row][k])) * options.position[static_cast<std::size_t>(k)];
        }
        set(matrix, row, 3, translation);
    }
    set(matrix, 3, 3, 1.0);
}

void set_depth(const CameraOptions& options, double sign, float (&matrix)[16]) {
    const double n = options.near_depth;
    const double f = options.far_depth;
    double slope = 0.0;
    double constant = 0.0;
    switch (options.projection) {
    case Projection::kStandard:
        slope = f / (f - n), constant = -f * n / (f - n);
        break;
    case Projection::kReversed:
        slope = -n / (f - n), constant = f * n / (f - n);
        break;
    case Projection::kInfinite:
        slope = 1.0, constant = -n;
        break;
    case Projection::kReversedInfinite:
        slope = 0.0, constant = n;
        break;
    case Projection::kOpenGl:
        slope = (f + n) / (f - n), constant = -2.0 * f * n / (f - n);
        break;
    }
    set(matrix, 2, 2, sign * slope);
    set(matrix, 2, 3, constant);
}

// The shader's query, over a frame in memory.
class FrameQuery {
  public:
    explicit FrameQuery(const Frame& frame) : frame_(frame) {}

#define ML_SLICE_EDGE(i) frame_.slice_edges.at(i)
#define ML_CELL(i) frame_.cells.at(i)
#define ML_NODE(i) frame_.nodes.at(i)
#define ML_REFERENCE(i) frame_.references.at(i)
#include <manylights/query.h>
#undef ML_SLICE_EDGE
#undef ML_CELL
#undef ML_NODE
#undef ML_REFERENCE

  private:
    const Frame& frame_;
};

} // namespace

ManylightsView make_view(const CameraOptions& options) {
    ManylightsView view{};
    view.size = sizeof(view);
    view.width = options.width;
    view.height = options.height;
    view.guard_px = 0.5f;
    const double sign = options.looks_down_negative_z ? -1.0 : 1.0;
    const double aspect = static_cast<double>(options.width) / options.height;
    set_placement(options, view.view_from_world);
    set(view.clip_from_view, 0, 0, 1.0 / (options.tangent * aspect));
    set(view.clip_from_view, 1, 1, -1.0 / options.tangent);
    set(view.clip_from_view, 3, 2, sign);
    set_depth(options, sign, view.clip_from_view);
    return view;
}

std::vector<ManylightsSphere> make_lights(std::uint32_t count, std::uint64_t seed, double half_size, double min_range,
                                          double max_range) {
    Random random(seed);
    std::vector<ManylightsSphere> spheres(count);
    for (ManylightsSphere& sphere : spheres) {
        for (float& x : sphere.center) x = random.between(-half_size, half_size);
        sphere.range = random.between(min_range, max_range);
    }
    return spheres;
}

ManylightsLights lights_of(const std::vector<ManylightsSphere>& spheres) {
    ManylightsLights lights{};
    lights.size = sizeof(lights);
    lights.spheres = spheres.data();
    lights.count = static_cast<std::uint32_t>(spheres.size());
    return lights;
}

ManylightsSettings settings_of(std::uint32_t structure) {
    ManylightsSettings settings{};
    settings.size = sizeof(settings);
    settings.structure = structure;
    return settings;
}

BuilderPtr make_builder(const ManylightsSettings& settings) {
    ManylightsBuilder* builder = nullptr;
    ManylightsReport report{};
    EXPECT_EQ(manylights_create(&settings, &builder, &report), MANYLIGHTS_OK) << report.field << " " << report.rule;
    return BuilderPtr(builder);
}

void Frame::allocate(const ManylightsSizes& planned) {
    sizes = planned;
    views.assign(planned.views / sizeof(MlView), {});
    slice_edges.assign(planned.slice_edges / sizeof(float), -1.0f);
    cells.assign(planned.cells / sizeof(MlCell), {0xDDDDDDDD, 0xDDDDDDDD});
    nodes.assign(planned.nodes / sizeof(MlNode), {-1.0f, -1.0f, 0xDDDDDDDD, 0xDDDDDDDD});
    references.assign(planned.references / sizeof(MlUint), 0xDDDDDDDD);
}

ManylightsBuffers Frame::buffers() {
    return {views.data(), slice_edges.data(), cells.data(), nodes.data(), references.data()};
}

std::size_t Frame::list_count() const {
    if (!has_windows()) return cells.size();
    std::size_t tiles = 0;
    for (const MlView& view : views) tiles += std::size_t{view.tiles_x} * view.tiles_y;
    return tiles;
}

std::string Frame::bytes() const {
    std::string all;
    const auto append = [&](const auto& elements) {
        all.append(reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(elements[0]));
    };
    append(views);
    append(slice_edges);
    append(cells);
    append(nodes);
    append(references);
    return all;
}

Frame build_frame(ManylightsBuilder* builder, const std::vector<ManylightsView>& views,
                  const std::vector<ManylightsSphere>& spheres) {
    Frame frame;
    const ManylightsLights lights = lights_of(spheres);
    ManylightsSizes sizes{};
    ManylightsReport report{};
    EXPECT_EQ(
        manylights_plan(builder, views.data(), static_cast<std::uint32_t>(views.size()), &lights, &sizes, &report),
        MANYLIGHTS_OK)
        << report.field << " " << report.rule;
    frame.allocate(sizes);
    const ManylightsBuffers buffers = frame.buffers();
    EXPECT_EQ(manylights_write(builder, &buffers, &report), MANYLIGHTS_OK) << report.field << " " << report.rule;
    return frame;
}

ManylightsReport validate(ManylightsBuilder* builder, Frame& frame, std::uint32_t light_count) {
    ManylightsReport report{};
    const ManylightsBuffers buffers = frame.buffers();
    manylights_validate(builder, &buffers, &frame.sizes, light_count, &report);
    return report;
}

std::vector<MlUint> lights_at(const Frame& frame, std::uint32_t view, float x, float y, float depth) {
    FrameQuery query(frame);
    std::vector<MlUint> lights;
    auto cursor = query.ml_begin(frame.views.at(view), {x, y}, depth);
    for (MlUint light = 0; query.ml_next(cursor, light);) lights.push_back(light);
    return lights;
}

// A tile's references end where those of the next one begin: behind a view's headers, that is the next view's first.
std::vector<MlUint> lights_of_tile(const Frame& frame, std::uint32_t header) {
    std::size_t end = frame.reference_count();
    for (const MlView& view : frame.views) {
        const std::uint32_t headers_end = view.cell_offset + 2 * view.tiles_x * view.tiles_y;
        if (header < view.cell_offset)
            end = std::min<std::size_t>(end, frame.cells.at(view.cell_offset).first);
        else if (header + 2 < headers_end)
            end = std::min<std::size_t>(end, frame.cells.at(header + 2).first);
    }
    std::vector<MlUint> lights;
    for (std::size_t i = frame.cells.at(header).first; i < end; ++i) lights.push_back(frame.references.at(2 * i));
    return lights;
}

std::vector<MlUint> lights_of_cell(const Frame& frame, std::uint32_t cell) {
    std::vector<MlUint> lights;
    const auto append = [&](MlUint first, MlUint count) {
        for (MlUint i = first; i < first + count; ++i) lights.push_back(frame.references.at(i));
    };
    if (frame.has_windows()) return lights_of_tile(frame, cell);
    const MlCell record = frame.cells.at(cell);
    if (frame.views[0].structure == ML_STRUCTURE_LISTS) {
        append(record.first, record.count);
        return lights;
    }
    for (MlUint n = record.first; n < record.first + record.count; ++n) {
        const MlNode& node = frame.nodes.at(n);
        if (ml_node_is_leaf(node.bits)) append(node.first, ml_node_light_count(node.bits));
    }
    return lights;
}

} // namespace manylights::test
