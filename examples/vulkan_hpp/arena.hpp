#pragma once

#include <nearfield/host.hpp>

#include <vulkan/vulkan_raii.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <list>
#include <map>
#include <utility>

/// The host's allocator of device memory, which nearfield uses too: blocks of each memory type,
/// mapped where the host sees them, and in each the first gap that fits.
class Arena {
public:
    struct Block {
        std::uint32_t type = 0;
        bool of_images = false;  // apart from buffers: no granularity separates them then
        std::uint64_t bytes = 0;
        vk::raii::DeviceMemory memory = nullptr;
        std::byte* data = nullptr;
        std::map<std::uint64_t, std::uint64_t> taken;  // ends by offset
    };
    struct Piece {
        Block* block = nullptr;
        std::uint64_t offset = 0;
        [[nodiscard]] std::byte* data() const {
            return block->data == nullptr ? nullptr : block->data + offset;
        }
    };

    Arena(const vk::raii::PhysicalDevice& physical_device, const vk::raii::Device& device)
        : device_(&device), properties_(physical_device.getMemoryProperties()) {}
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// Throws vk::SystemError if there is no memory left.
    [[nodiscard]] Piece take(const VkMemoryRequirements& needs, VkMemoryPropertyFlags required,
                             VkMemoryPropertyFlags preferred, bool of_images) {
        const std::uint32_t type = best_type(needs.memoryTypeBits, required, preferred);
        for (Block& block : blocks_) {
            if (block.type == type && block.of_images == of_images) {
                if (const std::uint64_t offset = gap(block, needs);
                    offset + needs.size <= block.bytes) {
                    block.taken[offset] = offset + needs.size;
                    return {&block, offset};
                }
            }
        }
        Block& block = add_block(type, of_images, needs.size);
        block.taken[0] = needs.size;
        return {&block, 0};
    }
    void give_back(const Piece& piece) { piece.block->taken.erase(piece.offset); }

    /// What nearfield takes its memory with, and gives it back.
    [[nodiscard]] nearfield::MemoryFunctions functions() {
        nearfield::MemoryFunctions functions;
        functions.user = this;
        functions.allocate = [](void* user, const nearfield::MemoryRequest* request,
                                nearfield::MemoryAllocation* allocation) {
            try {
                const Piece piece =
                    static_cast<Arena*>(user)->take(request->requirements, request->required,
                                                    request->preferred, request->optimal_images);
                *allocation = {*piece.block->memory, piece.offset, piece.block->type, piece.data(),
                               piece.block};
                return VK_SUCCESS;
            } catch (const std::exception&) {
                return VK_ERROR_OUT_OF_DEVICE_MEMORY;
            }
        };
        functions.free = [](void* user, const nearfield::MemoryAllocation* allocation) {
            static_cast<Arena*>(user)->give_back(
                {static_cast<Block*>(allocation->handle), allocation->offset});
        };
        return functions;
    }

private:
    /// All of `required`, and most of `preferred`.
    [[nodiscard]] std::uint32_t best_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                          VkMemoryPropertyFlags preferred) const {
        std::uint32_t best = 0;
        int most = -1;
        for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
            const auto flags =
                static_cast<VkMemoryPropertyFlags>(properties_.memoryTypes[type].propertyFlags);
            const int count = std::popcount(flags & preferred);
            if (((allowed >> type) & 1U) != 0 && (flags & required) == required && count > most) {
                best = type;
                most = count;
            }
        }
        return best;
    }
    [[nodiscard]] static std::uint64_t gap(const Block& block, const VkMemoryRequirements& needs) {
        std::uint64_t start = 0;
        for (const auto& [offset, end] : block.taken) {
            if (start + needs.size <= offset) {
                break;
            }
            start = (end + needs.alignment - 1) / needs.alignment * needs.alignment;
        }
        return start;
    }
    [[nodiscard]] Block& add_block(std::uint32_t type, bool of_images, std::uint64_t least) {
        constexpr std::uint64_t usual = std::uint64_t{8} << 20U;
        const std::uint64_t bytes = std::max(usual, least);
        vk::raii::DeviceMemory memory(*device_, vk::MemoryAllocateInfo(bytes, type));
        std::byte* data = nullptr;
        if (properties_.memoryTypes[type].propertyFlags &
            vk::MemoryPropertyFlagBits::eHostVisible) {
            data = static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE));
        }
        return blocks_.emplace_back(Block{type, of_images, bytes, std::move(memory), data, {}});
    }

    const vk::raii::Device* device_;
    vk::PhysicalDeviceMemoryProperties properties_;
    std::list<Block> blocks_;
};
