#include <engine/base/status_exception.hpp>
#include <engine/base/unique_numbers.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/sharing.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace nearfield::gpu {
namespace {

// The host reads a readback buffer, which is slow where the memory is not cached. The device reads
// an upload buffer once per frame, fastest from device-local memory.
VkMemoryPropertyFlags preferred_memory(Direction direction) {
    if (direction == Direction::none) {
        return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    }
    return VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
           (direction == Direction::readback ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                             : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
}

}  // namespace

MappedBuffer::MappedBuffer(const Device& device, VkBufferUsageFlags usage, Direction direction,
                           std::string name, std::span<const std::uint32_t> families)
    : device_(&device),
      usage_(usage),
      direction_(direction),
      name_(std::move(name)),
      families_(families) {}

bool MappedBuffer::reserve(std::uint64_t bytes) {
    bytes = std::max<std::uint64_t>(bytes, 1);
    if (bytes <= capacity_) {
        return false;
    }
    const std::uint64_t capacity = grown(bytes);
    if (capacity_ > 0) {
        device_->log(LogLevel::warning, [&] {
            return "buffer '" + name_ + "' grows from " + std::to_string(capacity_) + " to " +
                   std::to_string(capacity) + " bytes";
        });
    }
    // Free the former buffer first, so that both never occupy memory at the same time.
    capacity_ = 0;
    data_ = nullptr;
    release();
    try {
        create_buffer(capacity);
        allocate_memory();
        if ((usage_ & VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT) != 0) {
            create_texels(capacity);
        }
    } catch (...) {
        release();
        throw;
    }
    capacity_ = capacity;
    identity_ = next_revision();
    return true;
}

BufferPart MappedBuffer::part(std::uint64_t offset, std::uint64_t bytes) const {
    constexpr std::uint64_t unit = 16;
    const std::uint64_t units = std::max<std::uint64_t>((bytes + unit - 1) / unit, 1);
    return {buffer_.get(), offset, units * unit, texels_.get(), identity_};
}

std::uint64_t MappedBuffer::grown(std::uint64_t bytes) const {
    constexpr std::uint64_t step = 65536;
    const std::uint64_t wanted = std::max(bytes, capacity_ + capacity_ / 2);
    return (wanted + step - 1) / step * step;
}

void MappedBuffer::create_buffer(std::uint64_t bytes) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = usage_;
    share(info, families_);
    // Composed first: if this allocation fails, no buffer may leak.
    const std::string what = "buffer '" + name_ + "'";
    buffer_ = make_object(*device_, info, what, name_);
}

void MappedBuffer::allocate_memory() {
    const Functions& functions = device_->functions();
    const std::string what = "the memory of buffer '" + name_ + "'";
    VkMemoryRequirements needs{};
    functions.vkGetBufferMemoryRequirements(device_->handle(), buffer_.get(), &needs);

    const VkMemoryPropertyFlags required =
        direction_ == Direction::none ? 0 : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    const MemoryKind kind =
        direction_ == Direction::none ? MemoryKind::buffer : MemoryKind::mapped_buffer;
    memory_ =
        device_->memory().allocate(needs, {required, preferred_memory(direction_)}, kind, what);
    coherent_ = (memory_.flags() & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;
    check(functions.vkBindBufferMemory(device_->handle(), buffer_.get(), memory_.get(),
                                       memory_.offset()),
          "vkBindBufferMemory", what);
    data_ = memory_.data();
}

void MappedBuffer::create_texels(std::uint64_t bytes) {
    constexpr std::uint64_t texel_bytes = 16;
    VkBufferViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    info.buffer = buffer_.get();
    info.format = VK_FORMAT_R32G32B32A32_UINT;
    info.range = texel_bytes * std::min<std::uint64_t>(bytes / texel_bytes,
                                                       device_->limits().maxTexelBufferElements);
    const std::string name = name_ + " as texels";
    texels_ = make_object(*device_, info, name, name);
}

void MappedBuffer::release() {
    texels_.reset();
    buffer_.reset();
    memory_.reset();
}

VkMappedMemoryRange MappedBuffer::range() const {
    return {VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE, nullptr, memory_.get(), memory_.offset(),
            memory_.size()};
}

void MappedBuffer::flush() const {
    if (!coherent_) {
        const VkMappedMemoryRange whole = range();
        check(device_->functions().vkFlushMappedMemoryRanges(device_->handle(), 1, &whole),
              "vkFlushMappedMemoryRanges", name_);
    }
}

void MappedBuffer::invalidate() const {
    if (!coherent_) {
        const VkMappedMemoryRange whole = range();
        check(device_->functions().vkInvalidateMappedMemoryRanges(device_->handle(), 1, &whole),
              "vkInvalidateMappedMemoryRanges", name_);
    }
}

}  // namespace nearfield::gpu
