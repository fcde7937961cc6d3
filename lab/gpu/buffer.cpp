#include "lab/gpu/buffer.h"

#include "lab/gpu/commands.h"
#include "lab/gpu/held.h"

#include <algorithm>
#include <cstring>

namespace manylights::lab::gpu {

struct Buffer::State {
    std::shared_ptr<Context> context;
    std::string name;
    std::uint64_t bytes = 0;
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::Buffer buffer{nullptr};
    std::byte* mapped = nullptr;
};

namespace {

using Property = vk::MemoryPropertyFlagBits;

struct MemoryWish {
    vk::MemoryPropertyFlags required, preferred;
};

MemoryWish wish(Memory memory) {
    switch (memory) {
    case Memory::upload:
        return {Property::eHostVisible | Property::eHostCoherent, {}};
    case Memory::readback:
        return {Property::eHostVisible | Property::eHostCoherent, Property::eHostCached};
    default:
        return {{}, Property::eDeviceLocal};
    }
}

vk::raii::Buffer make_buffer(Context& context, const std::string& what, std::uint64_t bytes) {
    using Usage = vk::BufferUsageFlagBits;
    vk::BufferCreateInfo info;
    // Vulkan has no empty buffers: an empty one holds a few bytes that nobody asked for.
    info.setSize(std::max<std::uint64_t>(bytes, 16))
        .setUsage(Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst | Usage::eVertexBuffer |
                  Usage::eIndexBuffer | Usage::eIndirectBuffer);
    return asking_for(context, "making " + what, [&] { return vk::raii::Buffer(context.vk(), info); });
}

void check_range(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes) {
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset)
        throw DeviceError("buffer '" + buffer.name() + "' has " + std::to_string(buffer.bytes()) +
                          " bytes, and bytes " + std::to_string(offset) + " to " + std::to_string(offset + bytes) +
                          " were asked for");
}

} // namespace

Buffer::Buffer(Device& device, std::string name, std::uint64_t bytes, Memory memory)
    : Buffer(device.context(), std::move(name), bytes, memory) {}

Buffer::Buffer(std::shared_ptr<Context> shared, std::string name, std::uint64_t bytes, Memory memory) {
    Context& context = *shared;
    const std::string what = "buffer '" + name + "' of " + std::to_string(bytes) + " bytes";
    if (bytes > context.info.max_storage_buffer_range)
        throw DeviceError(what + " is larger than the " + std::to_string(context.info.max_storage_buffer_range) +
                          " bytes that a shader of the device " + context.info.name + " can reach");
    State state;
    state.context = std::move(shared);
    state.name = std::move(name);
    state.bytes = bytes;
    state.buffer = make_buffer(context, what, bytes);
    const MemoryWish wanted = wish(memory);
    state.memory = allocate(context, state.buffer.getMemoryRequirements(), wanted.required, wanted.preferred, what);
    asking_for(context, "binding memory to " + what, [&] {
        state.buffer.bindMemory(*state.memory, 0);
        if (memory != Memory::device) state.mapped = static_cast<std::byte*>(state.memory.mapMemory(0, VK_WHOLE_SIZE));
    });
    state_ = make_held(std::move(state));
}

Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;
Buffer::~Buffer() = default;

std::uint64_t Buffer::bytes() const { return state_->bytes; }
const std::string& Buffer::name() const { return state_->name; }
VkBuffer Buffer::handle() const { return *state_->buffer; }
std::byte* Buffer::mapped() const { return state_->mapped; }

void Buffer::upload_bytes(std::span<const std::byte> source, std::uint64_t offset) {
    check_range(*this, offset, source.size());
    if (source.empty()) return;
    if (state_->mapped != nullptr) {
        std::memcpy(state_->mapped + offset, source.data(), source.size());
        return;
    }
    const Buffer staging(state_->context, "upload of " + state_->name, source.size(), Memory::upload);
    std::memcpy(staging.mapped(), source.data(), source.size());
    Commands commands(state_->context);
    commands.copy(staging, *this, source.size(), 0, offset);
    commands.submit_and_wait("an upload");
}

void Buffer::download_bytes(std::span<std::byte> target, std::uint64_t offset) const {
    check_range(*this, offset, target.size());
    if (target.empty()) return;
    if (state_->mapped != nullptr) {
        std::memcpy(target.data(), state_->mapped + offset, target.size());
        return;
    }
    const Buffer staging(state_->context, "download of " + state_->name, target.size(), Memory::readback);
    Commands commands(state_->context);
    commands.copy(*this, staging, target.size(), offset, 0);
    commands.submit_and_wait("a download");
    std::memcpy(target.data(), staging.mapped(), target.size());
}

void Buffer::fill(std::uint32_t word) {
    if (state_->mapped != nullptr) {
        for (std::uint64_t at = 0; at + 4 <= state_->bytes; at += 4) std::memcpy(state_->mapped + at, &word, 4);
        return;
    }
    Commands commands(state_->context);
    commands.fill(*this, word);
    commands.submit_and_wait("a fill");
}

} // namespace manylights::lab::gpu
