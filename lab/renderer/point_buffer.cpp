#include "lab/renderer/point_buffer.h"

#include "lab/gpu/device.h"
#include "lab/scene/error.h"

#include <string>

namespace manylights::lab {

namespace {

std::uint64_t checked_bytes(const gpu::Device& device, std::uint32_t width, std::uint32_t height) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width == 0 || height == 0) throw InputError("image size " + size + ": both sides must be at least 1");
    const std::uint64_t bytes = std::uint64_t(width) * height * sizeof(PointPosition);
    const std::uint64_t limit = device.info().max_storage_buffer_range;
    if (bytes > limit)
        throw DeviceError("image size " + size + " needs " + std::to_string(bytes) +
                          " bytes for its points, and the device " + device.info().name + " allows " +
                          std::to_string(limit) + " in a buffer");
    return bytes;
}

} // namespace

PointBuffer::PointBuffer(gpu::Device& device, std::uint32_t width, std::uint32_t height,
                         const std::vector<MaterialRecord>& materials)
    : width_(width), height_(height), positions_(device, "positions", checked_bytes(device, width, height)),
      normals_(device, "normals", positions_.bytes()),
      materials_(device, "materials", std::span<const MaterialRecord>(materials)) {}

} // namespace manylights::lab
