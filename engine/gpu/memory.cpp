#include <engine/base/status_exception.hpp>
#include <engine/gpu/memory.hpp>

#include <algorithm>
#include <optional>

namespace nearfield::gpu {

/// One allocation, of the library's or the host's. Its pieces are in ascending order and do not
/// overlap.
struct MemoryBlock {
    struct Piece {
        std::uint64_t offset;
        std::uint64_t size;
    };

    /// With memory for its first piece, so that no new block stays without one.
    explicit MemoryBlock(const Device& of) : device(of) { pieces.reserve(1); }
    ~MemoryBlock() {
        device.memory_count().remove(bytes);
        if (given) {
            device.host_memory()->free(device.host_memory()->user, &*given);
        }
    }
    MemoryBlock(const MemoryBlock&) = delete;
    MemoryBlock& operator=(const MemoryBlock&) = delete;

    void count(std::uint64_t all) {
        bytes = all;
        device.memory_count().add(bytes);
    }

    const Device& device;
    Owned<VkDeviceMemory> own;
    std::optional<MemoryAllocation> given;  // instead, where the host has an allocator
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint64_t start = 0;  // of the block in its memory
    std::uint64_t bytes = 0;  // counted
    std::uint32_t type = 0;
    MemoryKind kind{};
    VkMemoryPropertyFlags flags = 0;
    std::byte* data = nullptr;  // at `start`, mapped for as long as it lives
    std::vector<Piece> pieces;
};

namespace {

std::uint64_t rounded_up(std::uint64_t value, std::uint64_t step) {
    return (value + step - 1) / step * step;
}

const char* name_of(MemoryKind kind) {
    switch (kind) {
        case MemoryKind::mapped_buffer:
            return "nearfield mapped memory";
        case MemoryKind::buffer:
            return "nearfield memory of buffers";
        case MemoryKind::image:
            return "nearfield memory of images";
    }
    return "";
}

/// The contradiction between the host's answer and the request; empty if there is none.
std::string contradiction(const MemoryAllocation& given, const MemoryRequest& request) {
    const VkMemoryRequirements& needs = request.requirements;
    if (given.memory == VK_NULL_HANDLE) {
        return "memory is null";
    }
    if (given.memory_type != unknown_memory_type &&
        (given.memory_type >= VK_MAX_MEMORY_TYPES ||
         ((needs.memoryTypeBits >> given.memory_type) & 1U) == 0)) {
        return "memory_type is " + std::to_string(given.memory_type) +
               ", which is not among the allowed types " + std::to_string(needs.memoryTypeBits) +
               " (bit mask)";
    }
    if (given.offset % needs.alignment != 0) {
        return "offset is " + std::to_string(given.offset) +
               ", which is not a multiple of the alignment " + std::to_string(needs.alignment);
    }
    if ((request.required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) {
        return {};
    }
    if (given.mapped == nullptr) {
        return "mapped is null, and the host has to see this memory";
    }
    constexpr std::uintptr_t alignment = 64;  // every mapping has it, at aligned offsets
    if (reinterpret_cast<std::uintptr_t>(given.mapped) % alignment != 0) {
        return "mapped is no multiple of 64, so it is not where the byte at offset is";
    }
    return {};
}

/// One piece of memory from the host's allocator. Throws StatusException: the error that the host
/// returned, or invalid_settings, which names what contradicts the request.
void take_from_host(const MemoryRequest& request, MemoryBlock& block) {
    constexpr const char* call = "HostDevice::memory.allocate";
    const MemoryFunctions& functions = *block.device.host_memory();
    MemoryAllocation given;
    const VkResult result = functions.allocate(functions.user, &request, &given);
    check(result, call, request.name);
    if (result != VK_SUCCESS) {
        throw StatusException({StatusCode::invalid_settings,
                               std::string(call) + " returned " + to_string(result) + " for " +
                                   request.name + ", which is neither success nor an error"});
    }
    block.given = given;  // given back with the block
    if (const std::string reason = contradiction(given, request); !reason.empty()) {
        throw StatusException(
            {StatusCode::invalid_settings, std::string(call) +
                                               " gave memory that contradicts the request for " +
                                               request.name + ": " + reason});
    }
}

bool is_out_of_memory(VkResult result) {
    return result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
}

}  // namespace

VkDeviceMemory DeviceMemory::get() const {
    return block_ == nullptr ? VK_NULL_HANDLE : block_->memory;
}

std::byte* DeviceMemory::data() const {
    return block_ == nullptr || block_->data == nullptr ? nullptr
                                                        : block_->data + (offset_ - block_->start);
}

VkMemoryPropertyFlags DeviceMemory::flags() const {
    return block_ == nullptr ? 0 : block_->flags;
}

void DeviceMemory::reset() noexcept {
    if (block_ != nullptr) {
        blocks_->give_back(*std::exchange(block_, nullptr), offset_);
    }
}

MemoryBlocks::MemoryBlocks(const Device& device) : device_(&device) {}
MemoryBlocks::~MemoryBlocks() = default;

DeviceMemory MemoryBlocks::allocate(const VkMemoryRequirements& needs, const MemoryWish& wish,
                                    MemoryKind kind, const std::string& what) {
    VkMemoryRequirements piece = needs;
    if (kind == MemoryKind::mapped_buffer) {
        // Flushing must not touch a neighbour, and kernels want aligned data.
        const std::uint64_t atom =
            std::max<std::uint64_t>(64, device_->limits().nonCoherentAtomSize);
        piece.size = rounded_up(needs.size, atom);
        piece.alignment = std::max(needs.alignment, atom);
    }
    if (device_->host_memory() != nullptr) {
        return take(ask_host(piece, wish, kind, what), piece);
    }
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    // Device-local memory is limited, and its host-visible part is often small; the next best type
    // is slower but still correct.
    std::uint32_t untried = needs.memoryTypeBits;
    do {
        const std::uint32_t type = device_->memory_type(untried, wish.required, wish.preferred);
        untried &= ~(1U << type);
        if (DeviceMemory found = take_from_any(type, kind, piece); found.block_ != nullptr) {
            return found;
        }
        const std::uint64_t bytes = block_size(type, kind, piece.size);
        result = add_block(type, kind, bytes, what);
        if (is_out_of_memory(result) && bytes > piece.size) {
            result = add_block(type, kind, piece.size, what);
        }
    } while (is_out_of_memory(result) && device_->has_memory_type(untried, wish.required));
    check(result, "vkAllocateMemory", what);
    return take(*blocks_.back(), piece);
}

/// As much as there is of the kind already, so that blocks stay few, between the limits.
std::uint64_t MemoryBlocks::block_size(std::uint32_t type, MemoryKind kind,
                                       std::uint64_t needed) const {
    std::uint64_t held = 0;
    for (const auto& block : blocks_) {
        held += block->type == type && block->kind == kind ? block->bytes : 0;
    }
    return std::max(needed, std::clamp(held, smallest_block, largest_block));
}

VkResult MemoryBlocks::add_block(std::uint32_t type, MemoryKind kind, std::uint64_t bytes,
                                 const std::string& what) {
    // Allocated first: if that fails, no memory may leak.
    auto block = std::make_unique<MemoryBlock>(*device_);
    blocks_.reserve(blocks_.size() + 1);
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = bytes;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const Functions& functions = device_->functions();
    const VkResult result =
        functions.vkAllocateMemory(device_->handle(), &info, device_->allocator(), &memory);
    if (result != VK_SUCCESS) {
        return result;
    }
    block->own = Owned<VkDeviceMemory>(*device_, memory);
    block->memory = memory;
    block->count(bytes);
    block->type = type;
    block->kind = kind;
    block->flags = device_->memory_flags(type);
    device_->name_object(VK_OBJECT_TYPE_DEVICE_MEMORY, memory, name_of(kind));
    if (kind == MemoryKind::mapped_buffer) {
        void* data = nullptr;
        check(functions.vkMapMemory(device_->handle(), memory, 0, VK_WHOLE_SIZE, 0, &data),
              "vkMapMemory", what);
        block->data = static_cast<std::byte*>(data);
    }
    blocks_.push_back(std::move(block));
    return VK_SUCCESS;
}

/// A block for one piece, from the host's allocator.
MemoryBlock& MemoryBlocks::ask_host(const VkMemoryRequirements& needs, const MemoryWish& wish,
                                    MemoryKind kind, const std::string& what) {
    MemoryRequest request;
    request.requirements = needs;
    request.requirements.memoryTypeBits =
        device_->usable_types(needs.memoryTypeBits, wish.required);
    request.required = wish.required;
    request.preferred = wish.preferred;
    request.optimal_images = kind == MemoryKind::image;
    request.name = what.c_str();
    auto block = std::make_unique<MemoryBlock>(*device_);
    take_from_host(request, *block);
    const MemoryAllocation& given = *block->given;
    block->memory = given.memory;
    block->start = given.offset;
    block->count(needs.size);
    block->type = given.memory_type;
    block->kind = kind;
    block->flags = given.memory_type == unknown_memory_type
                       ? wish.required
                       : device_->memory_flags(given.memory_type);
    if (kind == MemoryKind::mapped_buffer) {
        block->data = static_cast<std::byte*>(given.mapped);
    }
    return *blocks_.emplace_back(std::move(block));
}

DeviceMemory MemoryBlocks::take_from_any(std::uint32_t type, MemoryKind kind,
                                         const VkMemoryRequirements& needs) {
    for (const auto& block : blocks_) {
        if (block->type == type && block->kind == kind) {
            if (DeviceMemory found = take(*block, needs); found.block_ != nullptr) {
                return found;
            }
        }
    }
    return {};
}

/// The first gap that is large enough; nothing if there is none.
DeviceMemory MemoryBlocks::take(MemoryBlock& block, const VkMemoryRequirements& needs) {
    std::uint64_t start = block.start;
    auto next = block.pieces.begin();
    while (next != block.pieces.end() && start + needs.size > next->offset) {
        start = rounded_up(next->offset + next->size, needs.alignment);
        ++next;
    }
    DeviceMemory taken;
    if (start + needs.size <= block.start + block.bytes) {
        block.pieces.insert(next, {start, needs.size});
        taken.blocks_ = this;
        taken.block_ = &block;
        taken.offset_ = start;
        taken.size_ = needs.size;
    }
    return taken;
}

void MemoryBlocks::give_back(MemoryBlock& block, std::uint64_t offset) noexcept {
    std::erase_if(block.pieces,
                  [offset](const MemoryBlock::Piece& piece) { return piece.offset == offset; });
    if (block.pieces.empty()) {
        std::erase_if(blocks_, [&block](const auto& each) { return each.get() == &block; });
    }
}

}  // namespace nearfield::gpu
