// Each argument that breaks its rule is refused with the name of its field, and each status is produced.

#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace manylights::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void* allocate_nothing(void*, std::size_t, std::size_t) { return nullptr; }
void release_nothing(void*, void*, std::size_t) {}

struct BadSettings {
    const char* field;
    std::function<void(ManylightsSettings&)> spoil;
};

TEST(Create, RefusesEachBadSettingByName) {
    const BadSettings rows[] = {
        {"settings.size", [](auto& s) { s.size = 0; }},
        {"settings.size", [](auto& s) { s.size = sizeof(s) - 1; }},
        {"settings.structure", [](auto& s) { s.structure = 5; }},
        {"settings.tile_px", [](auto& s) { s.tile_px = 7; }},
        {"settings.tile_px", [](auto& s) { s.tile_px = 65537; }},
        {"settings.slice_count", [](auto& s) { s.slice_count = 129; }},
        {"settings.leaf_size", [](auto& s) { s.leaf_size = 65536; }},
        {"settings.slice_near", [](auto& s) { s.slice_near = -1.0f; }},
        {"settings.slice_near", [](auto& s) { s.slice_near = kNan; }},
        {"settings.slice_near", [](auto& s) { s.slice_near = kInfinity; }},
        {"settings.slice_far", [](auto& s) { s.slice_far = kNan; }},
        {"settings.slice_far", [](auto& s) { s.slice_far = kInfinity; }},
        {"settings.slice_far", [](auto& s) { s.slice_far = -1.0f; }},
        {"settings.slice_far", [](auto& s) { s.slice_near = 600.0f; }},
        {"settings.slice_far", [](auto& s) { s.slice_near = s.slice_far = 7.0f; }},
        {"settings.max_workers", [](auto& s) { s.max_workers = 1025; }},
        {"settings.allocate", [](auto& s) { s.release = release_nothing; }},
        {"settings.release", [](auto& s) { s.allocate = allocate_nothing; }},
    };
    for (const BadSettings& row : rows) {
        ManylightsSettings settings = settings_of(MANYLIGHTS_STRUCTURE_HYBRID);
        row.spoil(settings);
        auto* builder = reinterpret_cast<ManylightsBuilder*>(&settings);
        ManylightsReport report{};
        EXPECT_EQ(manylights_create(&settings, &builder, &report), MANYLIGHTS_INVALID_ARGUMENT) << row.field;
        EXPECT_STREQ(report.field, row.field);
        EXPECT_STRNE(report.rule, "");
        EXPECT_EQ(report.status, MANYLIGHTS_INVALID_ARGUMENT);
        EXPECT_EQ(builder, nullptr);
        manylights_destroy(builder);
    }
}

TEST(Create, TakesDefaultsForNullAndForZeros) {
    ManylightsBuilder* builder = nullptr;
    EXPECT_EQ(manylights_create(nullptr, &builder, nullptr), MANYLIGHTS_OK);
    const BuilderPtr defaults(builder);
    Frame frame = build_frame(builder, {make_view()}, {});
    EXPECT_EQ(frame.views[0].structure, ML_STRUCTURE_WINDOWS);
    EXPECT_EQ(frame.views[0].tile_px, 32u);

    const BuilderPtr hybrid = make_builder(settings_of(MANYLIGHTS_STRUCTURE_HYBRID));
    frame = build_frame(hybrid.get(), {make_view()}, {});
    EXPECT_EQ(frame.views[0].structure, ML_STRUCTURE_HYBRID);
    EXPECT_EQ(frame.views[0].tile_px, 48u);
    EXPECT_EQ(frame.views[0].slice_count, 16u);

    ManylightsReport report{};
    EXPECT_EQ(manylights_create(nullptr, nullptr, &report), MANYLIGHTS_INVALID_ARGUMENT);
    EXPECT_STREQ(report.field, "builder");
}

TEST(Create, SaysThatMemoryIsMissing) {
    ManylightsSettings settings = settings_of(0);
    settings.allocate = allocate_nothing;
    settings.release = release_nothing;
    ManylightsBuilder* builder = nullptr;
    EXPECT_EQ(manylights_create(&settings, &builder, nullptr), MANYLIGHTS_OUT_OF_MEMORY);
    EXPECT_EQ(builder, nullptr);
}

// Everything that plan is given; a row spoils one thing.
struct PlanCall {
    BuilderPtr owner = make_builder(settings_of(MANYLIGHTS_STRUCTURE_HYBRID));
    ManylightsBuilder* builder = owner.get();
    std::vector<ManylightsView> storage = {make_view(), make_view()};
    const ManylightsView* views = storage.data();
    std::uint32_t view_count = 2;
    std::vector<ManylightsSphere> spheres = make_lights(3, 1, 10, 1, 2);
    ManylightsLights light_storage = lights_of(spheres);
    const ManylightsLights* lights = &light_storage;
    ManylightsSizes size_storage{};
    ManylightsSizes* sizes = &size_storage;

