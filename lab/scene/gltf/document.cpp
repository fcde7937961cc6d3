#include "lab/scene/gltf/document.h"

#include "lab/scene/gltf/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace manylights::lab::gltf {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr std::uintmax_t kMostBytes = 0xfffffff0u; // sizes in a .glb are 32 bits
constexpr int kDeepestNesting = 128;               // parsers recurse into objects; real files stay below 20

std::string read_file(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail(path, "does not exist");
    if (!std::filesystem::is_regular_file(status)) fail(path, "is not a file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) fail(path, "cannot be read");
    if (size == 0) fail(path, "is empty");
    if (size > kMostBytes) fail(path, "is larger than 4 GiB, the most that a glTF file can be");
    std::string bytes(std::size_t(size), '\0');
    std::ifstream file(path, std::ios::binary);
    if (!file.read(bytes.data(), std::streamsize(size))) fail(path, "cannot be read");
    return bytes;
}

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
    const auto byte = [&](std::size_t i) { return std::uint32_t(std::uint8_t(bytes[offset + i])); };
    return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

void append_word(std::string& bytes, std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(char(word >> shift & 0xffu));
}

struct Chunks {
    std::string_view json, binary;
    bool is_binary_file = false;
};

/// The chunk that starts at offset, which is moved behind it.
std::string_view take_chunk(const std::string& path, std::string_view bytes, std::size_t& offset, std::uint32_t type) {
    if (bytes.size() - offset < 8) fail(path, "is truncated: a chunk header needs 8 bytes");
    const std::size_t length = word_at(bytes, offset);
    if (length > bytes.size() - offset - 8) fail(path, "is truncated: a chunk reaches beyond the end of the file");
    if (word_at(bytes, offset + 4) != type) fail(path, "is not a valid .glb file: a chunk has the wrong type");
    const std::string_view chunk = bytes.substr(offset + 8, length);
    offset += 8 + length;
    return chunk;
}

Chunks split_chunks(const std::string& path, std::string_view bytes) {
    if (bytes.size() < 4 || word_at(bytes, 0) != kGlbMagic) return {bytes, {}, false};
    if (bytes.size() < 20) fail(path, "is truncated: a .glb file has at least 20 bytes");
    if (word_at(bytes, 4) != 2) fail(path, "is glTF version " + std::to_string(word_at(bytes, 4)) + "; only 2 is read");
    if (word_at(bytes, 8) > bytes.size())
        fail(path, "is truncated: its header says " + std::to_string(word_at(bytes, 8)) + " bytes");
    bytes = bytes.substr(0, word_at(bytes, 8));
    if (bytes.size() < 20)
        fail(path, "is not a valid .glb file: its header says " + std::to_string(bytes.size()) + " bytes");
    std::size_t offset = 12;
    Chunks chunks{take_chunk(path, bytes, offset, kJsonChunk), {}, true};
    if (offset + 8 <= bytes.size()) chunks.binary = take_chunk(path, bytes, offset, kBinaryChunk);
    return chunks;
}

/// Brackets outside strings; wrong text is left to the parser.
void check_nesting(const std::string& path, std::string_view json) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kDeepestNesting) fail(path, "is nested more than 128 levels deep");
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

bool is_harmless(const std::string& extension) {
    // Materials and textures may be required; the lab shows base colours all the same. Quantized attributes are read.
    for (const char* prefix :
         {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_punctual", "KHR_mesh_quantization"}) {
        if (extension.rfind(prefix, 0) == 0) return true;
    }
    return false;
}

nlohmann::json parse_json(const std::string& path, std::string_view text) {
    check_nesting(path, text);
    nlohmann::json json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
    if (json.is_discarded() || !json.is_object()) fail(path, "is not a glTF file: neither .glb nor a JSON object");
    if (!json.contains("asset") || !json["asset"].is_object()) fail(path, "is not a glTF file: it has no \"asset\"");
    const nlohmann::json version = json["asset"].value("version", nlohmann::json());
    if (!version.is_string() || version.get<std::string>().rfind("2.", 0) != 0) fail(path, "asset.version must be 2.x");
    if (json.contains("extensionsRequired") && json["extensionsRequired"].is_array()) {
        for (const nlohmann::json& extension : json["extensionsRequired"]) {
            if (extension.is_string() && !is_harmless(extension.get<std::string>()))
                fail(path, "requires the extension " + extension.get<std::string>() + ", which is not supported");
        }
    }
    // Not read, and the parser checks their offsets too late.
    for (const char* key : {"images", "textures", "samplers", "animations", "skins"}) json.erase(key);
    return json;
}

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// The .glb file again, from checked parts. Padding as the format wants it; the binary chunk is followed by zeros
/// because the parser trusts a chunk's length up to 8 bytes beyond the file.
std::string pack(std::string json, std::string_view binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::size_t padded = (binary.size() + 3) / 4 * 4;
    std::string bytes;
    bytes.reserve(json.size() + padded + 40);
    append_word(bytes, kGlbMagic);
    append_word(bytes, 2);
    append_word(bytes, std::uint32_t(20 + json.size() + (binary.empty() ? 0 : 8 + padded)));
    append_word(bytes, std::uint32_t(json.size()));
    append_word(bytes, kJsonChunk);
    bytes += json;
    if (!binary.empty()) {
        append_word(bytes, std::uint32_t(padded));
        append_word(bytes, kBinaryChunk);
        bytes += binary;
        bytes.append(padded - binary.size(), '\0');
    }
    return bytes;
}

} // namespace

tinygltf::Model load_document(const std::string& path) {
    const std::string bytes = read_file(path);
    const Chunks chunks = split_chunks(path, bytes);
    const std::string json =
        parse_json(path, chunks.json).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    const std::string folder = std::filesystem::path(path).parent_path().string();

    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error, warning;
    bool loaded = false;
    try {
        if (chunks.is_binary_file) {
            const std::string file = pack(json, chunks.binary);
            loaded = loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                 reinterpret_cast<const unsigned char*>(file.data()),
                                                 unsigned(file.size()), folder);
        } else {
            loaded = loader.LoadASCIIFromString(&model, &error, &warning, json.data(), unsigned(json.size()), folder);
        }
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!loaded) fail(path, "is not a valid glTF file: " + one_line(error));
    return model;
}

} // namespace manylights::lab::gltf
