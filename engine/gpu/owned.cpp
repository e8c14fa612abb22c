#include <engine/gpu/owned.hpp>

namespace nearfield::gpu {

#define NEARFIELD_OBJECT(Object, TYPE)                                                        \
    void destroy(const Device& device, Vk##Object object) {                                   \
        device.functions().vkDestroy##Object(device.handle(), object, device.allocator());    \
    }                                                                                         \
    Owned<Vk##Object> make_object(const Device& device, const Vk##Object##CreateInfo& info,   \
                                  std::string_view what, const std::string& name) {           \
        Vk##Object object = VK_NULL_HANDLE;                                                   \
        check(device.functions().vkCreate##Object(device.handle(), &info, device.allocator(), \
                                                  &object),                                   \
              "vkCreate" #Object, what);                                                      \
        Owned<Vk##Object> owned(device, object);                                              \
        device.name_object(VK_OBJECT_TYPE_##TYPE, object, name);                              \
        return owned;                                                                         \
    }
NEARFIELD_OBJECTS(NEARFIELD_OBJECT)
#undef NEARFIELD_OBJECT

void destroy(const Device& device, VkDeviceMemory object) {
    device.functions().vkFreeMemory(device.handle(), object, device.allocator());
}

void destroy(const Device& device, VkPipeline object) {
    device.functions().vkDestroyPipeline(device.handle(), object, device.allocator());
}

}  // namespace nearfield::gpu
