#include "lab/gpu/context.h"

namespace manylights::lab::gpu {

std::uint32_t Context::memory_type(std::uint32_t allowed, vk::MemoryPropertyFlags required,
                                   vk::MemoryPropertyFlags preferred) const {
    for (const vk::MemoryPropertyFlags wanted : {required | preferred, required})
        for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type)
            if ((allowed >> type & 1u) != 0 && (memory.memoryTypes[type].propertyFlags & wanted) == wanted) return type;
    throw DeviceError("the device " + info.name + " has no memory that is " + vk::to_string(required));
}

vk::raii::DeviceMemory allocate(Context& context, const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags required,
                                vk::MemoryPropertyFlags preferred, const std::string& what) {
    const std::uint64_t limit = std::min(context.info.max_allocation, context.info.memory_bytes);
    if (needs.size > limit)
        throw DeviceError(what + " needs " + std::to_string(needs.size) + " bytes, and the device " +
                          context.info.name + " allows " + std::to_string(limit));
    vk::MemoryAllocateInfo info;
    info.setAllocationSize(needs.size)
        .setMemoryTypeIndex(context.memory_type(needs.memoryTypeBits, required, preferred));
    return asking_for(context, "allocating " + std::to_string(needs.size) + " bytes for " + what,
                      [&] { return vk::raii::DeviceMemory(context.vk(), info); });
}

} // namespace manylights::lab::gpu
