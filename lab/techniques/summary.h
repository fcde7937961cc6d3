#pragma once
// The work of an image in a few numbers, over the shaded pixels; names as in the statistics files.

#include "lab/techniques/technique.h"

namespace manylights::lab {

struct WorkSummary {
    std::uint64_t shaded = 0; ///< pixels; the figures are 0 where this is
    double tested_mean = 0;
    std::uint32_t tested_p95 = 0; ///< nearest rank: the smallest count that at least 95 % of the pixels stay within
    std::uint32_t tested_max = 0;
    double affecting_mean = 0;
    double nodes_mean = 0;
    double references_mean = 0;
};

WorkSummary summarize(const std::vector<PixelRecord>& records);

} // namespace manylights::lab
