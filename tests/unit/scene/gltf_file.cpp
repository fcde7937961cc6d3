#include "tests/unit/scene/gltf_file.h"

#include "lab/scene/error.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

namespace manylights::lab {
namespace {

void append_word(std::string& bytes, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(char(word >> shift & 0xffu));
}

} // namespace

int GltfFile::add_accessor(int view, int component_type, std::size_t count, const char* type) {
    json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
    return int(json["accessors"].size()) - 1;
}

int GltfFile::add_positions(const std::vector<float>& xyz) {
    return add_accessor(add_view(xyz), 5126, xyz.size() / 3, "VEC3");
}

std::string GltfFile::glb() const {
    nlohmann::json document = json;
    const std::size_t padded = (binary.size() + 3) / 4 * 4;
    if (!document.contains("buffers") && !binary.empty()) document["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    append_word(bytes, 2);
    append_word(bytes, 20 + text.size() + (binary.empty() ? 0 : 8 + padded));
    append_word(bytes, text.size());
    bytes += "JSON" + text;
    if (!binary.empty()) {
        append_word(bytes, padded);
        bytes += std::string("BIN\0", 4) + std::string(binary.begin(), binary.end());
        bytes.append(padded - binary.size(), '\0');
    }
    return bytes;
}

GltfFile triangle_file() {
    GltfFile file;
    file.json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    file.json["nodes"] = {{{"mesh", 0}}};
    const int positions = file.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int indices = file.add_accessor(file.add_view<std::uint16_t>({0, 1, 2}), 5123, 3, "SCALAR");
    file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}}};
    return file;
}

std::string temporary_path(const std::string& name) {
    // Tests of several builds may run at once.
    return testing::TempDir() + "manylights_" + std::to_string(getpid()) + "_" + name;
}

std::string write_bytes(const std::string& name, const std::string& bytes) {
    const std::string path = temporary_path(name);
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    return path;
}

Scene load(const GltfFile& file) { return load_scene(write_bytes("file.glb", file.glb())); }

std::string complaint(const std::string& path) {
    try {
        load_scene(path);
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_NE(message.find(path), std::string::npos) << "the file is not named: " << message;
        return message;
    }
    return "";
}

std::string complaint(const GltfFile& file) { return complaint(write_bytes("file.glb", file.glb())); }

} // namespace manylights::lab
