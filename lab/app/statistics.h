#pragma once
// The statistics file: one object per technique, in the schema that all tools of the project share.

#include "lab/app/arguments.h"
#include "lab/gpu/device.h"
#include "lab/techniques/summary.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace manylights::lab::app {

/// What one technique did in one frame.
struct Measurement {
    std::string technique;
    OptionValues options; ///< as given
    WorkSummary work;
    TechniqueStats stats;
    std::uint64_t light_set_hash = 0;
    std::optional<std::uint64_t> missing_points; ///< empty where nothing was compared
    std::optional<WaveSummary> waves;            ///< empty where nobody asked for them
};

/// Keys in the schema's order; null where nothing was measured (the modelled wave costs, times without a repeat).
nlohmann::ordered_json statistics_row(const Selectors& selectors, const std::string& camera,
                                      const gpu::DeviceInfo& device, const Measurement& measurement);

/// One row is written as an object, several as an array of them. Throws InputError naming the path.
void write_statistics(const std::string& path, const std::vector<nlohmann::ordered_json>& rows);

/// Throws the InputError that writing this file would end in, before any long work is done for it.
void check_statistics_path(const std::string& path);

double median(std::vector<double> values);

} // namespace manylights::lab::app
