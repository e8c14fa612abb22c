#pragma once

#include <engine/gpu/device.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace nearfield::gpu {

/// The objects that only their information makes, with the names of their types in VkObjectType.
// clang-format off
#define NEARFIELD_OBJECTS(object)                      \
    object(Buffer, BUFFER)                             \
    object(BufferView, BUFFER_VIEW)                    \
    object(CommandPool, COMMAND_POOL)                  \
    object(DescriptorPool, DESCRIPTOR_POOL)            \
    object(DescriptorSetLayout, DESCRIPTOR_SET_LAYOUT) \
    object(Fence, FENCE)                               \
    object(Framebuffer, FRAMEBUFFER)                   \
    object(Image, IMAGE)                               \
    object(ImageView, IMAGE_VIEW)                      \
    object(PipelineLayout, PIPELINE_LAYOUT)            \
    object(QueryPool, QUERY_POOL)                      \
    object(RenderPass, RENDER_PASS)                    \
    object(Sampler, SAMPLER)                           \
    object(Semaphore, SEMAPHORE)                       \
    object(ShaderModule, SHADER_MODULE)
// clang-format on

/// Each calls the vkDestroy (or vkFree) function of an object's type.
#define NEARFIELD_OBJECT(Object, TYPE) void destroy(const Device& device, Vk##Object object);
NEARFIELD_OBJECTS(NEARFIELD_OBJECT)
#undef NEARFIELD_OBJECT
void destroy(const Device& device, VkDeviceMemory object);
void destroy(const Device& device, VkPipeline object);

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

/// Each makes an object and names it. Throws StatusException, whose message says what it was for.
#define NEARFIELD_OBJECT(Object, TYPE)                                              \
    [[nodiscard]] Owned<Vk##Object> make_object(const Device& device,               \
                                                const Vk##Object##CreateInfo& info, \
                                                std::string_view what, const std::string& name);
NEARFIELD_OBJECTS(NEARFIELD_OBJECT)
#undef NEARFIELD_OBJECT

}  // namespace nearfield::gpu
