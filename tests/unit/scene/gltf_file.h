#pragma once
// Small glTF files for tests, as JSON and bytes that a test may bend before they are written.

#include "lab/scene/scene.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace manylights::lab {

struct GltfFile {
    nlohmann::json json;
    std::vector<std::uint8_t> binary;

    /// Appends values to the binary chunk with a buffer view of their own, and returns that view's index.
    template <typename T>
    int add_view(const std::vector<T>& values) {
        binary.resize((binary.size() + 3) / 4 * 4);
        const std::size_t offset = binary.size(), bytes = values.size() * sizeof(T);
        binary.resize(offset + bytes);
        if (bytes != 0) std::memcpy(binary.data() + offset, values.data(), bytes);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
        return int(json["bufferViews"].size()) - 1;
    }

    int add_accessor(int view, int component_type, std::size_t count, const char* type);

    int add_positions(const std::vector<float>& xyz);

    /// The bytes of a .glb file.
    std::string glb() const;
};

/// One triangle (0,0,0) (1,0,0) (0,1,0) with 16-bit indices, in one mesh of one node.
GltfFile triangle_file();

std::string temporary_path(const std::string& name);
std::string write_bytes(const std::string& name, const std::string& bytes);

/// Writes the file as .glb and loads it.
Scene load(const GltfFile& file);

/// What load_scene says about a bad file; the empty string when it accepts it.
std::string complaint(const std::string& path);
std::string complaint(const GltfFile& file);

} // namespace manylights::lab
