#include "lab/renderer/image_file.h"

#include "lab/scene/error.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace manylights::lab {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const std::string& path, const std::string& why) {
    throw InputError("cannot write " + path + ": " + why);
}

/// A file under a name of its own beside the wanted one; gone again unless kept.
class UnfinishedFile {
  public:
    explicit UnfinishedFile(std::string path)
        : path_(std::move(path)), name_(path_ + ".unfinished-" + std::to_string(getpid())) {
        check_writable(path_);
    }
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;
    ~UnfinishedFile() {
        std::error_code ignored;
        if (!kept_) fs::remove(name_, ignored);
    }

    const std::string& name() const { return name_; }

    void keep() {
        std::error_code error;
        fs::rename(name_, path_, error);
        if (error) cannot_write(path_, error.message());
        kept_ = true;
    }

  private:
    std::string path_, name_;
    bool kept_ = false;
};

std::vector<std::uint8_t> encode_png(const Picture& picture) {
    std::vector<std::uint8_t> bytes;
    const auto append = [](void* context, void* data, int size) {
        auto& target = *static_cast<std::vector<std::uint8_t>*>(context);
        const auto* source = static_cast<const std::uint8_t*>(data);
        target.insert(target.end(), source, source + size);
    };
    stbi_write_png_to_func(append, &bytes, int(picture.width), int(picture.height), 3, picture.rgb.data(),
                           int(picture.width) * 3);
    return bytes;
}

void write_bytes(const std::string& path, const std::string& name, const std::vector<std::uint8_t>& bytes) {
    std::FILE* file = std::fopen(name.c_str(), "wb");
    if (file == nullptr) cannot_write(path, std::strerror(errno));
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int write_error = errno;
    const bool closed = std::fclose(file) == 0; // a full disk may be noticed only here
    if (!written || !closed) cannot_write(path, std::strerror(written ? errno : write_error));
}

constexpr const char* kChannels[3] = {"R", "G", "B"};

// OpenEXR addresses pixel (x, y) at base + x * x_stride + y * y_stride.
Imf::FrameBuffer frame_of(float* rgb, std::size_t width) {
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 3; ++c)
        frame.insert(kChannels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(rgb + c), 3 * sizeof(float),
                                              3 * sizeof(float) * width));
    return frame;
}

} // namespace

void check_writable(const std::string& path) {
    std::error_code error;
    const fs::path file(path);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const fs::file_status status = fs::status(folder, error);
    if (!fs::exists(status)) cannot_write(path, "the folder " + folder.string() + " does not exist");
    if (!fs::is_directory(status)) cannot_write(path, folder.string() + " is not a folder");
    if (fs::is_directory(file, error)) cannot_write(path, "it is a folder");
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        cannot_write(path, "the folder " + folder.string() + " is not writable: " + std::strerror(errno));
}

void write_png(const std::string& path, const Picture& picture) {
    UnfinishedFile file(path);
    const std::vector<std::uint8_t> bytes = encode_png(picture);
    if (bytes.empty()) cannot_write(path, "the picture cannot be encoded");
    write_bytes(path, file.name(), bytes);
    file.keep();
}

void write_exr(const std::string& path, std::span<const float> rgb, std::uint32_t width, std::uint32_t height) {
    UnfinishedFile file(path);
    try {
        Imf::Header header(static_cast<int>(width), static_cast<int>(height));
        for (const char* channel : kChannels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        Imf::OutputFile output(file.name().c_str(), header);
        output.setFrameBuffer(frame_of(const_cast<float*>(rgb.data()), width)); // only read
        output.writePixels(static_cast<int>(height));
    } catch (const std::exception& error) {
        cannot_write(path, error.what());
    }
    file.keep();
}

FloatImage read_exr(const std::string& path) {
    try {
        Imf::InputFile input(path.c_str());
        const auto& window = input.header().dataWindow();
        FloatImage image;
        image.width = std::uint32_t(window.max.x - window.min.x + 1);
        image.height = std::uint32_t(window.max.y - window.min.y + 1);
        image.rgb.resize(std::size_t(image.width) * image.height * 3);
        const std::ptrdiff_t origin = std::ptrdiff_t(window.min.y) * image.width + window.min.x;
        input.setFrameBuffer(frame_of(image.rgb.data() - 3 * origin, image.width));
        input.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const std::exception& error) {
        throw InputError("cannot read " + path + ": " + error.what());
    }
}

} // namespace manylights::lab
