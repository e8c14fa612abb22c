#pragma once

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace nearfield::examples {

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

}  // namespace nearfield::examples
