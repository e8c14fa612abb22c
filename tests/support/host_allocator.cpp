#include <tests/support/allocations.hpp>
#include <tests/support/host_allocator.hpp>
#include <tests/support/host_frames.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace nearfield::test_support {
namespace {

constexpr std::uint64_t block_bytes = std::uint64_t{16} << 20U;
constexpr std::uint64_t gap = 192;  // no power of two, so that alignment matters
constexpr std::byte pattern{0x5A};

std::uint64_t rounded_up(std::uint64_t value, std::uint64_t step) {
    return (value + step - 1) / step * step;
}

bool same(const MemoryAllocation& one, const MemoryAllocation& other) {
    return one.memory == other.memory && one.offset == other.offset &&
           one.memory_type == other.memory_type && one.mapped == other.mapped &&
           one.handle == other.handle;
}

}  // namespace

template <class Function>
Function HostAllocator::function(const char* name) const {
    return host_function<Function>(host_, name);
}

HostAllocator::HostAllocator(const HostDevice& host) : host_(host) {
    function<PFN_vkGetPhysicalDeviceMemoryProperties>("vkGetPhysicalDeviceMemoryProperties")(
        host.physical_device, &memory_);
    VkPhysicalDeviceProperties properties{};
    function<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(
        host.physical_device, &properties);
    atom_ = properties.limits.nonCoherentAtomSize;
}

void HostAllocator::close() {
    for (const Block& block : blocks_) {
        function<PFN_vkFreeMemory>("vkFreeMemory")(host_.device, block.memory, host_.allocator);
    }
    blocks_.clear();
}

MemoryFunctions HostAllocator::functions() {
    MemoryFunctions functions;
    functions.user = this;
    functions.allocate = [](void* user, const MemoryRequest* request,
                            MemoryAllocation* allocation) {
        const UnwatchedAllocations here;
        return static_cast<HostAllocator*>(user)->allocate(*request, *allocation);
    };
    functions.free = [](void* user, const MemoryAllocation* allocation) {
        const UnwatchedAllocations here;
        static_cast<HostAllocator*>(user)->free(*allocation);
    };
    return functions;
}

std::uint64_t HostAllocator::bytes() const {
    std::uint64_t sum = 0;
    for (const Piece& piece : given_) {
        sum += piece.request.requirements.size;
    }
    return sum;
}

void HostAllocator::check_request(const MemoryRequest& request) {
    const VkMemoryRequirements& needs = request.requirements;
    const auto expect = [&](bool right, const char* what) {
        if (!right) {
            mistakes_.push_back(std::string(request.name) + ": " + what);
        }
    };
    expect(needs.size > 0 && needs.memoryTypeBits != 0, "an empty request");
    expect(std::has_single_bit(needs.alignment), "an alignment that is no power of two");
    for (std::uint32_t type = 0; type < 32; ++type) {
        if (((needs.memoryTypeBits >> type) & 1U) != 0) {
            expect(type < memory_.memoryTypeCount && (memory_.memoryTypes[type].propertyFlags &
                                                      request.required) == request.required,
                   "an allowed type without what is required");
        }
    }
    if ((request.required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        expect(needs.size % atom_ == 0 && needs.alignment % atom_ == 0,
               "mapped memory that shares an atom");
        expect(!request.optimal_images, "mapped images");
    }
}

std::uint32_t HostAllocator::choose_type(const MemoryRequest& request) const {
    std::uint32_t best = UINT32_MAX;
    int best_score = -1;
    for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
        const int score =
            std::popcount(memory_.memoryTypes[type].propertyFlags & request.preferred);
        if (((request.requirements.memoryTypeBits >> type) & 1U) != 0 && score > best_score) {
            best = type;
            best_score = score;
        }
    }
    return best;
}

std::uint64_t HostAllocator::find_gap(const Block& block, const VkMemoryRequirements& needs) const {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> taken;
    for (const Piece& piece : given_) {
        if (piece.allocation.memory == block.memory) {
            taken.emplace_back(piece.allocation.offset,
                               piece.allocation.offset + piece.request.requirements.size);
        }
    }
    std::sort(taken.begin(), taken.end());
    std::uint64_t start = rounded_up(gap, needs.alignment);
    for (const auto& [first, end] : taken) {
        if (start + needs.size + gap <= first) {
            return start;
        }
        start = rounded_up(end + gap, needs.alignment);
    }
    return start;
}

