#pragma once
// Storage buffers. Every buffer can be bound to shaders, copied from and copied to.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

typedef struct VkBuffer_T* VkBuffer;

namespace manylights::lab::gpu {

class Device;
struct Context;

enum class Memory {
    device,   ///< fast for the GPU, not mapped; upload and download go through a staging buffer
    upload,   ///< mapped, coherent; the CPU writes it, ascending, and should not read it
    readback, ///< mapped, coherent, cached where there is such memory; the CPU reads it
};

/// A buffer of a fixed size; 0 bytes are allowed and can be bound. Contents are undefined until written. Must not be
/// destroyed while commands that use it are running (after Commands::submit_and_wait none are). Keeps what it needs of
/// the device alive.
class Buffer {
  public:
    /// name: what the buffer is for, in messages. Throws DeviceError that names the size and the limit.
    Buffer(Device& device, std::string name, std::uint64_t bytes, Memory memory = Memory::device);

    Buffer(std::shared_ptr<Context> context, std::string name, std::uint64_t bytes, Memory memory);

    /// A buffer with these elements.
    template <typename T>
    Buffer(Device& device, std::string name, std::span<const T> elements, Memory memory = Memory::device)
        : Buffer(device, std::move(name), elements.size_bytes(), memory) {
        upload(elements);
    }

    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;
    ~Buffer();

    std::uint64_t bytes() const;
    const std::string& name() const;
    VkBuffer handle() const;
    std::byte* mapped() const; ///< null for Memory::device

    void upload_bytes(std::span<const std::byte> source, std::uint64_t offset = 0);
    void download_bytes(std::span<std::byte> target, std::uint64_t offset = 0) const;
    void fill(std::uint32_t word); ///< every 32-bit word of the buffer; a tail shorter than a word is left

    template <typename T>
    void upload(std::span<const T> source, std::uint64_t offset = 0) {
        static_assert(std::is_trivially_copyable_v<T>);
        upload_bytes(std::as_bytes(source), offset);
    }
    template <typename T>
    void upload(const std::vector<T>& source, std::uint64_t offset = 0) {
        upload(std::span<const T>(source), offset);
    }

    /// count elements from a byte offset.
    template <typename T>
    std::vector<T> download(std::size_t count, std::uint64_t offset = 0) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> result(count);
        download_bytes(std::as_writable_bytes(std::span<T>(result)), offset);
        return result;
    }
    /// All whole elements.
    template <typename T>
    std::vector<T> download() const {
        return download<T>(std::size_t(bytes() / sizeof(T)));
    }

  private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace manylights::lab::gpu
