#include <tests/support/host_gpu.hpp>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace nearfield::test_support {

void require(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " failed with VkResult " +
                                 std::to_string(result));
    }
}

HostGpu::HostGpu(const HostDevice& host) : host_(host) {
    const auto load = [&](const char* name) {
        const PFN_vkVoidFunction found = host.get_instance_proc_addr(host.instance, name);
        if (found == nullptr) {
            throw std::runtime_error(std::string("there is no ") + name);
        }
        return found;
    };
#define NEARFIELD_HOST_LOAD(name) name = reinterpret_cast<PFN_##name>(load(#name));
    NEARFIELD_HOST_FUNCTIONS(NEARFIELD_HOST_LOAD)
#undef NEARFIELD_HOST_LOAD
    reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(
        load("vkGetPhysicalDeviceMemoryProperties"))(host.physical_device, &memory_);

    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = host.queue_family;
    require(vkCreateCommandPool(device(), &pool, nullptr, &pool_), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = pool_;
    info.commandBufferCount = 1;
    require(vkAllocateCommandBuffers(device(), &info, &commands_), "vkAllocateCommandBuffers");
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    require(vkCreateFence(device(), &fence, nullptr, &fence_), "vkCreateFence");
}

HostGpu::~HostGpu() {
    for (auto destroy = at_end_.rbegin(); destroy != at_end_.rend(); ++destroy) {
        (*destroy)();
    }
    vkDestroyFence(device(), fence_, nullptr);
    vkDestroyCommandPool(device(), pool_, nullptr);
}

VkDeviceMemory HostGpu::allocate(const VkMemoryRequirements& needs,
                                 VkMemoryPropertyFlags properties) {
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = needs.size;
    while ((needs.memoryTypeBits >> info.memoryTypeIndex & 1U) == 0 ||
           (memory_.memoryTypes[info.memoryTypeIndex].propertyFlags & properties) != properties) {
        if (++info.memoryTypeIndex == memory_.memoryTypeCount) {
            throw std::runtime_error("no memory type fits");
        }
    }
    VkDeviceMemory memory = VK_NULL_HANDLE;
    require(vkAllocateMemory(device(), &info, nullptr, &memory), "vkAllocateMemory");
    at_end([this, memory] { vkFreeMemory(device(), memory, nullptr); });
    return memory;
}

HostGpu::Buffer HostGpu::make_buffer(std::uint64_t bytes, VkBufferUsageFlags usage) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = usage;
    Buffer buffer;
    require(vkCreateBuffer(device(), &info, nullptr, &buffer.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device(), buffer.buffer, &needs);
    VkDeviceMemory memory =
        allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    require(vkBindBufferMemory(device(), buffer.buffer, memory, 0), "vkBindBufferMemory");
    void* data = nullptr;
    require(vkMapMemory(device(), memory, 0, VK_WHOLE_SIZE, 0, &data), "vkMapMemory");
    buffer.data = static_cast<const std::byte*>(data);
    at_end([this, handle = buffer.buffer] { vkDestroyBuffer(device(), handle, nullptr); });
    return buffer;
}

HostGpu::Image HostGpu::make_image(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
                                   std::uint32_t levels, std::uint32_t layers) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = levels;
    info.arrayLayers = layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    Image image;
    require(vkCreateImage(device(), &info, nullptr, &image.image), "vkCreateImage");
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device(), image.image, &needs);
    require(vkBindImageMemory(device(), image.image, allocate(needs, 0), 0), "vkBindImageMemory");
    at_end([this, handle = image.image] { vkDestroyImage(device(), handle, nullptr); });
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = image.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, levels - 1, 1, layers - 1, 1};
    require(vkCreateImageView(device(), &view, nullptr, &image.view), "vkCreateImageView");
    at_end([this, handle = image.view] { vkDestroyImageView(device(), handle, nullptr); });
    return image;
}

void HostGpu::submit(const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    require(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    record(commands_);
    require(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    const VkPipelineStageFlags all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    const VkSemaphore wait = std::exchange(wait_, VK_NULL_HANDLE);
    const VkSemaphore signal = std::exchange(signal_, VK_NULL_HANDLE);
    info.waitSemaphoreCount = wait != VK_NULL_HANDLE ? 1 : 0;
    info.pWaitSemaphores = &wait;
    info.pWaitDstStageMask = &all;
    info.signalSemaphoreCount = signal != VK_NULL_HANDLE ? 1 : 0;
    info.pSignalSemaphores = &signal;
    require(vkQueueSubmit(host_.queue, 1, &info, fence_), "vkQueueSubmit");
}

VkSemaphore HostGpu::make_semaphore() {
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    require(vkCreateSemaphore(device(), &info, nullptr, &semaphore), "vkCreateSemaphore");
    at_end([this, semaphore] { vkDestroySemaphore(device(), semaphore, nullptr); });
    return semaphore;
}

void HostGpu::finish() {
    require(vkWaitForFences(device(), 1, &fence_, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    require(vkResetFences(device(), 1, &fence_), "vkResetFences");
}

namespace {

std::vector<std::uint32_t> words_of(const HostGpu::Buffer& buffer, std::uint64_t bytes) {
    std::vector<std::uint32_t> words(bytes / sizeof(std::uint32_t));
    std::memcpy(words.data(), buffer.data, bytes);
    return words;
}

void show_to_host(const HostGpu& gpu, VkCommandBuffer commands) {
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    gpu.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                             0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

std::vector<std::uint32_t> HostGpu::read(const ImageOnDevice& image, VkExtent2D extent,
                                         const OutputState& state) {
    const std::uint64_t bytes = std::uint64_t{4} * extent.width * extent.height;
    const Buffer target = make_buffer(bytes);
    submit([&](VkCommandBuffer commands) {
        VkImageMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
        barrier.oldLayout = state.layout;
        barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image.image;
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCmdPipelineBarrier(commands, state.stages, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr,
                             0, nullptr, 1, &barrier);
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {extent.width, extent.height, 1};
        vkCmdCopyImageToBuffer(commands, image.image, barrier.newLayout, target.buffer, 1, &region);
        std::swap(barrier.oldLayout, barrier.newLayout);
        barrier.srcAccessMask = 0;
        barrier.dstAccessMask = state.access;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, state.stages, 0, 0, nullptr,
                             0, nullptr, 1, &barrier);
        show_to_host(*this, commands);
    });
    finish();
    return words_of(target, bytes);
}

std::vector<std::uint32_t> HostGpu::read(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size,
                                         const OutputState& state) {
    const Buffer target = make_buffer(size);
    submit([&](VkCommandBuffer commands) {
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = 0;
        barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
        vkCmdPipelineBarrier(commands, state.stages, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &barrier,
                             0, nullptr, 0, nullptr);
        const VkBufferCopy region{offset, 0, size};
        vkCmdCopyBuffer(commands, buffer, target.buffer, 1, &region);
        // Later accesses, such as the library's next write, wait for the copy through the stages
        // that they wait for anyway: those of the resident output.
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, state.stages, 0, 0, nullptr,
                             0, nullptr, 0, nullptr);
        show_to_host(*this, commands);
    });
    finish();
    return words_of(target, size);
}

}  // namespace nearfield::test_support
