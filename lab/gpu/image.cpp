#include "lab/gpu/image.h"

#include "lab/gpu/held.h"

namespace manylights::lab::gpu {

struct Image::State {
    std::shared_ptr<Context> context;
    ImageShape shape{};
    vk::ImageAspectFlags aspect;
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::Image image{nullptr};
    vk::raii::ImageView view{nullptr};
};

namespace {

vk::ImageAspectFlags aspect_of(vk::Format format) {
    const bool depth = format == vk::Format::eD32Sfloat || format == vk::Format::eD16Unorm;
    return depth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

vk::raii::Image make_image(Context& context, const ImageShape& shape) {
    vk::ImageCreateInfo info;
    info.setImageType(vk::ImageType::e2D)
        .setFormat(vk::Format(shape.format))
        .setExtent({shape.width, shape.height, 1})
        .setMipLevels(1)
        .setArrayLayers(1)
        .setSamples(vk::SampleCountFlagBits::e1)
        .setUsage(vk::ImageUsageFlags(shape.usage));
    return vk::raii::Image(context.vk(), info);
}

vk::raii::ImageView make_view(Context& context, vk::Image image, vk::Format format, vk::ImageAspectFlags aspect) {
    vk::ImageViewCreateInfo info;
    info.setImage(image)
        .setViewType(vk::ImageViewType::e2D)
        .setFormat(format)
        .setSubresourceRange({aspect, 0, 1, 0, 1});
    return vk::raii::ImageView(context.vk(), info);
}

} // namespace

Image::Image(std::shared_ptr<Context> context, const std::string& name, const ImageShape& shape) {
    const std::string what =
        "image '" + name + "' of " + std::to_string(shape.width) + "x" + std::to_string(shape.height) + " pixels";
    State state;
    state.context = std::move(context);
    state.shape = shape;
    state.aspect = aspect_of(vk::Format(shape.format));
    asking_for(*state.context, "making " + what, [&] {
        state.image = make_image(*state.context, shape);
        state.memory = allocate(*state.context, state.image.getMemoryRequirements(), {},
                                vk::MemoryPropertyFlagBits::eDeviceLocal, what);
        state.image.bindMemory(*state.memory, 0);
        state.view = make_view(*state.context, *state.image, vk::Format(shape.format), state.aspect);
    });
    state_ = make_held(std::move(state));
}

Image::Image(Image&&) noexcept = default;
Image& Image::operator=(Image&&) noexcept = default;
Image::~Image() = default;

VkImage Image::handle() const { return *state_->image; }
VkImageView Image::view() const { return *state_->view; }
VkImageAspectFlags Image::aspect() const { return static_cast<VkImageAspectFlags>(state_->aspect); }
std::uint32_t Image::width() const { return state_->shape.width; }
std::uint32_t Image::height() const { return state_->shape.height; }

} // namespace manylights::lab::gpu
