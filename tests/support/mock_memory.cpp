#include <tests/support/mock_entry.hpp>

#include <algorithm>
#include <memory>

namespace nearfield::test_support::mock {
namespace {

constexpr VkDeviceSize bound_alignment = 256;  // of buffers and images in memory

}  // namespace

VkResult perform(Tag_vkAllocateMemory tag, VkDevice device, const VkMemoryAllocateInfo* info,
                 const VkAllocationCallbacks*, VkDeviceMemory* memory) {
    *memory = driver().make<VkDeviceMemory>(tag.name, number(device));
    MockObject& object = *driver().find(tag.name, *memory);
    object.bytes = info->allocationSize;
    object.memory_type = info->memoryTypeIndex;
    return VK_SUCCESS;
}

void perform(Tag_vkFreeMemory tag, VkDevice device, VkDeviceMemory memory,
             const VkAllocationCallbacks*) {
    driver().destroy(tag.name, number(device), memory);
}

VkResult perform(Tag_vkMapMemory tag, VkDevice, VkDeviceMemory memory, VkDeviceSize, VkDeviceSize,
                 VkMemoryMapFlags, void** data) {
    MockObject& object = *driver().find(tag.name, memory);
    if (object.mapped) {
        driver().breach(tag.name, "memory is mapped already");
    }
    if ((memory_flags[object.memory_type] & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) {
        driver().breach(tag.name, "memory that the host cannot see");
    }
    constexpr std::size_t alignment = 64;
    object.mapped = true;
    object.content.resize(object.bytes + alignment);
    void* start = object.content.data();
    std::size_t space = object.content.size();
    *data = std::align(alignment, object.bytes, start, space);
    object.words = {static_cast<std::uint32_t*>(*data), object.bytes / sizeof(std::uint32_t)};
    std::fill(object.words.begin(), object.words.end(), MockDriver::device_word);
    return VK_SUCCESS;
}

void expect_mapped(std::string_view call, std::uint32_t count, const VkMappedMemoryRange* ranges) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const MockObject* const memory = driver().find(call, ranges[i].memory);
        if (memory != nullptr && !memory->mapped) {
            driver().breach(call, "memory that is not mapped");
        }
        if (ranges[i].offset % non_coherent_atom != 0 || ranges[i].size % non_coherent_atom != 0) {
            driver().breach(call, "a range that is not of whole atoms");
        }
    }
}

VkResult perform(Tag_vkFlushMappedMemoryRanges tag, VkDevice, std::uint32_t count,
                 const VkMappedMemoryRange* ranges) {
    expect_mapped(tag.name, count, ranges);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkInvalidateMappedMemoryRanges tag, VkDevice, std::uint32_t count,
                 const VkMappedMemoryRange* ranges) {
    expect_mapped(tag.name, count, ranges);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateBuffer tag, VkDevice device, const VkBufferCreateInfo* info,
                 const VkAllocationCallbacks*, VkBuffer* buffer) {
    driver().expect_families(tag.name, info->sharingMode,
                             {info->pQueueFamilyIndices, info->queueFamilyIndexCount});
    *buffer = driver().make<VkBuffer>(tag.name, number(device));
    MockObject& object = *driver().find(tag.name, *buffer);
    object.bytes = info->size;
    object.written = (info->usage & VK_BUFFER_USAGE_TRANSFER_DST_BIT) != 0;
    object.copied_from = (info->usage & VK_BUFFER_USAGE_TRANSFER_SRC_BIT) != 0;
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateImage tag, VkDevice device, const VkImageCreateInfo* info,
                 const VkAllocationCallbacks*, VkImage* image) {
    driver().expect_families(tag.name, info->sharingMode,
                             {info->pQueueFamilyIndices, info->queueFamilyIndexCount});
    *image = driver().make<VkImage>(tag.name, number(device));
    driver().find(tag.name, *image)->bytes =
        std::uint64_t{8} * info->extent.width * info->extent.height;
    return VK_SUCCESS;
}

template <class Handle>
void get_requirements(std::string_view call, Handle wanted, VkMemoryRequirements* requirements) {
    const MockObject& object = *driver().find(call, wanted);
    *requirements = {(object.bytes + bound_alignment - 1) / bound_alignment * bound_alignment,
                     bound_alignment, (1U << memory_types) - 1};
}

void perform(Tag_vkGetBufferMemoryRequirements tag, VkDevice, VkBuffer buffer,
             VkMemoryRequirements* requirements) {
    get_requirements(tag.name, buffer, requirements);
}

void perform(Tag_vkGetImageMemoryRequirements tag, VkDevice, VkImage image,
             VkMemoryRequirements* requirements) {
    get_requirements(tag.name, image, requirements);
}

template <class Handle>
VkResult bind(std::string_view call, Handle wanted, VkDeviceMemory memory, VkDeviceSize offset) {
    MockObject* const object = driver().find(call, wanted);
    MockObject* const found = driver().find(call, memory);
    if (object == nullptr || found == nullptr) {
        return VK_SUCCESS;
    }
    if (object->bound) {
        driver().breach(call, "an object that has memory already");
    }
    if (offset + object->bytes > found->bytes) {
        driver().breach(call, "memory that is too small");
    }
    if (offset % bound_alignment != 0) {
        driver().breach(call, "an offset that is not aligned");
    }
    object->bound = true;
    object->offset = offset;
    object->needs[0] = number(memory);
    if (!found->mapped && !found->words.empty()) {
        // Not what another buffer left there.
        const std::span own = found->words.subspan(offset / sizeof(std::uint32_t),
                                                   object->bytes / sizeof(std::uint32_t));
        std::fill(own.begin(), own.end(), MockDriver::resident_word);
    }
    return VK_SUCCESS;
}

VkResult perform(Tag_vkBindBufferMemory tag, VkDevice, VkBuffer buffer, VkDeviceMemory memory,
                 VkDeviceSize offset) {
    return bind(tag.name, buffer, memory, offset);
}

VkResult perform(Tag_vkBindImageMemory tag, VkDevice, VkImage image, VkDeviceMemory memory,
                 VkDeviceSize offset) {
    return bind(tag.name, image, memory, offset);
}

VkResult perform(Tag_vkCreateBufferView tag, VkDevice device, const VkBufferViewCreateInfo* info,
                 const VkAllocationCallbacks*, VkBufferView* view) {
    *view = driver().make<VkBufferView>(tag.name, number(device));
    refer(tag.name, *driver().find(tag.name, *view), 0, info->buffer);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateImageView tag, VkDevice device, const VkImageViewCreateInfo* info,
                 const VkAllocationCallbacks*, VkImageView* view) {
    *view = driver().make<VkImageView>(tag.name, number(device));
    refer(tag.name, *driver().find(tag.name, *view), 0, info->image);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateFramebuffer tag, VkDevice device, const VkFramebufferCreateInfo* info,
                 const VkAllocationCallbacks*, VkFramebuffer* framebuffer) {
    *framebuffer = driver().make<VkFramebuffer>(tag.name, number(device));
    MockObject& object = *driver().find(tag.name, *framebuffer);
    for (std::uint32_t i = 0; i < info->attachmentCount; ++i) {
        refer(tag.name, object, i, info->pAttachments[i]);
    }
    return VK_SUCCESS;
}

}  // namespace nearfield::test_support::mock
