#include <engine/gpu/memory.hpp>

namespace nearfield::gpu {

DeviceMemory allocate_memory(const Device& device, const VkMemoryRequirements& needs,
                             const MemoryWish& wish, const std::string& what,
                             const std::string& name) {
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = needs.size;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    // Device-local memory is limited, and its host-visible part is often small; the next best type
    // is slower but still correct.
    std::uint32_t untried = needs.memoryTypeBits;
    do {
        info.memoryTypeIndex = device.memory_type(untried, wish.required, wish.preferred);
        untried &= ~(1U << info.memoryTypeIndex);
        result = device.functions().vkAllocateMemory(device.handle(), &info, device.allocator(),
                                                     &memory);
    } while (result == VK_ERROR_OUT_OF_DEVICE_MEMORY &&
             device.has_memory_type(untried, wish.required));
    check(result, "vkAllocateMemory", what);
    DeviceMemory owned;
    owned.memory = Owned<VkDeviceMemory>(device, memory);
    owned.bytes = CountedBytes(device, needs.size);
    owned.flags = device.memory_flags(info.memoryTypeIndex);
    device.name_object(VK_OBJECT_TYPE_DEVICE_MEMORY, memory, name);
    return owned;
}

}  // namespace nearfield::gpu
