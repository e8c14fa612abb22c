#include "resources.hpp"

namespace nearfield::examples {
namespace {

using Access = vk::AccessFlagBits;
using Stage = vk::PipelineStageFlagBits;

vk::UniqueDeviceMemory allocate(vk::PhysicalDevice physical_device, vk::Device device,
                                const vk::MemoryRequirements& needed,
                                vk::MemoryPropertyFlags properties) {
    const vk::PhysicalDeviceMemoryProperties memory = physical_device.getMemoryProperties();
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        const bool allowed = (needed.memoryTypeBits & (1U << type)) != 0;
        if (allowed && (memory.memoryTypes[type].propertyFlags & properties) == properties) {
            return device.allocateMemoryUnique({needed.size, type});
        }
    }
    throw std::runtime_error("no type of memory suits");
}

vk::ImageMemoryBarrier whole_image(vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
    return vk::ImageMemoryBarrier()
        .setOldLayout(from)
        .setNewLayout(to)
        .setSrcQueueFamilyIndex(VK_QUEUE_FAMILY_IGNORED)
        .setDstQueueFamilyIndex(VK_QUEUE_FAMILY_IGNORED)
        .setImage(image)
        .setSubresourceRange({vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
}

// The image keeps its layout; the CPU can read the buffer once the device has finished.
void record_copy(vk::CommandBuffer commands, vk::Image image, vk::ImageLayout layout,
                 vk::Extent2D extent, vk::Buffer buffer) {
    constexpr auto source = vk::ImageLayout::eTransferSrcOptimal;
    commands.pipelineBarrier(Stage::eColorAttachmentOutput, Stage::eTransfer, {}, {}, {},
                             whole_image(image, layout, source)
                                 .setSrcAccessMask(Access::eColorAttachmentWrite)
                                 .setDstAccessMask(Access::eTransferRead));
    commands.copyImageToBuffer(image, source, buffer,
                               vk::BufferImageCopy()
                                   .setImageSubresource({vk::ImageAspectFlagBits::eColor, 0, 0, 1})
                                   .setImageExtent({extent.width, extent.height, 1}));
    commands.pipelineBarrier(Stage::eTransfer, Stage::eHost | Stage::eBottomOfPipe, {},
                             vk::MemoryBarrier(Access::eTransferWrite, Access::eHostRead), {},
                             whole_image(image, source, layout));
}

}  // namespace

HostBuffer::HostBuffer(vk::PhysicalDevice physical_device, vk::Device device, vk::DeviceSize bytes,
                       vk::BufferUsageFlags usage)
    : buffer(device.createBufferUnique({{}, bytes, usage})), size(bytes) {
    memory = allocate(
        physical_device, device, device.getBufferMemoryRequirements(*buffer),
        vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent);
    device.bindBufferMemory(*buffer, *memory, 0);
    mapped = device.mapMemory(*memory, 0, VK_WHOLE_SIZE);
}

DeviceImage::DeviceImage(vk::PhysicalDevice physical_device, vk::Device device, vk::Format format,
                         vk::Extent2D extent, vk::ImageUsageFlags usage,
                         vk::ImageAspectFlags aspect)
    : image(device.createImageUnique(vk::ImageCreateInfo()
                                         .setImageType(vk::ImageType::e2D)
                                         .setFormat(format)
                                         .setExtent({extent.width, extent.height, 1})
                                         .setMipLevels(1)
                                         .setArrayLayers(1)
                                         .setUsage(usage))) {
    memory = allocate(physical_device, device, device.getImageMemoryRequirements(*image),
                      vk::MemoryPropertyFlagBits::eDeviceLocal);
    device.bindImageMemory(*image, *memory, 0);
    view = make_view(device, *image, format, aspect);
}

vk::UniqueImageView make_view(vk::Device device, vk::Image image, vk::Format format,
                              vk::ImageAspectFlags aspect) {
    return device.createImageViewUnique(vk::ImageViewCreateInfo()
                                            .setImage(image)
                                            .setViewType(vk::ImageViewType::e2D)
                                            .setFormat(format)
                                            .setSubresourceRange({aspect, 0, 1, 0, 1}));
}

std::vector<std::uint8_t> read_back(const OwnDevice& device, vk::Image image,
                                    vk::ImageLayout layout, vk::Extent2D extent) {
    const std::size_t size = std::size_t{4} * extent.width * extent.height;
    const HostBuffer buffer(device.physical_device(), device.device(), size,
                            vk::BufferUsageFlagBits::eTransferDst);
    const vk::UniqueCommandPool pool =
        device.device().createCommandPoolUnique({{}, device.queue_family()});
    const vk::CommandBuffer commands =
        device.device()
            .allocateCommandBuffers({*pool, vk::CommandBufferLevel::ePrimary, 1})
            .front();
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record_copy(commands, image, layout, extent, *buffer.buffer);
    commands.end();
    device.queue().submit(vk::SubmitInfo().setCommandBuffers(commands));
    device.queue().waitIdle();
    const auto* bytes = static_cast<const std::uint8_t*>(buffer.mapped);
    return {bytes, bytes + size};
}

}  // namespace nearfield::examples
