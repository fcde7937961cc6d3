#include "lab/app/statistics.h"

#include "lab/scene/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace manylights::lab::app {
namespace {

using nlohmann::ordered_json;

ordered_json times(const std::vector<double>& ms) {
    if (ms.empty()) return {{"min", nullptr}, {"median", nullptr}, {"max", nullptr}};
    return {{"min", *std::min_element(ms.begin(), ms.end())},
            {"median", median(ms)},
            {"max", *std::max_element(ms.begin(), ms.end())}};
}

ordered_json options_object(const OptionValues& options) {
    ordered_json object = ordered_json::object();
    for (const auto& [key, value] : options) object[key] = value;
    return object;
}

ordered_json wave_cost(const WaveWork& work) { return mean_wave_cost(work, kDefaultWeights); }

std::string temporary_name(const std::string& path) { return path + ".partial"; }

} // namespace

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

ordered_json statistics_row(const Selectors& selectors, const std::string& camera, const gpu::DeviceInfo& device,
                            const Measurement& m) {
    ordered_json row;
    row["technique"] = m.technique;
    row["options"] = options_object(m.options);
    row["scene"] = selectors.scene;
    row["distribution"] = selectors.lights.distribution;
    row["lights"] = selectors.lights.count;
    row["seed"] = selectors.lights.seed;
    row["camera"] = camera;
    row["width"] = selectors.width;
    row["height"] = selectors.height;
    row["device"] = device.name;
    row["driver"] = device.version;
    row["visible_lights"] = m.stats.visible_lights;
    row["tested_mean"] = m.work.tested_mean;
    row["tested_p95"] = m.work.tested_p95;
    row["tested_max"] = m.work.tested_max;
    row["affecting_mean"] = m.work.affecting_mean;
    row["nodes_mean"] = m.work.nodes_mean;
    row["references_mean"] = m.work.references_mean;
    row["wave_cost_64"] = m.waves ? wave_cost(m.waves->lanes_64) : ordered_json(nullptr);
    row["wave_cost_32"] = m.waves ? wave_cost(m.waves->lanes_32) : ordered_json(nullptr);
    row["references"] = m.stats.references;
    row["structure_bytes"] = m.stats.structure_bytes;
    row["build_ms"] = times(m.stats.build_ms);
    row["shade_ms"] = times(m.stats.shade_ms);
    row["light_set_hash"] = fmt::format("{:016x}", m.light_set_hash);
    row["missing_points"] = m.missing_points ? ordered_json(*m.missing_points) : ordered_json(nullptr);
    return row;
}

void check_statistics_path(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(fmt::format("--stats '{}': is a folder, must be a file", path));
    const std::string probe = temporary_name(path);
    std::ofstream file(probe, std::ios::binary);
    const int error = errno;
    const bool opened = file.is_open();
    file.close();
    std::filesystem::remove(probe, ignored);
    if (!opened) throw InputError(fmt::format("--stats '{}': cannot be written: {}", path, std::strerror(error)));
}

void write_statistics(const std::string& path, const std::vector<ordered_json>& rows) {
    const std::string text = (rows.size() == 1 ? rows[0] : ordered_json(rows)).dump(2) + "\n";
    const std::string temporary = temporary_name(path);
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    std::error_code error;
    if (file) std::filesystem::rename(temporary, path, error);
    if (file && !error) return;
    const std::string why = error ? error.message() : std::strerror(errno);
    std::filesystem::remove(temporary, error);
    throw InputError(fmt::format("--stats '{}': cannot be written: {}", path, why));
}

} // namespace manylights::lab::app
