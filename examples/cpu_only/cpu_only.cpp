// manylights without a graphics device: plan and write on the CPU, then ask the buffers, with the very text that
// shaders include, which lights reach one point.
#include <manylights/format.h>
#include <manylights/manylights.hpp>

#include <cstdio>
#include <vector>

// The buffers, where a renderer would have its bindings.
struct Buffers {
    std::vector<manylights::MlView> views;
    std::vector<float> slice_edges;
    std::vector<manylights::MlCell> cells;
    std::vector<manylights::MlNode> nodes;
    std::vector<std::uint32_t> references;
};
static Buffers frame;

namespace manylights {
#define ML_SLICE_EDGE(i) frame.slice_edges[i]
#define ML_CELL(i) frame.cells[i]
#define ML_NODE(i) frame.nodes[i]
#define ML_REFERENCE(i) frame.references[i]
#include <manylights/query.h>
} // namespace manylights

// A camera at the origin that looks along -z: 90 degrees both ways, reversed depth, infinite far plane, near 0.1.
static ManylightsView make_camera() {
    ManylightsView view = manylights::make_view();
    view.width = view.height = 480;
    for (int i = 0; i < 4; ++i) view.view_from_world[5 * i] = 1.0f;
    view.clip_from_view[0] = 1.0f;   // x
    view.clip_from_view[5] = -1.0f;  // y: rows grow downwards
    view.clip_from_view[11] = -1.0f; // w = -z
    view.clip_from_view[14] = 0.1f;  // depth = near
    return view;
}

static bool failed(const char* call, const manylights::Status& status) {
    if (status) return false;
    std::fprintf(stderr, "%s: %s: %s %s\n", call, status.name(), status.report.field, status.report.rule);
    return true;
}

int main() {
    std::vector<ManylightsSphere> lights;
    for (int i = 0; i < 1000; ++i) // a wall of lights, 10 units in front of the camera
        lights.push_back({{static_cast<float>(i % 40) - 19.5f, static_cast<float>(i / 40) - 12.0f, -10.0f}, 1.5f});

    manylights::Builder builder;
    if (failed("create", builder.create())) return 1;
    const ManylightsView views[] = {make_camera()};
    ManylightsSizes sizes{};
    if (failed("plan", builder.plan(views, manylights::make_lights(lights), sizes))) return 1;
    frame.views.resize(sizes.views / sizeof(manylights::MlView));
    frame.slice_edges.resize(sizes.slice_edges / sizeof(float));
    frame.cells.resize(sizes.cells / sizeof(manylights::MlCell));
    frame.nodes.resize(sizes.nodes / sizeof(manylights::MlNode));
    frame.references.resize(sizes.references / sizeof(std::uint32_t));
    const ManylightsBuffers buffers = {frame.views.data(), frame.slice_edges.data(), frame.cells.data(),
                                       frame.nodes.data(), frame.references.data()};
    if (failed("write", builder.write(buffers))) return 1;

    const manylights::MlFloat3 point = {0.0f, 0.0f, -10.0f}; // in the middle of the image, depth 10
    manylights::MlCursor cursor = manylights::ml_begin(frame.views[0], {240.0f, 240.0f}, 10.0f);
    int tested = 0;
    int affecting = 0;
    for (std::uint32_t light = 0; manylights::ml_next(cursor, light); ++tested) {
        const ManylightsSphere& s = lights[light];
        if (manylights::ml_affects(point, {s.center[0], s.center[1], s.center[2]}, s.range)) ++affecting;
    }
    const ManylightsStats stats = builder.stats();
    std::printf("%zu lights, %llu in view, %llu bytes; at the point: %d tested, %d affecting\n", lights.size(),
                static_cast<unsigned long long>(stats.visible_lights), static_cast<unsigned long long>(stats.bytes),
                tested, affecting);
    return affecting > 0 ? 0 : 1;
}
