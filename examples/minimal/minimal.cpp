// manylights in one file: 4,096 lights over a plane, drawn without a window by one compute shader.
//
//     minimal [out.png]
//
// Reads from the bottom up: main, then draw, whose [integration] part is all that manylights needs. The rest is plain
// Vulkan 1.3 and would be the same with any other way to light a scene.
#include <manylights/manylights.hpp>

#include <vulkan/vulkan.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 720;
constexpr std::uint32_t kLightsPerSide = 64;
constexpr std::uint32_t kBindingCount = 7; // the five buffers of manylights, our lights, the image

constexpr std::uint32_t kShaderCode[] =
#include "minimal.comp.inc"
    ;

struct NoDevice : std::runtime_error {
    using std::runtime_error::runtime_error;
};

void check(VkResult result, const char* what) {
    if (result == VK_SUCCESS) return;
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) throw NoDevice("no Vulkan driver found");
    throw std::runtime_error(std::string(what) + " failed: VkResult " + std::to_string(result));
}

void check(const manylights::Status& status) {
    if (status) return;
    throw std::runtime_error(std::string(status.name()) + ": " + status.report.field + " " + status.report.rule);
}

// ---- Lights --------------------------------------------------------------------------------------------------------

// Our own light, as any renderer has one. manylights reads position and range in place, and never sees the rest.
struct Light {
    std::array<float, 3> position; // world space
    float range;
    std::array<float, 3> color;
    float bulb_radius;
};

// A number in [0, 1) for a light and a purpose (the finaliser of MurmurHash3).
float random_unit(std::uint32_t light, std::uint32_t purpose) {
    std::uint32_t bits = light * 16u + purpose;
    bits = (bits ^ (bits >> 16)) * 0x85EBCA6Bu;
    bits = (bits ^ (bits >> 13)) * 0xC2B2AE35u;
    return static_cast<float>((bits ^ (bits >> 16)) >> 8) * 0x1p-24f;
}

// A cycle of lamp colours, once around from 0 to 1: amber, coral, violet, azure.
std::array<float, 3> lamp_color(float turn) {
    static constexpr float kColors[4][3] = {
        {1.0f, 0.42f, 0.08f}, {1.0f, 0.12f, 0.16f}, {0.42f, 0.10f, 1.0f}, {0.04f, 0.50f, 1.0f}};
    const float place = 4.0f * (turn - std::floor(turn));
    const auto first = std::min(static_cast<std::size_t>(place), std::size_t{3});
    const float blend = place - static_cast<float>(first);
    std::array<float, 3> color = {};
    for (std::size_t i = 0; i < 3; ++i)
        color[i] = (1.0f - blend) * kColors[first][i] + blend * kColors[(first + 1) % 4][i];
    return color;
}

// One lamp in each square of a grid on the ground, at a random place in it; colours change slowly over the plane.
Light make_light(std::uint32_t index) {
    const float column = static_cast<float>(index % kLightsPerSide) + random_unit(index, 0);
    const float row = static_cast<float>(index / kLightsPerSide) + random_unit(index, 1);
    const float x = 1.3f * (column - 0.5f * kLightsPerSide), z = 12.0f - 1.3f * row;
    const float height = 0.15f + 1.6f * std::pow(random_unit(index, 2), 4.0f);
    Light light = {};
    light.position = {x, height, z};
    light.range = 2.0f + 1.5f * random_unit(index, 3) + 0.5f * height;
    light.bulb_radius = 0.03f + 0.025f * random_unit(index, 4);
    light.color = lamp_color(0.035f * x + 0.022f * z + 0.4f + 0.35f * random_unit(index, 5));
    const float power = 0.3f + 0.8f * random_unit(index, 6) * random_unit(index, 6) + 0.5f * height;
    for (float& channel : light.color) channel *= power;
    return light;
}

// ---- Camera --------------------------------------------------------------------------------------------------------

// What the shader needs of the camera; the same text as its push constants.
struct CameraConstants {
    float right[4], down[4], forward[4], position[4];
    std::uint32_t size[2];
};

struct Camera {
    ManylightsView view;
    CameraConstants constants;
};

