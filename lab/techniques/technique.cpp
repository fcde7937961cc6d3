#include "lab/techniques/technique.h"

namespace manylights::lab {

void Technique::forget_times() {
    stats_.build_ms.clear();
    stats_.shade_ms.clear();
    stats_.stages.clear();
}

} // namespace manylights::lab