const HostAllocator::Block& HostAllocator::add_block(std::uint32_t type, std::uint64_t bytes) {
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = bytes;
    info.memoryTypeIndex = type;
    Block block{VK_NULL_HANDLE, type, bytes, nullptr};
    if (function<PFN_vkAllocateMemory>("vkAllocateMemory")(host_.device, &info, host_.allocator,
                                                           &block.memory) != VK_SUCCESS) {
        throw std::runtime_error("the host's own allocation failed");
    }
    if ((memory_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        void* data = nullptr;
        if (function<PFN_vkMapMemory>("vkMapMemory")(host_.device, block.memory, 0, VK_WHOLE_SIZE,
                                                     0, &data) != VK_SUCCESS) {
            throw std::runtime_error("the host's own mapping failed");
        }
        block.data = static_cast<std::byte*>(data);
        paint(block, 0, bytes);
    }
    return blocks_.emplace_back(block);
}

void HostAllocator::paint(const Block& block, std::uint64_t offset, std::uint64_t bytes) const {
    if (block.data != nullptr) {
        std::memset(block.data + offset, static_cast<int>(pattern), bytes);
    }
}

VkResult HostAllocator::allocate(const MemoryRequest& request, MemoryAllocation& allocation) {
    check_request(request);
    const VkMemoryRequirements& needs = request.requirements;
    const std::uint32_t type = choose_type(request);
    const Block* block = nullptr;
    std::uint64_t offset = 0;
    for (const Block& each : blocks_) {
        offset = find_gap(each, needs);
        if (each.type == type && offset + needs.size + gap <= each.bytes) {
            block = &each;
            break;
        }
    }
    if (block == nullptr) {
        const std::uint64_t least = rounded_up(gap, needs.alignment) + needs.size + gap;
        block = &add_block(type, std::max(block_bytes, least));
        offset = find_gap(*block, needs);
    }
    Piece& piece = given_.emplace_back(Piece{request, {}, request.name});
    piece.request.name = "";
    allocation = {block->memory, offset, type,
                  block->data == nullptr ? nullptr : block->data + offset, &piece};
    const VkResult result = bend ? bend(request, allocation) : VK_SUCCESS;
    if (result != VK_SUCCESS) {
        given_.pop_back();
        return result;
    }
    piece.allocation = allocation;
    ++requests_;
    return VK_SUCCESS;
}

void HostAllocator::free(const MemoryAllocation& allocation) {
    const auto piece = std::find_if(given_.begin(), given_.end(), [&](const Piece& each) {
        return &each == allocation.handle && same(each.allocation, allocation);
    });
    if (piece == given_.end()) {
        mistakes_.emplace_back("something was given back that was not given, or twice");
        return;
    }
    for (const Block& block : blocks_) {
        const std::uint64_t size = piece->request.requirements.size;
        if (block.memory == allocation.memory && allocation.offset + size <= block.bytes) {
            paint(block, allocation.offset, size);
        }
    }
    given_.erase(piece);
}

bool HostAllocator::gaps_are_written() const {
    for (const Block& block : blocks_) {
        for (std::uint64_t i = 0; block.data != nullptr && i < block.bytes;) {
            const Piece* const piece = find(block.memory, i, 1);
            if (piece != nullptr) {
                i = piece->allocation.offset + piece->request.requirements.size;
            } else if (block.data[i++] != pattern) {
                return true;
            }
        }
    }
    return false;
}

const HostAllocator::Piece* HostAllocator::find(VkDeviceMemory memory, std::uint64_t offset,
                                                std::uint64_t bytes) const {
    const auto piece = std::find_if(given_.begin(), given_.end(), [&](const Piece& each) {
        return each.allocation.memory == memory && each.allocation.offset <= offset &&
               offset + bytes <= each.allocation.offset + each.request.requirements.size;
    });
    return piece == given_.end() ? nullptr : &*piece;
}

}  // namespace nearfield::test_support
