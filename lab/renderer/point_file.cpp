#include "lab/renderer/point_file.h"

#include "lab/renderer/unfinished_file.h"
#include "lab/scene/error.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>

namespace manylights::lab {

namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<std::uint8_t>;

constexpr std::string_view kMagic = "MLPOINTS";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 8 + 6 * 4 + 11 * 4, kPointBytes = 36, kHashBytes = 8;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
    throw InputError("points \"" + path + "\": " + what);
}

std::uint64_t hash_of(std::span<const std::uint8_t> bytes) {
    std::uint64_t hash = 14695981039346656037u;
    for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 1099511628211u;
    return hash;
}

class Writer {
  public:
    void text(std::string_view letters) { bytes_.insert(bytes_.end(), letters.begin(), letters.end()); }
    void word(std::uint32_t value) { little_endian(value, 4); }
    void number(float value) { word(std::bit_cast<std::uint32_t>(value)); }
    void vector(const glm::vec3& value) {
        for (int i = 0; i < 3; ++i) number(value[i]);
    }
    /// The bytes, sealed with their hash.
    Bytes finish() {
        little_endian(hash_of(bytes_), int{kHashBytes});
        return std::move(bytes_);
    }

  private:
    void little_endian(std::uint64_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }

    Bytes bytes_;
};

/// Whoever reads has made sure that the bytes are there.
class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::string text(std::size_t length) {
        const auto letters = bytes_.first(length);
        bytes_ = bytes_.subspan(length);
        return {letters.begin(), letters.end()};
    }
    std::uint32_t word() { return static_cast<std::uint32_t>(little_endian(4)); }
    std::uint64_t long_word() { return little_endian(8); }
    float number() { return std::bit_cast<float>(word()); }
    glm::vec3 vector() {
        const float x = number(), y = number(), z = number();
        return {x, y, z};
    }

  private:
    std::uint64_t little_endian(std::size_t length) {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < length; ++i) value |= std::uint64_t{bytes_[i]} << (8 * i);
        bytes_ = bytes_.subspan(length);
        return value;
    }

    std::span<const std::uint8_t> bytes_;
};

/// The file's first bytes, up to the names.
struct Header {
    std::string magic;
    std::uint32_t version, width, height, points, scene_bytes, camera_bytes;
    Camera camera;

    /// No overflow: four factors and terms of 32 bits.
    std::uint64_t file_bytes() const {
        return std::uint64_t{kHeaderBytes} + scene_bytes + camera_bytes + std::uint64_t{points} * kPointBytes +
               kHashBytes;
    }
};

Header read_header(Reader& reader) {
    Header header;
    header.magic = reader.text(kMagic.size());
    for (std::uint32_t* field :
         {&header.version, &header.width, &header.height, &header.points, &header.scene_bytes, &header.camera_bytes})
        *field = reader.word();
    for (glm::vec3* field : {&header.camera.position, &header.camera.forward, &header.camera.up})
        *field = reader.vector();
    header.camera.vertical_fov = reader.number();
    header.camera.near_plane = reader.number();
    return header;
}

// Before anything is allocated for what the header says.
void check_header(const std::string& path, const Header& header, std::uint64_t file_bytes) {
    if (header.magic != kMagic) refuse(path, "magic: must be " + std::string(kMagic) + ": this is no file of points");
    if (header.version != kVersion)
        refuse(path, "version " + std::to_string(header.version) + ": must be " + std::to_string(kVersion));
    if (header.file_bytes() != file_bytes)
        refuse(path, "length: must be " + std::to_string(header.file_bytes()) + " bytes by its header, is " +
                         std::to_string(file_bytes));
}

