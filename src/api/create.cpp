#include "src/build/builder.h"

#include <new>

using namespace manylights::detail;

namespace {

void hand_allocator_to_arrays(ManylightsBuilder& builder) {
    const Allocator& allocator = builder.settings.allocator;
    for (View& view : builder.views) {
        view.lights.index.use(allocator);
        view.lights.counts.use(allocator);
        view.visible.use(allocator);
    }
    builder.records.use(allocator);
    builder.windows.use(allocator);
    builder.cells.use(allocator);
    builder.validate_marks.use(allocator);
}

Outcome create(const ManylightsSettings* given, ManylightsBuilder** result) {
    if (result == nullptr) return invalid("builder", "must not be null");
    *result = nullptr;
    Settings settings{};
    if (Outcome outcome = resolve_settings(given, settings); !outcome.ok()) return outcome;
    void* memory =
        settings.allocator.allocate(settings.allocator.user, sizeof(ManylightsBuilder), alignof(ManylightsBuilder));
    if (memory == nullptr) return out_of_memory("builder");
    auto* builder = new (memory) ManylightsBuilder;
    builder->settings = settings;
    builder->slices = make_slices(settings.slice_count, settings.slice_near, settings.slice_far);
    hand_allocator_to_arrays(*builder);
    *result = builder;
    return {};
}

} // namespace

ManylightsStatus manylights_create(const ManylightsSettings* settings, ManylightsBuilder** builder,
                                   ManylightsReport* report) {
    return hand_out(create(settings, builder), report);
}

void manylights_destroy(ManylightsBuilder* builder) {
    if (builder == nullptr) return;
    const Allocator allocator = builder->settings.allocator;
    builder->~ManylightsBuilder();
    allocator.release(allocator.user, builder, sizeof(ManylightsBuilder));
}

const char* manylights_status_name(ManylightsStatus status) {
    switch (status) {
    case MANYLIGHTS_OK:
        return "MANYLIGHTS_OK";
    case MANYLIGHTS_INVALID_ARGUMENT:
        return "MANYLIGHTS_INVALID_ARGUMENT";
    case MANYLIGHTS_INVALID_CAMERA:
        return "MANYLIGHTS_INVALID_CAMERA";
    case MANYLIGHTS_OUT_OF_MEMORY:
        return "MANYLIGHTS_OUT_OF_MEMORY";
    case MANYLIGHTS_TOO_LARGE:
        return "MANYLIGHTS_TOO_LARGE";
    case MANYLIGHTS_NOT_PLANNED:
        return "MANYLIGHTS_NOT_PLANNED";
    case MANYLIGHTS_DAMAGED:
        return "MANYLIGHTS_DAMAGED";
    }
    return "unknown status";
}