// A camera at (x, y, z) that looks towards -z, and down by pitch radians.
Camera make_camera(float x, float y, float z, float pitch, float vertical_fov) {
    const float s = std::sin(pitch), c = std::cos(pitch);
    const float tan_y = std::tan(0.5f * vertical_fov);
    const float tan_x = tan_y * static_cast<float>(kWidth) / static_cast<float>(kHeight);
    const float near_plane = 0.1f;
    Camera camera = {};
    // Matrices are column-major. The view looks down -z; depth is reversed with an infinite far plane; clip y points
    // down.
    camera.view = {sizeof(ManylightsView),
                   {1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, -x, s * z - c * y, -s * y - c * z, 1},
                   {1 / tan_x, 0, 0, 0, 0, -1 / tan_y, 0, 0, 0, 0, 0, -1, 0, 0, near_plane, 0},
                   kWidth,
                   kHeight,
                   0.5f, // guard_px: any place in the pixel may be shaded
                   0};
    camera.constants = {
        {tan_x, 0, 0, 0}, {0, -tan_y * c, tan_y * s, 0}, {0, -s, -c, 0}, {x, y, z, 0}, {kWidth, kHeight}};
    return camera;
}

// ---- Vulkan --------------------------------------------------------------------------------------------------------

// A zeroed Vulkan structure with its type set.
template <typename Info>
Info info(VkStructureType type) {
    Info zeroed = {};
    zeroed.sType = type;
    return zeroed;
}

struct Gpu {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkPhysicalDeviceProperties properties;
    std::uint32_t queue_family;
    VkDevice device;
    VkQueue queue;
};

// A family whose queues can compute, or -1.
int compute_family(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (std::size_t i = 0; i < count; ++i)
        if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return static_cast<int>(i);
    return -1;
}

// Real GPUs before software, and among equals the one with the newer Vulkan.
std::uint64_t preference(const VkPhysicalDeviceProperties& properties) {
    std::uint64_t rank = 2;
    if (properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU) rank = 3;
    if (properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU) rank = 1;
    return rank << 32 | properties.apiVersion;
}

void choose_device(Gpu& gpu) {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(gpu.instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> all(count);
    check(vkEnumeratePhysicalDevices(gpu.instance, &count, all.data()), "vkEnumeratePhysicalDevices");
    std::uint64_t best = 0;
    for (VkPhysicalDevice physical : all) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(physical, &properties);
        const int family = compute_family(physical);
        if (properties.apiVersion < VK_API_VERSION_1_3 || family < 0 || preference(properties) <= best) continue;
        best = preference(properties);
        gpu.physical = physical;
        gpu.properties = properties;
        gpu.queue_family = static_cast<std::uint32_t>(family);
    }
    if (best == 0) throw NoDevice("no Vulkan 1.3 device found");
}

Gpu open_gpu() {
    Gpu gpu = {};
    auto application = info<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.apiVersion = VK_API_VERSION_1_3;
    auto instance = info<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    instance.pApplicationInfo = &application;
    check(vkCreateInstance(&instance, nullptr, &gpu.instance), "vkCreateInstance");
    choose_device(gpu);

    const float priority = 1.0f;
    auto queue = info<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = gpu.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    auto features = info<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    features.maintenance4 = VK_TRUE; // SPIR-V 1.6 writes the size of a workgroup in a way that needs it
    auto device = info<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    device.pNext = &features;
    device.queueCreateInfoCount = 1;
    device.pQueueCreateInfos = &queue;
    check(vkCreateDevice(gpu.physical, &device, nullptr, &gpu.device), "vkCreateDevice");
    vkGetDeviceQueue(gpu.device, gpu.queue_family, 0, &gpu.queue);
    return gpu;
}

// A storage buffer in memory that both sides see, mapped for as long as it lives.
struct Buffer {
    VkBuffer handle;
    VkDeviceMemory memory;
    void* mapped;
};

std::uint32_t shared_memory_type(const Gpu& gpu, std::uint32_t allowed) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(gpu.physical, &memory);
    const VkMemoryPropertyFlags wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) != 0u && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    throw std::runtime_error("the device has no memory that the host can write");
}

