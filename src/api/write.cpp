#include "src/build/builder.h"
#include "src/format/validate.h"

using namespace manylights::detail;

namespace {

struct BufferCheck {
    const char* field;
    const void* pointer;
    std::uint64_t bytes;
};

// alignment: 16 where the library writes, 4 where it only reads.
Outcome check_buffers(const ManylightsBuffers* buffers, const ManylightsSizes& sizes, std::size_t alignment,
                      const char* alignment_rule) {
    if (buffers == nullptr) return invalid("buffers", "must not be null");
    const BufferCheck checks[] = {{"buffers.views", buffers->views, sizes.views},
                                  {"buffers.slice_edges", buffers->slice_edges, sizes.slice_edges},
                                  {"buffers.cells", buffers->cells, sizes.cells},
                                  {"buffers.nodes", buffers->nodes, sizes.nodes},
                                  {"buffers.references", buffers->references, sizes.references}};
    for (const BufferCheck& check : checks) {
        if (check.pointer == nullptr && check.bytes != 0) return invalid(check.field, "must not be null");
        if (reinterpret_cast<std::uintptr_t>(check.pointer) % alignment != 0)
            return invalid(check.field, alignment_rule);
    }
    return {};
}

Outcome write(ManylightsBuilder* builder, const ManylightsBuffers* buffers) {
    if (builder == nullptr) return invalid("builder", "must not be null");
    if (!builder->planned) return {MANYLIGHTS_NOT_PLANNED, "builder", "must have been planned with success", 0};
    const ManylightsSizes sizes = sizes_of(builder->counts);
    if (Outcome outcome = check_buffers(buffers, sizes, 16, "must be aligned to 16"); !outcome.ok()) return outcome;
    write_buffers(*builder, *buffers);
    return {};
}

Outcome check(ManylightsBuilder* builder, const ManylightsBuffers* buffers, const ManylightsSizes* sizes,
              std::uint32_t light_count) {
    if (builder == nullptr) return invalid("builder", "must not be null");
    if (sizes == nullptr) return invalid("sizes", "must not be null");
    if (Outcome outcome = check_buffers(buffers, *sizes, 4, "must be aligned to 4"); !outcome.ok()) return outcome;
    if (!builder->validate_marks.resize(mark_words(light_count))) return out_of_memory("light_count");
    return validate_buffers(*buffers, *sizes, light_count, builder->validate_marks.data());
}

} // namespace

ManylightsStatus manylights_write(ManylightsBuilder* builder, const ManylightsBuffers* buffers,
                                  ManylightsReport* report) {
    return hand_out(write(builder, buffers), report);
}

ManylightsStatus manylights_validate(ManylightsBuilder* builder, const ManylightsBuffers* buffers,
                                     const ManylightsSizes* sizes, uint32_t light_count, ManylightsReport* report) {
    return hand_out(check(builder, buffers, sizes, light_count), report);
}
