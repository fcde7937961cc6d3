#pragma once
// The lists of a view's points on the device: every pixel's range in one buffer, and the lights in bands of rows, each
// of them in a buffer of a bounded size.

#include "lab/techniques/pass_dispatch.h"
#include "lab/techniques/point_lists.h"

namespace manylights::lab {

/// Bytes of one band's lights. A single row that needs more is a band of its own.
constexpr std::uint64_t kListBytes = std::uint64_t{64} << 20;

class ListBands {
  public:
    /// lists: of an image of this size. Throws DeviceError where a row alone has more lights than a buffer can hold.
    ListBands(gpu::Device& device, const PointLists& lists, std::uint32_t width, std::uint32_t height,
              std::uint64_t list_bytes = kListBytes);
    ListBands(const ListBands&) = delete; // the bands point into it
    ListBands& operator=(const ListBands&) = delete;

    /// Their buffers: the ranges, and the band's own lights.
    std::span<const PassBand> bands() const { return bands_; }
    std::uint64_t bytes() const;

    /// Puts another light in the place of the first of all lists. False where all are empty.
    bool overwrite_first(std::uint32_t light);

  private:
    std::vector<gpu::Buffer> lights_; ///< per band
    std::vector<gpu::Buffer> ranges_; ///< one
    std::vector<PassBand> bands_;
};

} // namespace manylights::lab
