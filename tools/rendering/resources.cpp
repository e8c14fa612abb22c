#include <tools/rendering/resources.hpp>

#include <cstdint>
#include <utility>

namespace nearfield::tools {
namespace {

vk::raii::DeviceMemory allocate(const Gpu& gpu, const vk::MemoryRequirements& needed,
                                vk::MemoryPropertyFlags properties) {
    const vk::PhysicalDeviceMemoryProperties offered = gpu.physical_device().getMemoryProperties();
    for (std::uint32_t type = 0; type < offered.memoryTypeCount; ++type) {
        if ((needed.memoryTypeBits & (1U << type)) != 0 &&
            (offered.memoryTypes[type].propertyFlags & properties) == properties) {
            return {
                gpu.device(),
                vk::MemoryAllocateInfo().setAllocationSize(needed.size).setMemoryTypeIndex(type)};
        }
    }
    throw std::runtime_error("the device has no memory of the kind " + vk::to_string(properties));
}

vk::raii::CommandPool make_pool(const Gpu& gpu) {
    return {gpu.device(), vk::CommandPoolCreateInfo()
                              .setFlags(vk::CommandPoolCreateFlagBits::eResetCommandBuffer)
                              .setQueueFamilyIndex(gpu.queue_family())};
}

vk::raii::CommandBuffer make_command_buffer(const Gpu& gpu, const vk::raii::CommandPool& pool) {
    vk::raii::CommandBuffers made(
        gpu.device(),
        vk::CommandBufferAllocateInfo().setCommandPool(*pool).setCommandBufferCount(1));
    return std::move(made.front());
}

}  // namespace

HostBuffer::HostBuffer(const Gpu& gpu, std::size_t size, vk::BufferUsageFlags usage)
    : buffer_(gpu.device(), vk::BufferCreateInfo().setSize(size).setUsage(usage)) {
    memory_ = allocate(
        gpu, buffer_.getMemoryRequirements(),
        vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent);
    buffer_.bindMemory(*memory_, 0);
    bytes_ = {static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE)), size};
}

DeviceImage::DeviceImage(const Gpu& gpu, vk::Extent2D extent, vk::Format format,
                         vk::SampleCountFlagBits samples, vk::ImageUsageFlags usage)
    : image_(gpu.device(), vk::ImageCreateInfo()
                               .setImageType(vk::ImageType::e2D)
                               .setFormat(format)
                               .setExtent({extent.width, extent.height, 1})
                               .setMipLevels(1)
                               .setArrayLayers(1)
                               .setSamples(samples)
                               .setUsage(usage)) {
    memory_ =
        allocate(gpu, image_.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
    image_.bindMemory(*memory_, 0);
    view_ = vk::raii::ImageView(gpu.device(), vk::ImageViewCreateInfo()
                                                  .setImage(*image_)
                                                  .setViewType(vk::ImageViewType::e2D)
                                                  .setFormat(format)
                                                  .setSubresourceRange(whole_image));
}

void change_use(const vk::raii::CommandBuffer& commands, vk::Image image, const ImageUse& before,
                const ImageUse& after) {
    commands.pipelineBarrier(before.stage, after.stage, {}, {}, {},
                             vk::ImageMemoryBarrier()
                                 .setSrcAccessMask(before.access)
                                 .setDstAccessMask(after.access)
                                 .setOldLayout(before.layout)
                                 .setNewLayout(after.layout)
                                 .setSrcQueueFamilyIndex(VK_QUEUE_FAMILY_IGNORED)
                                 .setDstQueueFamilyIndex(VK_QUEUE_FAMILY_IGNORED)
                                 .setImage(image)
                                 .setSubresourceRange(whole_image));
}

Commands::Commands(const Gpu& gpu)
    : gpu_(gpu),
      pool_(make_pool(gpu)),
      commands_(make_command_buffer(gpu, pool_)),
      done_(gpu.device(), vk::FenceCreateInfo().setFlags(vk::FenceCreateFlagBits::eSignaled)) {}

const vk::raii::CommandBuffer& Commands::begin() {
    wait();
    commands_.begin(
        vk::CommandBufferBeginInfo().setFlags(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    return commands_;
}

void Commands::submit(vk::Semaphore wait, vk::Semaphore signal) {
    commands_.end();
    gpu_.device().resetFences(*done_);
    // The first use of the semaphore's image is the copy to it, so only transfers wait.
    const vk::PipelineStageFlags stage = vk::PipelineStageFlagBits::eTransfer;
    auto info = vk::SubmitInfo().setCommandBuffers(*commands_);
    if (wait) {
        info.setWaitSemaphores(wait).setWaitDstStageMask(stage);
    }
    if (signal) {
        info.setSignalSemaphores(signal);
    }
    gpu_.queue().submit(info, *done_);
}

void Commands::wait() const {
    if (gpu_.device().waitForFences(*done_, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess) {
        throw std::runtime_error("waiting for the device failed");
    }
}

}  // namespace nearfield::tools