std::uint64_t size_of_file(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) refuse(path, "does not exist");
    if (fs::is_directory(status)) refuse(path, "is a folder, must be a file");
    if (!fs::is_regular_file(status)) refuse(path, "cannot be read: must be a regular file");
    const std::uint64_t bytes = fs::file_size(path, error);
    if (error) refuse(path, "cannot be read: " + error.message());
    if (bytes < kHeaderBytes + kHashBytes)
        refuse(path, "length: must be at least " + std::to_string(kHeaderBytes + kHashBytes) + " bytes, is " +
                         std::to_string(bytes));
    return bytes;
}

void read_bytes(const std::string& path, std::ifstream& file, std::span<std::uint8_t> target) {
    file.read(reinterpret_cast<char*>(target.data()), static_cast<std::streamsize>(target.size()));
    if (!file) refuse(path, std::string("cannot be read: ") + std::strerror(errno));
}

Bytes read_file(const std::string& path) {
    const std::uint64_t size = size_of_file(path);
    std::ifstream file(path, std::ios::binary);
    if (!file) refuse(path, std::string("cannot be read: ") + std::strerror(errno));
    Bytes bytes(kHeaderBytes);
    read_bytes(path, file, bytes);
    Reader reader(bytes);
    check_header(path, read_header(reader), size);
    bytes.resize(static_cast<std::size_t>(size));
    read_bytes(path, file, std::span(bytes).subspan(kHeaderBytes));
    return bytes;
}

SavedPoints decode(const Bytes& bytes) {
    Reader reader(bytes);
    const Header header = read_header(reader);
    SavedPoints saved{reader.text(header.scene_bytes), header.camera, header.width, header.height, {}};
    saved.camera.name = reader.text(header.camera_bytes);
    saved.points.reserve(header.points);
    for (std::uint32_t i = 0; i < header.points; ++i) {
        SavedPoint& point = saved.points.emplace_back();
        point.pixel = reader.word();
        point.position = reader.vector();
        point.depth = reader.number();
        point.normal = reader.vector();
        point.material = reader.word();
    }
    return saved;
}

Bytes encode(const SavedPoints& saved) {
    Writer writer;
    writer.text(kMagic);
    for (const std::size_t field : {std::size_t{kVersion}, std::size_t{saved.width}, std::size_t{saved.height},
                                    saved.points.size(), saved.scene.size(), saved.camera.name.size()})
        writer.word(static_cast<std::uint32_t>(field));
    for (const glm::vec3& field : {saved.camera.position, saved.camera.forward, saved.camera.up}) writer.vector(field);
    writer.number(saved.camera.vertical_fov);
    writer.number(saved.camera.near_plane);
    writer.text(saved.scene);
    writer.text(saved.camera.name);
    for (const SavedPoint& point : saved.points) {
        writer.word(point.pixel);
        writer.vector(point.position);
        writer.number(point.depth);
        writer.vector(point.normal);
        writer.word(point.material);
    }
    return writer.finish();
}

} // namespace

void write_points(const std::string& path, const SavedPoints& saved, std::size_t material_count) {
    for (const std::string& broken : {broken_rule(saved), broken_material(saved, material_count)})
        if (!broken.empty()) cannot_write(path, broken);
    UnfinishedFile file(path);
    file.write(encode(saved));
    file.keep();
}

SavedPoints read_points(const std::string& path, const std::string& scene, std::size_t material_count) {
    const Bytes bytes = read_file(path);
    const auto sealed = std::span(bytes).first(bytes.size() - kHashBytes);
    if (Reader(std::span(bytes).last(kHashBytes)).long_word() != hash_of(sealed))
        refuse(path, "hash: must be that of the bytes before it: the file is damaged");
    SavedPoints saved = decode(bytes);
    if (const std::string broken = broken_rule(saved); !broken.empty()) refuse(path, broken);
    if (saved.scene != scene) refuse(path, "scene '" + saved.scene + "': must be '" + scene + "', the one selected");
    if (const std::string broken = broken_material(saved, material_count); !broken.empty()) refuse(path, broken);
    return saved;
}

} // namespace manylights::lab