    ManylightsReport plan() const {
        ManylightsReport report{};
        const ManylightsStatus status = manylights_plan(builder, views, view_count, lights, sizes, &report);
        EXPECT_EQ(status, report.status);
        return report;
    }
};

struct BadPlan {
    const char* field;
    ManylightsStatus status;
    std::uint64_t index;
    std::function<void(PlanCall&)> spoil;
};

constexpr ManylightsStatus kArgument = MANYLIGHTS_INVALID_ARGUMENT;
constexpr ManylightsStatus kCamera = MANYLIGHTS_INVALID_CAMERA;

void expect_refusals(const std::vector<BadPlan>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        PlanCall call;
        ASSERT_EQ(call.plan().status, MANYLIGHTS_OK);
        rows[i].spoil(call);
        const ManylightsReport report = call.plan();
        EXPECT_EQ(report.status, rows[i].status) << "row " << i << " " << rows[i].field;
        EXPECT_STREQ(report.field, rows[i].field) << "row " << i;
        EXPECT_STRNE(report.rule, "") << "row " << i;
        EXPECT_EQ(report.index, rows[i].index) << "row " << i;
        if (call.builder == nullptr) continue;
        const ManylightsBuffers buffers{};
        EXPECT_EQ(manylights_write(call.builder, &buffers, nullptr), MANYLIGHTS_NOT_PLANNED) << "row " << i;
    }
}

TEST(Plan, RefusesEachBadArgumentByName) {
    expect_refusals({
        {"builder", kArgument, 0, [](PlanCall& c) { c.builder = nullptr; }},
        {"sizes", kArgument, 0, [](PlanCall& c) { c.sizes = nullptr; }},
        {"views", kArgument, 0, [](PlanCall& c) { c.views = nullptr; }},
        {"view_count", kArgument, 0, [](PlanCall& c) { c.view_count = 0; }},
        {"view_count", kArgument, 0, [](PlanCall& c) { c.view_count = 9; }},
        {"view.size", kArgument, 0, [](PlanCall& c) { c.storage[0].size = 0; }},
        {"view.size", kArgument, 1, [](PlanCall& c) { c.storage[1].size = sizeof(ManylightsView) + 8; }},
        {"view.width", kArgument, 1, [](PlanCall& c) { c.storage[1].width = 0; }},
        {"view.width", kArgument, 0, [](PlanCall& c) { c.storage[0].width = 65537; }},
        {"view.height", kArgument, 1, [](PlanCall& c) { c.storage[1].height = 0; }},
        {"view.height", kArgument, 1, [](PlanCall& c) { c.storage[1].height = 4000000000u; }},
        {"view.guard_px", kArgument, 0, [](PlanCall& c) { c.storage[0].guard_px = -0.1f; }},
        {"view.guard_px", kArgument, 0, [](PlanCall& c) { c.storage[0].guard_px = 65.0f; }},
        {"view.guard_px", kArgument, 0, [](PlanCall& c) { c.storage[0].guard_px = kNan; }},
        {"view.clip_y_up", kArgument, 0, [](PlanCall& c) { c.storage[0].clip_y_up = 2; }},
        {"lights", kArgument, 0, [](PlanCall& c) { c.lights = nullptr; }},
        {"lights.size", kArgument, 0, [](PlanCall& c) { c.light_storage.size = 1; }},
        {"lights.count", kArgument, 0, [](PlanCall& c) { c.light_storage.count = UINT32_MAX; }},
        {"lights.spheres", kArgument, 0, [](PlanCall& c) { c.light_storage.spheres = nullptr; }},
        {"lights.spheres", kArgument, 0,
         [](PlanCall& c) { c.light_storage.spheres = reinterpret_cast<const char*>(c.spheres.data()) + 2; }},
        {"lights.sphere_stride", kArgument, 0, [](PlanCall& c) { c.light_storage.sphere_stride = 12; }},
        {"lights.sphere_stride", kArgument, 0, [](PlanCall& c) { c.light_storage.sphere_stride = 18; }},
        {"lights.motion_margin", kArgument, 0, [](PlanCall& c) { c.light_storage.motion_margin = -1.0f; }},
        {"lights.motion_margin", kArgument, 0, [](PlanCall& c) { c.light_storage.motion_margin = kNan; }},
        {"lights.motion_margin", kArgument, 0, [](PlanCall& c) { c.light_storage.motion_margin = kInfinity; }},
    });
}

