#include "resources.hpp"

namespace nearfield::examples {
namespace {

Memory allocate(VkPhysicalDevice physical_device, VkDevice device,
                const VkMemoryRequirements& needed, VkMemoryPropertyFlags properties) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_device, &memory);
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        const bool allowed = (needed.memoryTypeBits & (1U << type)) != 0;
        if (allowed && (memory.memoryTypes[type].propertyFlags & properties) == properties) {
            VkMemoryAllocateInfo info{};
            info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
            info.allocationSize = needed.size;
            info.memoryTypeIndex = type;
            return create<Memory>(device, vkAllocateMemory, info, "vkAllocateMemory");
        }
    }
    throw std::runtime_error("no type of memory suits");
}

VkImageMemoryBarrier whole_image(VkImage image, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    return barrier;
}

// The image keeps its layout; the CPU can read the buffer once the device has finished.
void record_copy(VkCommandBuffer commands, VkImage image, VkImageLayout layout, VkExtent2D extent,
                 VkBuffer buffer) {
    VkImageMemoryBarrier before = whole_image(image, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    before.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    before.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                         VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &before);

    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {extent.width, extent.height, 1};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);

    VkMemoryBarrier to_host{};
    to_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    const VkImageMemoryBarrier after =
        whole_image(image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout);
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                         VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 1,
                         &to_host, 0, nullptr, 1, &after);
}

}  // namespace

HostBuffer::HostBuffer(VkPhysicalDevice physical_device, VkDevice device, VkDeviceSize bytes,
                       VkBufferUsageFlags usage)
    : size(bytes) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = usage;
    buffer = create<Buffer>(device, vkCreateBuffer, info, "vkCreateBuffer");
    VkMemoryRequirements needed;
    vkGetBufferMemoryRequirements(device, buffer.get(), &needed);
    memory = allocate(physical_device, device, needed,
                      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    require(vkBindBufferMemory(device, buffer.get(), memory.get(), 0), "vkBindBufferMemory");
    require(vkMapMemory(device, memory.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
}

DeviceImage::DeviceImage(VkPhysicalDevice physical_device, VkDevice device, VkFormat format,
                         VkExtent2D extent, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    image = create<Image>(device, vkCreateImage, info, "vkCreateImage");
    VkMemoryRequirements needed;
    vkGetImageMemoryRequirements(device, image.get(), &needed);
    memory = allocate(physical_device, device, needed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    require(vkBindImageMemory(device, image.get(), memory.get(), 0), "vkBindImageMemory");
    view = make_view(device, image.get(), format, aspect);
}

ImageView make_view(VkDevice device, VkImage image, VkFormat format, VkImageAspectFlags aspect) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    return create<ImageView>(device, vkCreateImageView, info, "vkCreateImageView");
}

std::vector<std::uint8_t> read_back(const OwnDevice& device, VkImage image, VkImageLayout layout,
                                    VkExtent2D extent) {
    const std::size_t size = std::size_t{4} * extent.width * extent.height;
    const HostBuffer buffer(device.physical_device(), device.device(), size,
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    VkCommandPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool_info.queueFamilyIndex = device.queue_family();
    const CommandPool pool =
        create<CommandPool>(device.device(), vkCreateCommandPool, pool_info, "vkCreateCommandPool");
    VkCommandBufferAllocateInfo allocate_info{};
    allocate_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate_info.commandPool = pool.get();
    allocate_info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    require(vkAllocateCommandBuffers(device.device(), &allocate_info, &commands),
            "vkAllocateCommandBuffers");
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    require(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    record_copy(commands, image, layout, extent, buffer.buffer.get());
    require(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    require(vkQueueSubmit(device.queue(), 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    require(vkQueueWaitIdle(device.queue()), "vkQueueWaitIdle");
    const auto* bytes = static_cast<const std::uint8_t*>(buffer.mapped);
    return {bytes, bytes + size};
}

}  // namespace nearfield::examples
