#include "lab/suites/conditions.h"

#include <manylights/manylights.h>

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace manylights::lab::suites {
namespace {

// Linux tells; elsewhere the name stays empty.
std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "";
}

std::string compiler_name() {
#if defined(__clang__)
    return fmt::format("clang {}.{}", __clang_major__, __clang_minor__);
#elif defined(__GNUC__)
    return fmt::format("g++ {}.{}", __GNUC__, __GNUC_MINOR__);
#else
    return "";
#endif
}

} // namespace

Row conditions_of(const std::string& suite, const gpu::DeviceInfo* device) {
    Row conditions = {{"suite", suite},
                      {"version", fmt::format("{}.{}", MANYLIGHTS_VERSION_MAJOR, MANYLIGHTS_VERSION_MINOR)}};
    if (device != nullptr) {
        conditions["device"] = device->name;
        conditions["driver"] = device->version;
        conditions["software_device"] = device->is_software;
    }
    conditions["processor"] = processor_name();
    conditions["cores"] = std::thread::hardware_concurrency();
    conditions["compiler"] = compiler_name();
    return conditions;
}

std::string conditions_text(const Row& conditions) {
    std::string text;
    for (const auto& [key, value] : conditions.items())
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", key,
                            value.is_string() ? value.get<std::string>() : value.dump());
    return text;
}

} // namespace manylights::lab::suites