// Element [4 * column + row].
TEST(Plan, RefusesEachUnusableMatrixByName) {
    const char* kWorld = "view.view_from_world";
    const char* kClip = "view.clip_from_view";
    const auto world = [](int element, float value) {
        return [=](PlanCall& c) { c.storage[1].view_from_world[element] = value; };
    };
    const auto clip = [](int element, float value) {
        return [=](PlanCall& c) { c.storage[1].clip_from_view[element] = value; };
    };
    expect_refusals({
        {kWorld, kCamera, 1, world(12, kNan)},
        {kWorld, kCamera, 1, world(5, kInfinity)},
        {kWorld, kCamera, 1, world(15, 0.0f)},
        {kWorld, kCamera, 1, world(3, 1.0f)},
        {kWorld, kCamera, 1, world(0, 2.0f)},  // scale
        {kWorld, kCamera, 1, world(0, 0.0f)},  // singular
        {kWorld, kCamera, 1, world(4, 0.01f)}, // shear
        {kWorld, kCamera, 1,
         [](PlanCall& c) {
             for (float& x : c.storage[1].view_from_world) x = 0.0f;
         }},
        {kClip, kCamera, 1, clip(0, kNan)},
        {kClip, kCamera, 1, clip(14, kInfinity)},
        {kClip, kCamera, 1, clip(0, 0.0f)},
        {kClip, kCamera, 1, clip(5, 0.0f)},
        {kClip, kCamera, 1, clip(5, 1e30f)},
        {kClip, kCamera, 1, clip(8, 1e30f)},
        {kClip, kCamera, 1, clip(1, 0.5f)},  // clip y grows with view x
        {kClip, kCamera, 1, clip(4, 0.5f)},  // clip x grows with view y
        {kClip, kCamera, 1, clip(12, 0.5f)}, // a constant in clip x
        {kClip, kCamera, 1, clip(3, 0.5f)},  // w grows with view x
        {kClip, kCamera, 1, clip(15, 1.0f)}, // w has a constant
        {kClip, kCamera, 1, clip(11, 0.0f)}, // no w at all
        {kClip, kCamera, 1,
         [](PlanCall& c) { c.storage[1].clip_from_view[11] = 0.0f, c.storage[1].clip_from_view[15] = 1.0f; }},
        {kClip, kCamera, 1,
         [](PlanCall& c) {
             for (float& x : c.storage[1].clip_from_view) x = 0.0f;
         }},
    });
}

TEST(Plan, SaysThatOrthographicCamerasAreNotServed) {
    PlanCall call;
    call.storage[0].clip_from_view[11] = 0.0f;
    call.storage[0].clip_from_view[15] = 1.0f;
    EXPECT_NE(std::string(call.plan().rule).find("orthographic"), std::string::npos);
}

TEST(Plan, AcceptsNoLightsWithoutPointer) {
    PlanCall call;
    call.light_storage.spheres = nullptr;
    call.light_storage.count = 0;
    EXPECT_EQ(call.plan().status, MANYLIGHTS_OK);
    EXPECT_EQ(call.size_storage.references, 0u);
}

// Larger structs come from a caller that was built against a later version.
TEST(Plan, ReadsViewsWithTheStrideOfTheirSize) {
    struct LaterView {
        ManylightsView view;
        std::uint64_t more;
    };
    PlanCall call;
    LaterView later[2] = {{make_view(), 1}, {make_view(), 2}};
    later[0].view.size = later[1].view.size = sizeof(LaterView);
    later[1].view.width = 100;
    ASSERT_EQ(manylights_plan(call.builder, &later[0].view, 2, call.lights, call.sizes, nullptr), MANYLIGHTS_OK);
    Frame frame;
    frame.allocate(call.size_storage);
    const ManylightsBuffers buffers = frame.buffers();
    ASSERT_EQ(manylights_write(call.builder, &buffers, nullptr), MANYLIGHTS_OK);
    EXPECT_EQ(frame.views[1].width, 100u);
}

struct BadWrite {
    const char* field;
    std::function<void(ManylightsBuffers&)> spoil;
};

template <typename Pointer>
void misalign(Pointer& pointer) {
    pointer = static_cast<char*>(pointer) + 4;
}