Buffer make_buffer(const Gpu& gpu, std::uint64_t bytes) {
    Buffer buffer = {};
    auto create = info<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    create.size = std::max<std::uint64_t>(bytes, 16); // Vulkan has no empty buffers
    create.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    check(vkCreateBuffer(gpu.device, &create, nullptr, &buffer.handle), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(gpu.device, buffer.handle, &needs);
    auto allocate = info<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = shared_memory_type(gpu, needs.memoryTypeBits);
    check(vkAllocateMemory(gpu.device, &allocate, nullptr, &buffer.memory), "vkAllocateMemory");
    check(vkBindBufferMemory(gpu.device, buffer.handle, buffer.memory, 0), "vkBindBufferMemory");
    check(vkMapMemory(gpu.device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &buffer.mapped), "vkMapMemory");
    return buffer;
}

void destroy_buffer(const Gpu& gpu, const Buffer& buffer) {
    vkDestroyBuffer(gpu.device, buffer.handle, nullptr);
    vkFreeMemory(gpu.device, buffer.memory, nullptr);
}

// The compute shader, its one descriptor set, and a command pool.
struct Pass {
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkDescriptorPool descriptor_pool;
    VkDescriptorSet set;
    VkCommandPool command_pool;
};

void make_layouts(const Gpu& gpu, Pass& pass) {
    std::array<VkDescriptorSetLayoutBinding, kBindingCount> bindings = {};
    for (std::uint32_t i = 0; i < kBindingCount; ++i)
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    auto set_layout = info<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set_layout.bindingCount = kBindingCount;
    set_layout.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(gpu.device, &set_layout, nullptr, &pass.set_layout),
          "vkCreateDescriptorSetLayout");
    const VkPushConstantRange constants = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(CameraConstants)};
    auto layout = info<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &pass.set_layout;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &constants;
    check(vkCreatePipelineLayout(gpu.device, &layout, nullptr, &pass.layout), "vkCreatePipelineLayout");
}

void make_pipeline(const Gpu& gpu, Pass& pass) {
    auto code = info<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    code.codeSize = sizeof kShaderCode;
    code.pCode = kShaderCode;
    VkShaderModule shader;
    check(vkCreateShaderModule(gpu.device, &code, nullptr, &shader), "vkCreateShaderModule");
    auto create = info<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    create.stage = info<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    create.stage.module = shader;
    create.stage.pName = "main";
    create.layout = pass.layout;
    check(vkCreateComputePipelines(gpu.device, VK_NULL_HANDLE, 1, &create, nullptr, &pass.pipeline),
          "vkCreateComputePipelines");
    vkDestroyShaderModule(gpu.device, shader, nullptr);
}

void bind_buffers(const Gpu& gpu, Pass& pass, const std::array<Buffer, kBindingCount>& buffers) {
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBindingCount};
    auto pool = info<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(vkCreateDescriptorPool(gpu.device, &pool, nullptr, &pass.descriptor_pool), "vkCreateDescriptorPool");
    auto allocate = info<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = pass.descriptor_pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &pass.set_layout;
    check(vkAllocateDescriptorSets(gpu.device, &allocate, &pass.set), "vkAllocateDescriptorSets");
    for (std::uint32_t i = 0; i < kBindingCount; ++i) {
        const VkDescriptorBufferInfo buffer = {buffers[i].handle, 0, VK_WHOLE_SIZE};
        auto write = info<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstSet = pass.set;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = &buffer;
        vkUpdateDescriptorSets(gpu.device, 1, &write, 0, nullptr);
    }
}

VkCommandBuffer record(const Gpu& gpu, const Pass& pass, const CameraConstants& camera) {
    auto allocate = info<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = pass.command_pool;
    allocate.commandBufferCount = 1;
    VkCommandBuffer commands;
    check(vkAllocateCommandBuffers(gpu.device, &allocate, &commands), "vkAllocateCommandBuffers");
    auto begin = info<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.layout, 0, 1, &pass.set, 0, nullptr);
    vkCmdPushConstants(commands, pass.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof camera, &camera);
    vkCmdDispatch(commands, (kWidth + 7) / 8, (kHeight + 7) / 8, 1);
    // What the host wrote before the submission is visible to it; the way back needs a barrier.
    auto to_host = info<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    to_host.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0,
                         nullptr, 0, nullptr);
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    return commands;
}

