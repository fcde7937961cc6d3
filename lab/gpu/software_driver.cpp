#include "lab/gpu/software_driver.h"

#include <cstdlib>
#include <filesystem>
#include <mutex>

namespace manylights::lab::gpu {

namespace {

namespace fs = std::filesystem;

constexpr const char* kManifest = "lavapipe/icd.json";

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

// From the program upwards, so that a moved or copied build folder finds its own driver.
std::string find_above(fs::path folder) {
    while (true) {
        for (const fs::path& candidate : {folder / kManifest, folder / "build" / kManifest})
            if (is_file(candidate)) return candidate.string();
        if (!folder.has_relative_path()) return {};
        folder = folder.parent_path();
    }
}

void add_driver(const std::string& manifest) {
    const char* present = std::getenv("VK_ADD_DRIVER_FILES");
    const std::string value = present != nullptr && *present != '\0' ? present + (":" + manifest) : manifest;
    setenv("VK_ADD_DRIVER_FILES", value.c_str(), 1);
}

} // namespace

std::string find_software_driver() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        if (std::string found = find_above(program.parent_path()); !found.empty()) return found;
    }
    const fs::path built = fs::path(MANYLIGHTS_SOURCE_DIR) / "build" / kManifest;
    return is_file(built) ? built.string() : std::string();
}

void offer_software_driver() {
    static std::once_flag once;
    std::call_once(once, [] {
        if (std::getenv("VK_DRIVER_FILES") != nullptr || std::getenv("VK_ICD_FILENAMES") != nullptr) return;
        if (const std::string manifest = find_software_driver(); !manifest.empty()) add_driver(manifest);
    });
}

} // namespace manylights::lab::gpu
