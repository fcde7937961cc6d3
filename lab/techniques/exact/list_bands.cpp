#include "lab/techniques/exact/list_bands.h"

#include <string>

namespace manylights::lab {

namespace {

/// Of a pixel: its list within the lights of its band.
struct ListRange {
    std::uint32_t first, end;
};

// As many rows as the bytes allow, one at the least.
std::uint32_t end_of_band(const PointLists& lists, std::uint32_t height, std::uint32_t width, std::uint32_t first_row,
                          std::uint64_t list_bytes) {
    const std::uint64_t first = lists.first[std::size_t{first_row} * width];
    std::uint32_t row = first_row + 1;
    while (row < height && (lists.first[(std::size_t{row} + 1) * width] - first) * sizeof(std::uint32_t) <= list_bytes)
        ++row;
    return row;
}

} // namespace

ListBands::ListBands(gpu::Device& device, const PointLists& lists, std::uint32_t width, std::uint32_t height,
                     std::uint64_t list_bytes) {
    std::vector<ListRange> ranges;
    ranges.reserve(std::size_t{width} * height);
    for (std::uint32_t row = 0; row < height;) {
        const std::uint32_t end = end_of_band(lists, height, width, row, list_bytes);
        const std::uint64_t first = lists.first[std::size_t{row} * width];
        const std::uint64_t count = lists.first[std::size_t{end} * width] - first;
        for (std::size_t pixel = std::size_t{row} * width; pixel < std::size_t{end} * width; ++pixel)
            ranges.push_back({static_cast<std::uint32_t>(lists.first[pixel] - first),
                              static_cast<std::uint32_t>(lists.first[pixel + 1] - first)});
        const std::string name = "lists of rows " + std::to_string(row) + " to " + std::to_string(end - 1);
        lights_.emplace_back(device, name, std::span(lists.lights).subspan(first, count));
        bands_.push_back({row, end - row, {}});
        row = end;
    }
    ranges_.emplace_back(device, "list ranges", std::span<const ListRange>(ranges));
    for (std::size_t i = 0; i < bands_.size(); ++i) bands_[i].structure = {&ranges_.front(), &lights_[i]};
}

std::uint64_t ListBands::bytes() const {
    std::uint64_t bytes = ranges_.front().bytes();
    for (const gpu::Buffer& buffer : lights_) bytes += buffer.bytes();
    return bytes;
}

bool ListBands::overwrite_first(std::uint32_t light) {
    for (gpu::Buffer& buffer : lights_) {
        if (buffer.bytes() == 0) continue;
        buffer.upload(std::span<const std::uint32_t>(&light, 1));
        return true;
    }
    return false;
}

} // namespace manylights::lab
