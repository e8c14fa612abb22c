#include <engine/base/status_exception.hpp>
#include <engine/gpu/device.hpp>

namespace nearfield::gpu {
namespace {

StatusCode code_of(VkResult result) {
    switch (result) {
        case VK_ERROR_DEVICE_LOST:
            return StatusCode::device_lost;
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return StatusCode::out_of_memory;
        default:
            return StatusCode::device_error;
    }
}

}  // namespace

void check(VkResult result, const char* call, std::string_view what) {
    if (result < VK_SUCCESS) {
        throw StatusException(Status(
            code_of(result),
            std::string(call) + " failed with " + to_string(result) + " for " + std::string(what)));
    }
}

const char* to_string(VkResult result) noexcept {
    switch (result) {
#define NEARFIELD_CASE(name) \
    case name:               \
        return #name;
        NEARFIELD_CASE(VK_SUCCESS)
        NEARFIELD_CASE(VK_NOT_READY)
        NEARFIELD_CASE(VK_TIMEOUT)
        NEARFIELD_CASE(VK_EVENT_SET)
        NEARFIELD_CASE(VK_EVENT_RESET)
        NEARFIELD_CASE(VK_INCOMPLETE)
        NEARFIELD_CASE(VK_ERROR_OUT_OF_HOST_MEMORY)
        NEARFIELD_CASE(VK_ERROR_OUT_OF_DEVICE_MEMORY)
        NEARFIELD_CASE(VK_ERROR_INITIALIZATION_FAILED)
        NEARFIELD_CASE(VK_ERROR_DEVICE_LOST)
        NEARFIELD_CASE(VK_ERROR_MEMORY_MAP_FAILED)
        NEARFIELD_CASE(VK_ERROR_LAYER_NOT_PRESENT)
        NEARFIELD_CASE(VK_ERROR_EXTENSION_NOT_PRESENT)
        NEARFIELD_CASE(VK_ERROR_FEATURE_NOT_PRESENT)
        NEARFIELD_CASE(VK_ERROR_INCOMPATIBLE_DRIVER)
        NEARFIELD_CASE(VK_ERROR_TOO_MANY_OBJECTS)
        NEARFIELD_CASE(VK_ERROR_FORMAT_NOT_SUPPORTED)
        NEARFIELD_CASE(VK_ERROR_FRAGMENTED_POOL)
        NEARFIELD_CASE(VK_ERROR_UNKNOWN)
        NEARFIELD_CASE(VK_ERROR_OUT_OF_POOL_MEMORY)
        NEARFIELD_CASE(VK_ERROR_FRAGMENTATION)
        NEARFIELD_CASE(VK_ERROR_INVALID_EXTERNAL_HANDLE)
        NEARFIELD_CASE(VK_ERROR_INVALID_SHADER_NV)
        NEARFIELD_CASE(VK_ERROR_VALIDATION_FAILED_EXT)
#undef NEARFIELD_CASE
        default:
            return "a VkResult without a known name";
    }
}

}  // namespace nearfield::gpu
