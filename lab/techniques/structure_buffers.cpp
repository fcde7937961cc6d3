#include "lab/techniques/structure_buffers.h"

#include "lab/gpu/commands.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kPoison = 0xCDCDCDCD;
constexpr const char* kNames[5] = {"structure views", "structure slice edges", "structure cells", "structure nodes",
                                   "structure references"};

std::array<std::uint64_t, 5> size_list(const ManylightsSizes& sizes) {
    return {sizes.views, sizes.slice_edges, sizes.cells, sizes.nodes, sizes.references};
}

} // namespace

void StructureBuffers::reserve(const ManylightsSizes& sizes) {
    const std::array<std::uint64_t, 5> bytes = size_list(sizes);
    if (!mapped_.empty() && bytes == sizes_) return;
    sizes_ = bytes;
    mapped_.clear();
    local_.clear();
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        mapped_.emplace_back(device_, kNames[i], bytes[i], gpu::Memory::upload);
        mapped_.back().fill(kPoison);
        if (!device_.info().is_software) local_.emplace_back(device_, kNames[i], bytes[i], gpu::Memory::device);
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) bindings_[i] = local_.empty() ? &mapped_[i] : &local_[i];
}

ManylightsBuffers StructureBuffers::targets() const {
    const auto target = [this](std::size_t i) -> void* {
        return mapped_[i].bytes() == 0 ? nullptr : mapped_[i].mapped();
    };
    return {target(0), target(1), target(2), target(3), target(4)};
}

void StructureBuffers::finish() {
    if (local_.empty()) return;
    gpu::Commands commands(device_);
    for (std::size_t i = 0; i < mapped_.size(); ++i)
        if (mapped_[i].bytes() != 0) commands.copy(mapped_[i], local_[i], mapped_[i].bytes());
    commands.submit_and_wait("upload of the structure");
}

} // namespace manylights::lab
