#pragma once

#include <engine/gpu/device.hpp>

#include <utility>

namespace nearfield::gpu {

/// Calls the vkDestroy (or vkFree) function of an object's type.
void destroy(const Device& device, VkBuffer object);
void destroy(const Device& device, VkBufferView object);
void destroy(const Device& device, VkCommandPool object);
void destroy(const Device& device, VkDescriptorPool object);
void destroy(const Device& device, VkDescriptorSetLayout object);
void destroy(const Device& device, VkDeviceMemory object);
void destroy(const Device& device, VkFence object);
void destroy(const Device& device, VkFramebuffer object);
void destroy(const Device& device, VkImage object);
void destroy(const Device& device, VkImageView object);
void destroy(const Device& device, VkPipeline object);
void destroy(const Device& device, VkPipelineLayout object);
void destroy(const Device& device, VkQueryPool object);
void destroy(const Device& device, VkRenderPass object);
void destroy(const Device& device, VkSampler object);
void destroy(const Device& device, VkSemaphore object);
void destroy(const Device& device, VkShaderModule object);

/// Unique owner of a Vulkan object; destroys it with its device, which must outlive it.
template <class Object>
class Owned {
public:
    Owned() = default;
    Owned(const Device& device, Object object) : device_(&device), object_(object) {}
    ~Owned() { reset(); }

    Owned(Owned&& other) noexcept
        : device_(other.device_), object_(std::exchange(other.object_, VK_NULL_HANDLE)) {}
    Owned& operator=(Owned&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(object_, other.object_);
        return *this;
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;

    [[nodiscard]] Object get() const { return object_; }
    [[nodiscard]] explicit operator bool() const { return object_ != VK_NULL_HANDLE; }

    void reset() {
        if (object_ != VK_NULL_HANDLE) {
            destroy(*device_, std::exchange(object_, VK_NULL_HANDLE));
        }
    }

private:
    const Device* device_ = nullptr;
    Object object_ = VK_NULL_HANDLE;
};

}  // namespace nearfield::gpu
