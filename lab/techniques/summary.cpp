#include "lab/techniques/summary.h"

#include <algorithm>

namespace manylights::lab {

WorkSummary summarize(const std::vector<PixelRecord>& records) {
    std::uint64_t tested = 0, affecting = 0, nodes = 0, references = 0;
    std::vector<std::uint32_t> counts;
    counts.reserve(records.size());
    for (const PixelRecord& record : records) {
        if (record.shaded == 0) continue;
        counts.push_back(record.tested);
        tested += record.tested;
        affecting += record.affecting;
        nodes += record.nodes;
        references += record.references;
    }
    WorkSummary summary;
    summary.shaded = counts.size();
    if (counts.empty()) return summary;

    const double pixels = static_cast<double>(counts.size());
    summary.tested_mean = static_cast<double>(tested) / pixels;
    summary.affecting_mean = static_cast<double>(affecting) / pixels;
    summary.nodes_mean = static_cast<double>(nodes) / pixels;
    summary.references_mean = static_cast<double>(references) / pixels;

    const std::size_t rank = (counts.size() * 95 + 99) / 100 - 1; // ceil(0.95 n), counted from 0
    std::ranges::nth_element(counts, counts.begin() + static_cast<std::ptrdiff_t>(rank));
    summary.tested_p95 = counts[rank];
    summary.tested_max = std::ranges::max(counts);
    return summary;
}

} // namespace manylights::lab
