#include "lab/suites/row.h"

#include "lab/suites/schema.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab::suites {
namespace {

Row options_object(const OptionValues& options) {
    Row object = Row::object();
    for (const auto& [key, value] : options) object[key] = value;
    return object;
}

Row stages_object(const std::vector<NamedTimes>& stages) {
    Row object = Row::object();
    for (const NamedTimes& stage : stages) object[stage.name] = times_of(stage.ms);
    return object;
}

void add_view(Row& row, const RowView& view, const gpu::DeviceInfo& device) {
    row["scene"] = view.scene;
    row["distribution"] = view.lights.distribution;
    row["lights"] = view.lights.count;
    row["seed"] = view.lights.seed;
    row["camera"] = view.camera;
    row["width"] = view.width;
    row["height"] = view.height;
    row["device"] = device.name;
    row["driver"] = device.version;
}

void add_work(Row& row, const Measurement& m) {
    row["visible_lights"] = m.stats.visible_lights;
    row["points"] = m.work.shaded;
    row["tested_mean"] = m.work.tested_mean;
    row["tested_p95"] = m.work.tested_p95;
    row["tested_max"] = m.work.tested_max;
    row["affecting_mean"] = m.work.affecting_mean;
    row["nodes_mean"] = m.work.nodes_mean;
    row["references_mean"] = m.work.references_mean;
    if (m.references_in_range) row["references_in_range_mean"] = *m.references_in_range;
}

double per_wave(std::uint64_t sum, const WaveWork& work) {
    return work.waves == 0 ? 0.0 : static_cast<double>(sum) / static_cast<double>(work.waves);
}

void add_waves(Row& row, const WaveSummary& waves) {
    const WaveWork& w64 = waves.lanes_64;
    const WaveWork& w32 = waves.lanes_32;
    row["wave_cost_64"] = mean_wave_cost(w64, kDefaultWeights);
    row["wave_cost_32"] = mean_wave_cost(w32, kDefaultWeights);
    row["wave_cost_64_half"] = mean_wave_cost(w64, kLightWeights);
    row["wave_cost_64_double"] = mean_wave_cost(w64, kHeavyWeights);
    row["wave_cost_64_p99"] = waves.cost_64_p99;
    row["wave_tested_64"] = per_wave(w64.tested, w64);
    row["wave_tested_32"] = per_wave(w32.tested, w32);
    row["wave_affecting_64"] = per_wave(w64.affecting, w64);
    row["wave_affecting_32"] = per_wave(w32.affecting, w32);
    row["wave_nodes_64"] = per_wave(w64.nodes, w64);
    row["wave_checks_64"] = per_wave(w64.checks, w64);
}

void add_structure(Row& row, const Measurement& m) {
    row["references"] = m.stats.references;
    row["structure_bytes"] = m.stats.structure_bytes;
    row["build_ms"] = times_of(m.stats.build_ms);
    row["cold_build_ms"] = times_of(m.cold_build_ms);
    row["stages_ms"] = stages_object(m.stats.stages);
    row["shade_ms"] = times_of(m.stats.shade_ms);
    row["shade_over_exact"] = times_of(m.shade_over_exact);
    row["light_set_hash"] = fmt::format("{:016x}", m.light_set_hash);
}

} // namespace

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Row make_row(const RowView& view, const gpu::DeviceInfo& device, const Measurement& m) {
    Row row;
    for (const Column& column : schema()) row[column.key] = column.empty_value();
    row["technique"] = m.technique;
    row["options"] = options_object(m.options);
    add_view(row, view, device);
    row["missing_points"] = m.missing_points ? Row(*m.missing_points) : Row(nullptr);
    if (m.wrong) return row;
    add_work(row, m);
    if (m.waves) add_waves(row, *m.waves);
    add_structure(row, m);
    return row;
}

} // namespace manylights::lab::suites
