#include "lab/gpu/device.h"

#include "lab/gpu/instance.h"
#include "lab/gpu/probe.h"

#include <algorithm>
#include <cctype>

namespace manylights::lab::gpu {

namespace {

constexpr const char* kNoDevice =
    "no Vulkan 1.3 device: run scripts/setup for a software driver, or install a GPU driver";

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

bool is_index(const std::string& selector) {
    return selector.size() <= 3 &&
           std::all_of(selector.begin(), selector.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string choices(const std::vector<FoundDevice>& found) {
    std::string text;
    for (std::size_t i = 0; i < found.size(); ++i)
        text +=
            (i == 0 ? "" : ", ") + std::to_string(i) + " = " + found[i].info.name + " (" + found[i].info.version + ")";
    return text;
}

FoundDevice select(std::vector<FoundDevice> found, const std::string& selector) {
    if (found.empty()) throw DeviceError(kNoDevice);
    if (selector.empty()) return std::move(found[0]);
    if (is_index(selector)) {
        const std::size_t index = std::stoul(selector);
        if (index < found.size()) return std::move(found[index]);
    } else {
        for (FoundDevice& device : found)
            if (lower(device.info.name).find(lower(selector)) != std::string::npos) return std::move(device);
    }
    throw DeviceError("no device '" + selector + "'; there is: " + choices(found));
}

using FeatureChain = vk::StructureChain<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features,
                                        vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features>;

// Everything that the lab's shaders and passes use.
FeatureChain required_features() {
    FeatureChain chain;
    chain.get<vk::PhysicalDeviceFeatures2>()
        .features.setShaderInt64(true)
        .setDepthClamp(true)
        .setFragmentStoresAndAtomics(true);
    chain.get<vk::PhysicalDeviceVulkan12Features>().setScalarBlockLayout(true).setTimelineSemaphore(true);
    chain.get<vk::PhysicalDeviceVulkan13Features>().setDynamicRendering(true).setSynchronization2(true).setMaintenance4(
        true);
    return chain;
}

void check_features(const vk::raii::PhysicalDevice& physical, const DeviceInfo& info) {
    const auto have = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features,
                                            vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features>();
    const vk::PhysicalDeviceFeatures& features = have.get<vk::PhysicalDeviceFeatures2>().features;
    const auto& features12 = have.get<vk::PhysicalDeviceVulkan12Features>();
    const auto& features13 = have.get<vk::PhysicalDeviceVulkan13Features>();
    const std::pair<const char*, bool> checks[] = {
        {"shaderInt64", features.shaderInt64 == VK_TRUE},
        {"depthClamp", features.depthClamp == VK_TRUE},
        {"fragmentStoresAndAtomics", features.fragmentStoresAndAtomics == VK_TRUE},
        {"scalarBlockLayout", features12.scalarBlockLayout == VK_TRUE},
        {"timelineSemaphore", features12.timelineSemaphore == VK_TRUE},
        {"dynamicRendering", features13.dynamicRendering == VK_TRUE},
        {"synchronization2", features13.synchronization2 == VK_TRUE},
        {"maintenance4", features13.maintenance4 == VK_TRUE},
    };
    for (const auto& [name, present] : checks)
        if (!present) throw DeviceError("the device " + info.name + " lacks the Vulkan feature " + name);
}

std::uint32_t find_queue_family(const vk::raii::PhysicalDevice& physical, const DeviceInfo& info) {
    const vk::QueueFlags wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    const auto families = physical.getQueueFamilyProperties();
    for (std::uint32_t family = 0; family < families.size(); ++family)
        if ((families[family].queueFlags & wanted) == wanted) return family;
    throw DeviceError("the device " + info.name + " has no queue for both graphics and compute");
}

void make_device(Context& context) {
    context.queue_family = find_queue_family(*context.physical, context.info);
    const auto family = context.physical->getQueueFamilyProperties()[context.queue_family];
    context.timestamp_bits = family.timestampValidBits;
    context.timestamp_ns = double(context.physical->getProperties().limits.timestampPeriod);
    context.memory = context.physical->getMemoryProperties();
    const float priority = 1.0f;
    vk::DeviceQueueCreateInfo queue;
    queue.setQueueFamilyIndex(context.queue_family).setQueuePriorities(priority);
    const FeatureChain features = required_features();
    vk::DeviceCreateInfo info;
    info.setQueueCreateInfos(queue).setPNext(&features.get<vk::PhysicalDeviceFeatures2>());
    context.device.emplace(*context.physical, info);
    context.queue.emplace(context.device->getQueue(context.queue_family, 0));
}

// A hung device must not be torn down: see held.h.
std::shared_ptr<Context> make_context() {
    try {
        return std::shared_ptr<Context>(new Context, [](Context* context) {
            if (!context->hung) delete context;
        });
    } catch (const std::exception&) { // the loader's library is not there
        throw DeviceError(kNoDevice);
    }
}

} // namespace

std::vector<DeviceInfo> list_devices() {
    std::vector<DeviceInfo> infos;
    try {
        const std::shared_ptr<Context> context = make_context();
        if (!make_instance(*context, false)) return infos;
        for (FoundDevice& device : find_devices(*context->instance)) infos.push_back(std::move(device.info));
    } catch (const DeviceError&) {
        infos.clear();
    } catch (const vk::SystemError&) {
        infos.clear();
    }
    return infos;
}

Device::Device(const DeviceOptions& options) : context_(make_context()) {
    asking_for(*context_, "opening a Vulkan device", [&] {
        if (!make_instance(*context_, options.validation)) throw DeviceError(kNoDevice);
        FoundDevice found = select(find_devices(*context_->instance), options.selector);
        context_->info = std::move(found.info);
        check_features(found.physical, context_->info);
        context_->physical.emplace(std::move(found.physical));
        make_device(*context_);
    });
    probe_behaviour(*this);
}

Device::~Device() = default;

const DeviceInfo& Device::info() const { return context_->info; }
bool Device::validation_active() const { return !context_->validation_layer.empty(); }
std::uint64_t Device::validation_messages() const { return context_->validation_messages.load(); }
const std::string& Device::validation_layer() const { return context_->validation_layer; }

} // namespace manylights::lab::gpu
