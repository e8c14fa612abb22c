#include <tests/query/host_targets.hpp>

#include <array>
#include <bit>
#include <cstring>

namespace nearfield::test {
namespace {

using test_support::HostGpu;

constexpr VkImageUsageFlags image_usage =
    VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
constexpr VkBufferUsageFlags buffer_usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                            VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                            VK_BUFFER_USAGE_TRANSFER_DST_BIT;
// Of the image; the last ones are written.
constexpr std::uint32_t levels = 2;
constexpr std::uint32_t layers = 3;
// A multiple of every minStorageBufferOffsetAlignment that Vulkan allows.
constexpr std::uint64_t offset_in_buffer = 1024;
constexpr std::uint64_t offset_of_header = 516;

void show_to_the_host(const HostGpu& gpu, VkCommandBuffer commands) {
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    gpu.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                             0, 1, &barrier, 0, nullptr, 0, nullptr);
}

std::vector<std::uint32_t> words_in(const HostGpu::Buffer& buffer, std::uint64_t bytes) {
    std::vector<std::uint32_t> words(bytes / sizeof(std::uint32_t));
    std::memcpy(words.data(), buffer.data, bytes);
    return words;
}

}  // namespace

HostImage::HostImage(HostGpu& gpu, VkFormat format, VkExtent2D extent)
    : gpu_(&gpu),
      extent_(extent),
      copied_(gpu.make_buffer(std::uint64_t{4} * extent.width * extent.height)) {
    target_.format = format;
    target_.extent = extent;
    target_.usage = image_usage;
    target_.level = levels - 1;
    target_.layer = layers - 1;
    target_.before = {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
    target_.after = {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT,
                     VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const HostGpu::Image made = gpu.make_image(
        format, {2 * extent.width + 1, 2 * extent.height + 1}, image_usage, levels, layers);
    target_.image = made.image;
    target_.view = made.view;
}

void HostImage::clear(VkCommandBuffer commands, VkImageLayout from, std::uint32_t level,
                      std::uint32_t layer) const {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = target_.image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, level, 1, layer, 1};
    gpu_->vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                               VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1,
                               &barrier);
    VkClearColorValue color{};
    for (std::uint32_t& channel : color.uint32) {
        channel = pattern;
    }
    gpu_->vkCmdClearColorImage(commands, target_.image, barrier.newLayout, &color, 1,
                               &barrier.subresourceRange);
}

void HostImage::fill(VkCommandBuffer commands) const {
    for (std::uint32_t level = 0; level < levels; ++level) {
        for (std::uint32_t layer = 0; layer < layers; ++layer) {
            clear(commands, VK_IMAGE_LAYOUT_UNDEFINED, level, layer);
        }
    }
}

void HostImage::use(VkCommandBuffer commands) const {
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, target_.level, target_.layer, 1};
    region.imageExtent = {extent_.width, extent_.height, 1};
    gpu_->vkCmdCopyImageToBuffer(commands, target_.image, target_.after.layout, copied_.buffer, 1,
                                 &region);
    show_to_the_host(*gpu_, commands);
    clear(commands, target_.after.layout, target_.level, target_.layer);
}

std::vector<std::uint32_t> HostImage::words() const {
    return words_in(copied_, std::uint64_t{4} * extent_.width * extent_.height);
}

HostBuffer::HostBuffer(HostGpu& gpu, std::uint64_t bytes, bool has_header) : gpu_(&gpu) {
    if (has_header) {
        target_.header_offset = offset_of_header;
    }
    target_.offset = offset_in_buffer;
    target_.size = bytes;
    target_.usage = buffer_usage;
    target_.before = {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT};
    target_.after = {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT};
    target_.buffer = gpu.make_buffer(all(), target_.usage).buffer;
    copied_ = gpu.make_buffer(all());
}

void HostBuffer::fill(VkCommandBuffer commands) const {
    gpu_->vkCmdFillBuffer(commands, target_.buffer, 0, VK_WHOLE_SIZE, pattern);
}

void HostBuffer::use(VkCommandBuffer commands) const {
    const std::uint64_t end = target_.offset + target_.size;
    const VkBufferCopy range{target_.offset, target_.offset, target_.size};
    gpu_->vkCmdCopyBuffer(commands, target_.buffer, copied_.buffer, 1, &range);
    // The rest was written by the host alone.
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    gpu_->vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                               VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &barrier, 0, nullptr, 0,
                               nullptr);
    const std::array<VkBufferCopy, 2> rest{{{0, 0, target_.offset}, {end, end, all() - end}}};
    gpu_->vkCmdCopyBuffer(commands, target_.buffer, copied_.buffer,
                          static_cast<std::uint32_t>(rest.size()), rest.data());
    show_to_the_host(*gpu_, commands);
    barrier.srcAccessMask = barrier.dstAccessMask = 0;
    gpu_->vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                               VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &barrier, 0, nullptr, 0,
                               nullptr);
    fill(commands);
}

std::vector<std::uint32_t> HostBuffer::words() const {
    return words_in(copied_, all());
}

}  // namespace nearfield::test
