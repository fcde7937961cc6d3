#include "lab/app/image_check.h"

#include "lab/renderer/tone_map.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace manylights::lab::app {

std::vector<float> radiance_of(const std::vector<PixelRecord>& records) {
    constexpr double kUnit = 1.0 / 1048576.0; // records count in 2^-20
    std::vector<float> radiance;
    radiance.reserve(3 * records.size());
    for (const PixelRecord& record : records)
        for (const std::int64_t channel : record.radiance)
            radiance.push_back(static_cast<float>(static_cast<double>(channel) * kUnit));
    return radiance;
}

std::string image_difference(std::span<const float> truth, std::span<const float> got,
                             std::span<const std::uint8_t> mask, std::uint32_t width, std::uint32_t height) {
    for (std::size_t i = 0; i < got.size(); ++i)
        if (!std::isfinite(got[i])) return fmt::format("pixel ({}, {}) is not finite", i / 3 % width, i / 3 / width);
    const float exposure = auto_exposure(truth, mask);
    const Picture wanted = tone_map(truth, mask, width, height, exposure);
    const Picture picture = tone_map(got, mask, width, height, exposure);
    for (std::size_t i = 0; i < wanted.rgb.size(); ++i)
        if (std::abs(int{wanted.rgb[i]} - int{picture.rgb.at(i)}) > 1)
            return fmt::format("pixel ({}, {}) has {} where the truth has {}", i / 3 % width, i / 3 / width,
                               picture.rgb[i], wanted.rgb[i]);
    return "";
}

} // namespace manylights::lab::app
