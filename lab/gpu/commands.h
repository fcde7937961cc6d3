#pragma once
// Work for the device, recorded once, submitted once, waited for:
//
//     Commands commands(device);
//     commands.fill(counters, 0);
//     commands.barrier();
//     std::uint32_t start = commands.timestamp();
//     commands.dispatch(pipeline, {{points}, {lights}, {counters}}, push, {groups_x, groups_y, 1});
//     std::uint32_t end = commands.timestamp();
//     commands.submit_and_wait();
//     double shade_ms = commands.milliseconds(start, end);

#include "lab/gpu/buffer.h"
#include "lab/gpu/compute_pipeline.h"
#include "lab/gpu/raster_pipeline.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

typedef struct VkCommandBuffer_T* VkCommandBuffer;

namespace manylights::lab::gpu {

class Device;
class Image;
struct Context;

/// A buffer, or a part of it, as a shader sees it. The offset must be a multiple of 256 (the largest alignment that
/// Vulkan allows a device to ask for).
struct Binding {
    const Buffer& buffer;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0; ///< 0: to the end
};

/// An image that is drawn into. It is cleared to zero bits first, unless it keeps what an earlier drawing left there.
struct Target {
    const Image* image = nullptr; ///< none
    bool keeps = false;
};

/// What draws go into. Without images there are only the buffers that the fragment shaders write to.
struct Targets {
    std::uint32_t width, height; ///< pixels; of the images, where there are any
    Target color{}, depth{};
};

struct Mesh {
    const Buffer& vertices;
    const Buffer& indices; ///< of 32 bits
    std::uint32_t index_count;
};

struct VertexRange {
    std::uint32_t vertices, instances;
};

class Commands {
  public:
    explicit Commands(Device& device);
    explicit Commands(std::shared_ptr<Context> context);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    void dispatch(const ComputePipeline& pipeline, const std::vector<Binding>& buffers,
                  std::span<const std::byte> push_constants, const std::array<std::uint32_t, 3>& groups);

    template <typename T>
    void dispatch(const ComputePipeline& pipeline, const std::vector<Binding>& buffers, const T& push_constants,
                  const std::array<std::uint32_t, 3>& groups) {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
        dispatch(pipeline, buffers, std::as_bytes(std::span<const T>(&push_constants, 1)), groups);
    }

    /// Draws are recorded between these two, and nothing else. Their fragments come in no order, but for what they do
    /// to the images: that is done in the order of primitives, draw by draw.
    void begin_drawing(const Targets& targets);
    void end_drawing();

    void draw(const RasterPipeline& pipeline, const std::vector<Binding>& buffers,
              std::span<const std::byte> push_constants, const VertexRange& range);

    template <typename T>
    void draw(const RasterPipeline& pipeline, const std::vector<Binding>& buffers, const T& push_constants,
              const VertexRange& range) {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
        draw(pipeline, buffers, std::as_bytes(std::span<const T>(&push_constants, 1)), range);
    }

    /// A vertex per index, with attributes.
    void draw(const RasterPipeline& pipeline, const Mesh& mesh, std::span<const std::byte> push_constants);

    /// Every command recorded so far ends, and its writes are visible, before any later command starts. Needed between
    /// two commands of which one writes what the other touches. Host writes before, and host reads after, need none.
    void barrier();

    void copy(const Buffer& source, const Buffer& target, std::uint64_t bytes, std::uint64_t source_offset = 0,
              std::uint64_t target_offset = 0);
    /// All pixels of an image that was drawn into, row by row without gaps. Needs no barrier after the drawing.
    void copy(const Image& source, const Buffer& target);
    void fill(const Buffer& target, std::uint32_t word);

    /// Records a time stamp after everything recorded so far; the number that milliseconds() knows it by. At most 64.
    std::uint32_t timestamp();

    /// Runs everything and waits. what: the work's name in messages. Throws DeviceError: device lost, out of memory, or
    /// the time limit passed; after that no more work is accepted and nothing of the device is destroyed any more, for
    /// the device may still be working on it.
    void submit_and_wait(const char* what = "work", double limit_seconds = 120.0);

    /// Time between two stamps, after submit_and_wait.
    double milliseconds(std::uint32_t from, std::uint32_t to) const;

    VkCommandBuffer handle() const; ///< for commands that this class does not know

  private:
    struct State;
    std::shared_ptr<State> state_;
};

/// Workgroups of `size` that cover `count`.
constexpr std::uint32_t group_count(std::uint32_t count, std::uint32_t size) {
    return count / size + (count % size != 0);
}

} // namespace manylights::lab::gpu