TEST(Write, RefusesEachBadBufferByName) {
    PlanCall call;
    call.spheres = make_lights(500, 1, 30, 5, 9);
    call.light_storage = lights_of(call.spheres);
    ASSERT_EQ(call.plan().status, MANYLIGHTS_OK);
    ASSERT_GT(call.size_storage.nodes, 0u);
    const BadWrite rows[] = {
        {"buffers.views", [](ManylightsBuffers& b) { b.views = nullptr; }},
        {"buffers.views", [](ManylightsBuffers& b) { misalign(b.views); }},
        {"buffers.slice_edges", [](ManylightsBuffers& b) { b.slice_edges = nullptr; }},
        {"buffers.slice_edges", [](ManylightsBuffers& b) { misalign(b.slice_edges); }},
        {"buffers.cells", [](ManylightsBuffers& b) { b.cells = nullptr; }},
        {"buffers.cells", [](ManylightsBuffers& b) { misalign(b.cells); }},
        {"buffers.nodes", [](ManylightsBuffers& b) { b.nodes = nullptr; }},
        {"buffers.nodes", [](ManylightsBuffers& b) { misalign(b.nodes); }},
        {"buffers.references", [](ManylightsBuffers& b) { b.references = nullptr; }},
        {"buffers.references", [](ManylightsBuffers& b) { misalign(b.references); }},
    };
    Frame frame;
    frame.allocate(call.size_storage);
    for (const BadWrite& row : rows) {
        ManylightsBuffers buffers = frame.buffers();
        row.spoil(buffers);
        ManylightsReport report{};
        EXPECT_EQ(manylights_write(call.builder, &buffers, &report), kArgument) << row.field;
        EXPECT_STREQ(report.field, row.field);
    }
    ManylightsReport report{};
    EXPECT_EQ(manylights_write(call.builder, nullptr, &report), kArgument);
    EXPECT_STREQ(report.field, "buffers");
    const ManylightsBuffers buffers = frame.buffers();
    EXPECT_EQ(manylights_write(nullptr, &buffers, &report), kArgument);
    EXPECT_STREQ(report.field, "builder");
    EXPECT_EQ(manylights_write(call.builder, &buffers, &report), MANYLIGHTS_OK) << "the plan must have survived";
    EXPECT_STREQ(report.field, "");
}

TEST(Visible, RefusesBadArgumentsByName) {
    PlanCall call;
    const std::uint32_t* indices = nullptr;
    std::uint32_t count = 0;
    ManylightsReport report{};
    EXPECT_EQ(manylights_visible(call.builder, 0, &indices, &count, &report), MANYLIGHTS_NOT_PLANNED);
    ASSERT_EQ(call.plan().status, MANYLIGHTS_OK);
    EXPECT_EQ(manylights_visible(call.builder, 1, &indices, &count, &report), MANYLIGHTS_OK);
    EXPECT_EQ(manylights_visible(call.builder, 2, &indices, &count, &report), kArgument);
    EXPECT_STREQ(report.field, "view");
    EXPECT_EQ(manylights_visible(call.builder, 0, nullptr, &count, &report), kArgument);
    EXPECT_STREQ(report.field, "indices");
    EXPECT_EQ(manylights_visible(call.builder, 0, &indices, nullptr, &report), kArgument);
    EXPECT_STREQ(report.field, "count");
    EXPECT_EQ(manylights_visible(nullptr, 0, &indices, &count, &report), kArgument);
    EXPECT_STREQ(report.field, "builder");
}

TEST(Stats, AreZeroWithoutPlanOrBuilder) {
    ManylightsStats stats;
    stats.bytes = 1;
    manylights_stats(nullptr, &stats);
    EXPECT_EQ(stats.bytes, 0u);
    PlanCall call;
    stats.tile_px = 1;
    manylights_stats(call.builder, &stats);
    EXPECT_EQ(stats.tile_px, 0u);
    manylights_stats(call.builder, nullptr);
}

TEST(StatusName, NamesEachStatus) {
    EXPECT_STREQ(manylights_status_name(MANYLIGHTS_OK), "MANYLIGHTS_OK");
    EXPECT_STREQ(manylights_status_name(MANYLIGHTS_INVALID_ARGUMENT), "MANYLIGHTS_INVALID_ARGUMENT");
    EXPECT_STREQ(manylights_status_name(MANYLIGHTS_INVALID_CAMERA), "MANYLIGHTS_INVALID_CAMERA");
    EXPECT_STREQ(manylights_status_name(MANYLIGHTS_OUT_OF_MEMORY), "MANYLIGHTS_OUT_OF_MEMORY");
    EXPECT_STREQ(manylights_status_name(MANYLIGHTS_TOO_LARGE), "MANYLIGHTS_TOO_LARGE");
    EXPECT_STREQ(manylights_status_name(MANYLIGHTS_NOT_PLANNED), "MANYLIGHTS_NOT_PLANNED");
    EXPECT_STREQ(manylights_status_name(MANYLIGHTS_DAMAGED), "MANYLIGHTS_DAMAGED");
    EXPECT_NE(manylights_status_name(static_cast<ManylightsStatus>(7)), nullptr);
}

} // namespace
} // namespace manylights::test
