#include "src/build/builder.h"

using namespace manylights::detail;

namespace {

bool is_aligned(const void* pointer, std::size_t alignment) {
    return reinterpret_cast<std::uintptr_t>(pointer) % alignment == 0;
}

Outcome check_lights(const ManylightsLights* lights) {
    if (lights == nullptr) return invalid("lights", "must not be null");
    if (lights->size < sizeof(ManylightsLights)) return invalid("lights.size", "must be sizeof(ManylightsLights)");
    if (lights->count == UINT32_MAX) return invalid("lights.count", "must be at most 2^32 - 2");
    if (lights->count > 0 && lights->spheres == nullptr) return invalid("lights.spheres", "must not be null");
    if (!is_aligned(lights->spheres, alignof(float))) return invalid("lights.spheres", "must be aligned to 4");
    const std::size_t stride = lights->sphere_stride;
    if (stride % alignof(float) != 0 || (stride != 0 && stride < sizeof(ManylightsSphere)))
        return invalid("lights.sphere_stride", "must be 0, or a multiple of 4 and at least 16");
    if (!(lights->motion_margin >= 0.0f && lights->motion_margin <= 1e18f))
        return invalid("lights.motion_margin", "must be in [0, 1e18]");
    return {};
}

// A caller that was built against a later version may hand in larger structs; their size is the stride of the array.
const ManylightsView& view_at(const ManylightsView* views, std::uint32_t index) {
    return *reinterpret_cast<const ManylightsView*>(reinterpret_cast<const char*>(views) + index * views->size);
}

Outcome check_views(const ManylightsView* views, std::uint32_t view_count, Camera* cameras) {
    if (views == nullptr) return invalid("views", "must not be null");
    if (view_count < 1 || view_count > kMaxViews) return invalid("view_count", "must be in [1, 8]");
    for (std::uint32_t v = 0; v < view_count; ++v) {
        const std::size_t size = view_at(views, v).size;
        if (size < sizeof(ManylightsView) || size % alignof(ManylightsView) != 0 || size != views->size)
            return invalid("view.size", "must be sizeof(ManylightsView), the same for all views", v);
        if (Outcome outcome = recognise_camera(view_at(views, v), v, cameras[v]); !outcome.ok()) return outcome;
    }
    return {};
}

Outcome plan(ManylightsBuilder* builder, const ManylightsView* views, std::uint32_t view_count,
             const ManylightsLights* lights, ManylightsSizes* sizes) {
    if (builder == nullptr) return invalid("builder", "must not be null");
    builder->planned = false;
    if (sizes == nullptr) return invalid("sizes", "must not be null");
    *sizes = {};
    Camera cameras[kMaxViews];
    if (Outcome outcome = check_views(views, view_count, cameras); !outcome.ok()) return outcome;
    if (Outcome outcome = check_lights(lights); !outcome.ok()) return outcome;

    builder->view_count = view_count;
    for (std::uint32_t v = 0; v < view_count; ++v) {
        builder->views[v].camera = cameras[v];
        builder->grids[v].width = cameras[v].axes[0].size;
        builder->grids[v].height = cameras[v].axes[1].size;
    }
    if (Outcome outcome = arrange(*builder, *lights); !outcome.ok()) return outcome;
    builder->planned = true;
    *sizes = sizes_of(builder->counts);
    return {};
}

Outcome find_visible(const ManylightsBuilder* builder, std::uint32_t view, const std::uint32_t** indices,
                     std::uint32_t* count) {
    if (builder == nullptr) return invalid("builder", "must not be null");
    if (indices == nullptr) return invalid("indices", "must not be null");
    if (count == nullptr) return invalid("count", "must not be null");
    if (!builder->planned) return {MANYLIGHTS_NOT_PLANNED, "builder", "must have been planned with success", 0};
    if (view >= builder->view_count) return invalid("view", "must be less than the view_count of the plan");
    const Array<std::uint32_t>& visible = builder->views[view].visible;
    *indices = visible.data();
    *count = static_cast<std::uint32_t>(visible.size());
    return {};
}

} // namespace

ManylightsStatus manylights_plan(ManylightsBuilder* builder, const ManylightsView* views, uint32_t view_count,
                                 const ManylightsLights* lights, ManylightsSizes* sizes, ManylightsReport* report) {
    return hand_out(plan(builder, views, view_count, lights, sizes), report);
}

ManylightsStatus manylights_visible(const ManylightsBuilder* builder, uint32_t view, const uint32_t** indices,
                                    uint32_t* count, ManylightsReport* report) {
    return hand_out(find_visible(builder, view, indices, count), report);
}

void manylights_stats(const ManylightsBuilder* builder, ManylightsStats* stats) {
    if (stats == nullptr) return;
    *stats = builder != nullptr ? builder->stats : ManylightsStats{};
}
