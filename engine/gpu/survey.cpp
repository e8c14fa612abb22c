#include <engine/base/catch_to_status.hpp>
#include <engine/gpu/requirements.hpp>

#include <cstring>

namespace nearfield {
namespace {

void refuse_null(bool present, const char* name) {
    if (!present) {
        throw StatusException({StatusCode::invalid_settings, std::string("PhysicalDevice::") +
                                                                 name +
                                                                 " is null, so there is nothing to "
                                                                 "ask"});
    }
}

}  // namespace

const OptionalPart* Requirements::find(const char* name) const noexcept {
    for (const OptionalPart& part : optional) {
        if (std::strcmp(part.name, name) == 0) {
            return &part;
        }
    }
    return nullptr;
}

Expected<Requirements> requirements(const PhysicalDevice& device) {
    return catch_to_expected([&] {
        refuse_null(device.instance != VK_NULL_HANDLE, "instance");
        refuse_null(device.physical_device != VK_NULL_HANDLE, "physical_device");
        refuse_null(device.get_instance_proc_addr != nullptr, "get_instance_proc_addr");
        gpu::require_vulkan_1(device.api_version, "PhysicalDevice");
        Requirements found;
        gpu::survey_base(device, found);
        gpu::survey_optional_parts(device, found);
        return found;
    });
}

}  // namespace nearfield