void run(const Gpu& gpu, const std::array<Buffer, kBindingCount>& buffers, const CameraConstants& camera) {
    Pass pass = {};
    make_layouts(gpu, pass);
    make_pipeline(gpu, pass);
    bind_buffers(gpu, pass, buffers);
    auto pool = info<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.queueFamilyIndex = gpu.queue_family;
    check(vkCreateCommandPool(gpu.device, &pool, nullptr, &pass.command_pool), "vkCreateCommandPool");
    VkCommandBuffer commands = record(gpu, pass, camera);
    auto submit = info<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(gpu.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(gpu.queue), "vkQueueWaitIdle");
    vkDestroyCommandPool(gpu.device, pass.command_pool, nullptr);
    vkDestroyDescriptorPool(gpu.device, pass.descriptor_pool, nullptr);
    vkDestroyPipeline(gpu.device, pass.pipeline, nullptr);
    vkDestroyPipelineLayout(gpu.device, pass.layout, nullptr);
    vkDestroyDescriptorSetLayout(gpu.device, pass.set_layout, nullptr);
}

// ---- The picture ---------------------------------------------------------------------------------------------------

void draw(const char* path) {
    std::vector<Light> lights(kLightsPerSide * kLightsPerSide);
    for (std::uint32_t i = 0; i < lights.size(); ++i) lights[i] = make_light(i);
    const auto light_count = static_cast<std::uint32_t>(lights.size());
    const Camera camera = make_camera(0.0f, 5.2f, 14.0f, 0.30f, 0.80f);
    const Gpu gpu = open_gpu();

    // [integration]
    manylights::Builder builder;
    check(builder.create());

    // Every frame: exact sizes, then straight into mapped memory.
    const ManylightsLights input = {sizeof input, &lights[0].position, sizeof(Light), light_count, 0.0f};
    ManylightsSizes sizes;
    check(builder.plan({&camera.view, 1}, input, sizes));
    const Buffer views = make_buffer(gpu, sizes.views), slice_edges = make_buffer(gpu, sizes.slice_edges);
    const Buffer cells = make_buffer(gpu, sizes.cells), nodes = make_buffer(gpu, sizes.nodes);
    const Buffer references = make_buffer(gpu, sizes.references);
    const ManylightsBuffers output = {views.mapped, slice_edges.mapped, cells.mapped, nodes.mapped, references.mapped};
    check(builder.write(output));
    // [/integration]

    const Buffer light_buffer = make_buffer(gpu, lights.size() * sizeof(Light));
    std::copy(lights.begin(), lights.end(), static_cast<Light*>(light_buffer.mapped));
    const Buffer pixels = make_buffer(gpu, std::uint64_t{4} * kWidth * kHeight);
    const std::array<Buffer, kBindingCount> buffers = {views,      slice_edges,  cells, nodes,
                                                       references, light_buffer, pixels};
    run(gpu, buffers, camera.constants);
    if (stbi_write_png(path, kWidth, kHeight, 4, pixels.mapped, 4 * kWidth) == 0)
        throw std::runtime_error(std::string("cannot write ") + path);
    const ManylightsStats stats = builder.stats();
    std::printf("%s: %ux%u, %u lights (%llu in view), %llu bytes of structure, %s\n", path, kWidth, kHeight,
                light_count, static_cast<unsigned long long>(stats.visible_lights),
                static_cast<unsigned long long>(stats.bytes), gpu.properties.deviceName);
    for (const Buffer& buffer : buffers) destroy_buffer(gpu, buffer);
    vkDestroyDevice(gpu.device, nullptr);
    vkDestroyInstance(gpu.instance, nullptr);
}

} // namespace

// Exit codes: 0 done, 1 failed, 2 bad usage, 3 no usable device.
int main(int argc, char** argv) {
    if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
        std::fprintf(stderr, "usage: minimal [out.png]\n");
        return 2;
    }
    try {
        draw(argc == 2 ? argv[1] : "minimal.png");
        return 0;
    } catch (const NoDevice& error) {
        std::fprintf(stderr, "minimal: %s\n", error.what());
        return 3;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "minimal: %s\n", error.what());
        return 1;
    }
}
