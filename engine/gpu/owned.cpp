#include <engine/gpu/owned.hpp>

namespace nearfield::gpu {

#define NEARFIELD_DESTROY(Type, function)                                         \
    void destroy(const Device& device, Type object) {                             \
        device.functions().function(device.handle(), object, device.allocator()); \
    }

NEARFIELD_DESTROY(VkBuffer, vkDestroyBuffer)
NEARFIELD_DESTROY(VkBufferView, vkDestroyBufferView)
NEARFIELD_DESTROY(VkCommandPool, vkDestroyCommandPool)
NEARFIELD_DESTROY(VkDescriptorPool, vkDestroyDescriptorPool)
NEARFIELD_DESTROY(VkDescriptorSetLayout, vkDestroyDescriptorSetLayout)
NEARFIELD_DESTROY(VkDeviceMemory, vkFreeMemory)
NEARFIELD_DESTROY(VkFence, vkDestroyFence)
NEARFIELD_DESTROY(VkFramebuffer, vkDestroyFramebuffer)
NEARFIELD_DESTROY(VkImage, vkDestroyImage)
NEARFIELD_DESTROY(VkImageView, vkDestroyImageView)
NEARFIELD_DESTROY(VkPipeline, vkDestroyPipeline)
NEARFIELD_DESTROY(VkPipelineLayout, vkDestroyPipelineLayout)
NEARFIELD_DESTROY(VkQueryPool, vkDestroyQueryPool)
NEARFIELD_DESTROY(VkRenderPass, vkDestroyRenderPass)
NEARFIELD_DESTROY(VkSampler, vkDestroySampler)
NEARFIELD_DESTROY(VkSemaphore, vkDestroySemaphore)
NEARFIELD_DESTROY(VkShaderModule, vkDestroyShaderModule)

#undef NEARFIELD_DESTROY

}  // namespace nearfield::gpu
