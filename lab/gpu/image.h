#pragma once
// A two-dimensional image in device memory: something to draw into.

#include <cstdint>
#include <memory>
#include <string>

#include <vulkan/vulkan_core.h>

namespace manylights::lab::gpu {

struct Context;

struct ImageShape {
    std::uint32_t width, height;
    VkFormat format;
    VkImageUsageFlags usage;
};

/// One level, one layer, one sample. Contents and layout are undefined at first.
class Image {
  public:
    Image(std::shared_ptr<Context> context, const std::string& name, const ImageShape& shape);
    Image(Image&&) noexcept;
    Image& operator=(Image&&) noexcept;
    ~Image();

    VkImage handle() const;
    VkImageView view() const;
    VkImageAspectFlags aspect() const; ///< depth or colour, by the format
    std::uint32_t width() const;
    std::uint32_t height() const;

  private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace manylights::lab::gpu
