#include "lab/gpu/instance.h"

#include "lab/gpu/software_driver.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <tuple>

namespace manylights::lab::gpu {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_validation_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                     VkDebugUtilsMessageTypeFlagsEXT,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<Context*>(user)->validation_messages.fetch_add(1);
    const bool error = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
    std::fprintf(stderr, "validation %s: %s\n", error ? "error" : "warning", data->pMessage);
    std::fflush(stderr); // what is wrong may crash the driver next
    return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(Context& context) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    // Filled as the C struct: the type of the callback differs between versions of the C++ header.
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity = static_cast<VkDebugUtilsMessageSeverityFlagsEXT>(
        vk::DebugUtilsMessageSeverityFlagsEXT(Severity::eWarning | Severity::eError));
    info.messageType = static_cast<VkDebugUtilsMessageTypeFlagsEXT>(
        vk::DebugUtilsMessageTypeFlagsEXT(Type::eValidation | Type::ePerformance));
    info.pfnUserCallback = on_validation_message;
    info.pUserData = &context;
    return info;
}

std::string find_validation_layer(const vk::raii::Context& loader) {
    for (const vk::LayerProperties& layer : loader.enumerateInstanceLayerProperties()) {
        if (std::string(layer.layerName.data()) != kValidationLayer) continue;
        const std::uint32_t version = layer.specVersion;
        return std::string(kValidationLayer) + " " + std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
               std::to_string(VK_API_VERSION_MINOR(version)) + "." + std::to_string(VK_API_VERSION_PATCH(version));
    }
    throw DeviceError(std::string("validation asked for, but the layer ") + kValidationLayer +
                      " is not installed (package vulkan-validationlayers): run scripts/setup");
}

void make_validating_instance(Context& context, vk::InstanceCreateInfo info) {
    context.validation_layer = find_validation_layer(context.loader);
    const vk::ValidationFeatureEnableEXT enabled[] = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    vk::DebugUtilsMessengerCreateInfoEXT messages = messenger_info(context);
    vk::ValidationFeaturesEXT features;
    features.setEnabledValidationFeatures(enabled).setPNext(&messages);
#if defined(VK_EXT_layer_settings)
    // Newer layers look for hazards between shaders' accesses only when asked to; older ones always do.
    const VkBool32 on = VK_TRUE;
    const VkLayerSettingEXT setting = {kValidationLayer, "syncval_shader_accesses_heuristic",
                                       VK_LAYER_SETTING_TYPE_BOOL32_EXT, 1, &on};
    const VkLayerSettingsCreateInfoEXT settings = {VK_STRUCTURE_TYPE_LAYER_SETTINGS_CREATE_INFO_EXT, &messages, 1,
                                                   &setting};
    features.setPNext(&settings);
#endif
    const char* layers[] = {kValidationLayer};
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    info.setPNext(&features).setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions);
    context.instance.emplace(context.loader, info);
    context.messenger.emplace(*context.instance, messages);
}

DeviceInfo describe(const vk::raii::PhysicalDevice& physical) {
    const auto chain =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties,
                                vk::PhysicalDeviceVulkan12Properties, vk::PhysicalDeviceMaintenance3Properties>();
    const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = chain.get<vk::PhysicalDeviceVulkan12Properties>();
    DeviceInfo info;
    info.name = properties.deviceName.data();
    info.driver = driver.driverName.data();
    info.version = driver.driverInfo.data();
    info.is_software = properties.deviceType == vk::PhysicalDeviceType::eCpu;
    info.max_storage_buffer_range = properties.limits.maxStorageBufferRange;
    info.max_allocation = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
    const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
    for (std::uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap)
        info.memory_bytes = std::max<std::uint64_t>(info.memory_bytes, memory.memoryHeaps[heap].size);
    std::copy_n(properties.limits.maxComputeWorkGroupCount.begin(), 3, info.max_workgroups);
    info.max_image_size = properties.limits.maxImageDimension2D;
    const auto& subgroups = chain.get<vk::PhysicalDeviceVulkan11Properties>();
    constexpr auto kOperations = vk::SubgroupFeatureFlagBits::eVote | vk::SubgroupFeatureFlagBits::eBallot |
                                 vk::SubgroupFeatureFlagBits::eArithmetic;
    info.subgroup_size = subgroups.subgroupSize;
    info.has_wave_operations = (subgroups.subgroupSupportedOperations & kOperations) == kOperations &&
                               (subgroups.subgroupSupportedStages & vk::ShaderStageFlagBits::eCompute);
    return info;
}

int rank(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return 0;
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return 1;
    case vk::PhysicalDeviceType::eVirtualGpu:
        return 2;
    case vk::PhysicalDeviceType::eOther:
        return 3;
    default:
        return 4;
    }
}

// Mesa's software driver has the same driverVersion in every release; its text begins "Mesa 25.0.7".
int software_version(const DeviceInfo& info) {
    int version = 0;
    const std::size_t digit = info.version.find_first_of("0123456789");
    if (digit != std::string::npos) version = std::atoi(info.version.c_str() + digit);
    return info.is_software ? version : 0;
}

} // namespace

bool make_instance(Context& context, bool validation) {
    offer_software_driver();
    vk::ApplicationInfo application;
    application.setPApplicationName("manylights").setApiVersion(VK_API_VERSION_1_3);
    vk::InstanceCreateInfo info;
    info.setPApplicationInfo(&application);
    try {
        if (validation)
            make_validating_instance(context, info);
        else
            context.instance.emplace(context.loader, info);
    } catch (const vk::IncompatibleDriverError&) {
        return false;
    }
    return true;
}

std::vector<FoundDevice> find_devices(const vk::raii::Instance& instance) {
    std::vector<std::tuple<int, FoundDevice>> ranked;
    for (vk::raii::PhysicalDevice& physical : vk::raii::PhysicalDevices(instance)) {
        const vk::PhysicalDeviceProperties properties = physical.getProperties();
        if (properties.apiVersion < VK_API_VERSION_1_3) continue;
        DeviceInfo info = describe(physical);
        ranked.emplace_back(rank(properties.deviceType), FoundDevice{std::move(physical), std::move(info)});
    }
    // Drivers of one kind: the newer first. The system's old software driver may stand beside the provided one.
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
        if (std::get<0>(a) != std::get<0>(b)) return std::get<0>(a) < std::get<0>(b);
        return software_version(std::get<1>(a).info) > software_version(std::get<1>(b).info);
    });
    std::vector<FoundDevice> found;
    for (auto& entry : ranked) found.push_back(std::move(std::get<1>(entry)));
    return found;
}

} // namespace manylights::lab::gpu
