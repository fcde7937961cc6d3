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

#include <cstddef>

namespace manylights::lab {

namespace {

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

void write_png(const std::string& path, const Picture& picture) {
    UnfinishedFile file(path);
    const std::vector<std::uint8_t> bytes = encode_png(picture);
    if (bytes.empty()) cannot_write(path, "the picture cannot be encoded");
    file.write(bytes);
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
