#include "lab/techniques/technique.h"

namespace manylights::lab {

std::optional<double> Technique::references_in_range(const Frame&) { return std::nullopt; }

void Technique::forget_times() {
    stats_.build_ms.clear();
    stats_.shade_ms.clear();
    stats_.stages.clear();
}

} // namespace manylights::lab
