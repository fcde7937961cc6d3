#include "lab/techniques/z_bins/masks_size.h"

#include "lab/gpu/commands.h"
#include "lab/scene/error.h"

#include <fmt/format.h>

namespace manylights::lab {

MasksSize masks_size(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size, std::uint32_t light_count) {
    MasksSize size{gpu::group_count(width, tile_size), gpu::group_count(height, tile_size),
                   gpu::group_count(light_count, 32), gpu::group_count(light_count, 32 * 32)};
    if (size.tiles() * size.words > kMostMaskWords)
        throw InputError(fmt::format("z_bins: option tile_size={}: masks of {} tiles and {} lights in view have {} "
                                     "words; the most is {}",
                                     tile_size, size.tiles(), light_count, size.tiles() * size.words, kMostMaskWords));
    return size;
}

} // namespace manylights::lab
