#include <tests/support/incoherent_memory.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <new>
#include <span>
#include <vector>

namespace nearfield::test_support {
namespace {

constexpr std::byte junk{0xCD};

/// At least as aligned as vkMapMemory promises on the drivers of the tests.
struct alignas(64) CacheLine {
    std::byte bytes[64];
};

/// The host's cache before one mapped memory.
class Cache {
public:
    Cache(std::byte* device, std::size_t size)
        : device_(device), size_(size), lines_(size / sizeof(CacheLine) + 1) {
        std::fill(host(), host() + size_, junk);
    }

    [[nodiscard]] std::byte* host() { return lines_.front().bytes; }

    void flush(std::size_t offset, VkDeviceSize size) {
        std::copy(host() + offset, host() + end_of(offset, size), device_ + offset);
    }

    void invalidate(std::size_t offset, VkDeviceSize size) {
        std::copy(device_ + offset, device_ + end_of(offset, size), host() + offset);
    }

private:
    [[nodiscard]] std::size_t end_of(std::size_t offset, VkDeviceSize size) const {
        return size == VK_WHOLE_SIZE ? size_ : offset + size;
    }

    std::byte* device_;
    std::size_t size_;
    std::vector<CacheLine> lines_;
};

std::map<VkDeviceMemory, VkDeviceSize> sizes;
std::map<VkDeviceMemory, Cache> caches;

VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                             const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
    const VkResult result = reinterpret_cast<PFN_vkAllocateMemory>(
        true_device_function("vkAllocateMemory"))(device, info, allocator, memory);
    if (result == VK_SUCCESS) {
        sizes[*memory] = info->allocationSize;
    }
    return result;
}

void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory,
                            const VkAllocationCallbacks* allocator) {
    caches.erase(memory);
    reinterpret_cast<PFN_vkFreeMemory>(true_device_function("vkFreeMemory"))(device, memory,
                                                                             allocator);
}

/// The library maps whole memories.
VkResult VKAPI_CALL map(VkDevice device, VkDeviceMemory memory, VkDeviceSize /*offset*/,
                        VkDeviceSize /*size*/, VkMemoryMapFlags flags, void** data) {
    const VkResult result = reinterpret_cast<PFN_vkMapMemory>(true_device_function("vkMapMemory"))(
        device, memory, 0, VK_WHOLE_SIZE, flags, data);
    if (result == VK_SUCCESS) {
        const auto [cache, is_new] =
            caches.try_emplace(memory, static_cast<std::byte*>(*data), sizes[memory]);
        *data = cache->second.host();
    }
    return result;
}

VkResult VKAPI_CALL flush(VkDevice device, std::uint32_t count, const VkMappedMemoryRange* ranges) {
    for (const VkMappedMemoryRange& range : std::span(ranges, count)) {
        caches.at(range.memory).flush(range.offset, range.size);
    }
    return reinterpret_cast<PFN_vkFlushMappedMemoryRanges>(
        true_device_function("vkFlushMappedMemoryRanges"))(device, count, ranges);
}

VkResult VKAPI_CALL invalidate(VkDevice device, std::uint32_t count,
                               const VkMappedMemoryRange* ranges) {
    const VkResult result = reinterpret_cast<PFN_vkInvalidateMappedMemoryRanges>(
        true_device_function("vkInvalidateMappedMemoryRanges"))(device, count, ranges);
    for (const VkMappedMemoryRange& range : std::span(ranges, count)) {
        caches.at(range.memory).invalidate(range.offset, range.size);
    }
    return result;
}

}  // namespace

Lies incoherent_memory() {
    sizes.clear();
    caches.clear();
    Lies lies;
    lies.memory = [](VkPhysicalDeviceMemoryProperties& memory) {
        for (VkMemoryType& type : std::span(memory.memoryTypes, memory.memoryTypeCount)) {
            type.propertyFlags &= ~VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_COHERENT_BIT};
        }
    };
    lies.entry_points = {{"vkAllocateMemory", erased(&allocate)},
                         {"vkFreeMemory", erased(&free_memory)},
                         {"vkMapMemory", erased(&map)},
                         {"vkFlushMappedMemoryRanges", erased(&flush)},
                         {"vkInvalidateMappedMemoryRanges", erased(&invalidate)}};
    return lies;
}

}  // namespace nearfield::test_support
