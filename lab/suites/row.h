#pragma once
// A row: what one technique did in one view, in the schema that all statistics files and suites of the project share.
// docs/measuring.md says what each figure means.

#include "lab/gpu/device.h"
#include "lab/scene/lights.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/wave_cost.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <span>

namespace manylights::lab::suites {

using Row = nlohmann::ordered_json;

/// What was looked at: the columns of a row that do not depend on the technique.
struct RowView {
    std::string scene;
    LightOptions lights;
    std::string camera;
    std::uint32_t width = 0, height = 0;
};

/// What one technique did in one frame.
struct Measurement {
    std::string technique;
    OptionValues options; ///< as given
    WorkSummary work;
    std::optional<WaveSummary> waves;
    std::optional<double> references_in_range;
    TechniqueStats stats;
    std::vector<double> cold_build_ms;
    std::vector<double> shade_over_exact; ///< of each round: this technique's time over that of `exact`
    std::uint64_t light_set_hash = 0;
    std::optional<std::uint64_t>
        missing_points; ///< whose light set is not the truth's; empty where nothing was compared
    bool wrong = false; ///< there must be no figure
};

/// Keys in the schema's order; null where nothing was measured. A technique whose light sets are wrong has no figures:
/// all of them are null.
Row make_row(const RowView& view, const gpu::DeviceInfo& device, const Measurement& measurement);

/// 0 for no values.
double median(std::vector<double> values);

} // namespace manylights::lab::suites
