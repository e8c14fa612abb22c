#pragma once

#include "own_device.hpp"

#include <nearfield/status.hpp>

#include <vulkan/vulkan.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::examples {

/// Returns the value or throws the library's error; examples have no better error handling.
template <class Value>
Value value_of(Expected<Value> expected) {
    if (!expected) {
        throw std::runtime_error(expected.error().text());
    }
    return std::move(*expected);
}

/// An object of a device, destroyed with its owner.
template <class Handle, auto destroy>
class Owned {
public:
    using handle_type = Handle;

    Owned() = default;
    Owned(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
    ~Owned() {
        if (handle_ != VK_NULL_HANDLE) {
            destroy(device_, handle_, nullptr);
        }
    }
    Owned(Owned&& other) noexcept
        : device_(other.device_),
          handle_(std::exchange(other.handle_, static_cast<Handle>(VK_NULL_HANDLE))) {}
    Owned& operator=(Owned&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;

    [[nodiscard]] Handle get() const { return handle_; }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
};

using Buffer = Owned<VkBuffer, vkDestroyBuffer>;
using CommandPool = Owned<VkCommandPool, vkDestroyCommandPool>;
using Fence = Owned<VkFence, vkDestroyFence>;
using Framebuffer = Owned<VkFramebuffer, vkDestroyFramebuffer>;
using Image = Owned<VkImage, vkDestroyImage>;
using ImageView = Owned<VkImageView, vkDestroyImageView>;
using Memory = Owned<VkDeviceMemory, vkFreeMemory>;
using Pipeline = Owned<VkPipeline, vkDestroyPipeline>;
using PipelineLayout = Owned<VkPipelineLayout, vkDestroyPipelineLayout>;
using RenderPass = Owned<VkRenderPass, vkDestroyRenderPass>;
using Semaphore = Owned<VkSemaphore, vkDestroySemaphore>;
using ShaderModule = Owned<VkShaderModule, vkDestroyShaderModule>;
using Swapchain = Owned<VkSwapchainKHR, vkDestroySwapchainKHR>;

inline void require(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " failed with VkResult " +
                                 std::to_string(result));
    }
}

/// create<Fence>(device, vkCreateFence, info, "vkCreateFence") returns the object or throws.
template <class Object, class Function, class Info>
Object create(VkDevice device, Function function, const Info& info, const char* call) {
    typename Object::handle_type handle = VK_NULL_HANDLE;
    require(function(device, &info, nullptr, &handle), call);
    return {device, handle};
}

/// A buffer that stays mapped.
struct HostBuffer {
    HostBuffer() = default;
    HostBuffer(VkPhysicalDevice physical_device, VkDevice device, VkDeviceSize bytes,
               VkBufferUsageFlags usage);

    Memory memory;
    Buffer buffer;  ///< destroyed before its memory
    VkDeviceSize size = 0;
    void* mapped = nullptr;
};

/// An image with its own memory and view.
struct DeviceImage {
    DeviceImage() = default;
    DeviceImage(VkPhysicalDevice physical_device, VkDevice device, VkFormat format,
                VkExtent2D extent, VkImageUsageFlags usage, VkImageAspectFlags aspect);

    Memory memory;
    Image image;
    ImageView view;
};

/// Makes a view of the whole image.
[[nodiscard]] ImageView make_view(VkDevice device, VkImage image, VkFormat format,
                                  VkImageAspectFlags aspect);

/// Reads the pixels of a colour image with 4 bytes each, row by row from the top; waits for the
/// device. The image is in `layout`, keeps it, and must have been made as a copy source.
[[nodiscard]] std::vector<std::uint8_t> read_back(const OwnDevice& device, VkImage image,
                                                  VkImageLayout layout, VkExtent2D extent);

}  // namespace nearfield::examples
