#include <engine/base/status_exception.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/memory.hpp>
#include <engine/gpu/requirements.hpp>

#include <algorithm>
#include <bit>

namespace nearfield::gpu {
namespace {

std::vector<std::string> null_handles(const HostDevice& host) {
    std::vector<std::string> missing;
    const auto require = [&missing](bool present, const char* name) {
        if (!present) {
            missing.push_back(std::string("HostDevice::") + name + ": it is null");
        }
    };
    require(host.instance != VK_NULL_HANDLE, "instance");
    require(host.physical_device != VK_NULL_HANDLE, "physical_device");
    require(host.device != VK_NULL_HANDLE, "device");
    require(host.get_instance_proc_addr != nullptr, "get_instance_proc_addr");
    if (const VkAllocationCallbacks* const allocator = host.allocator) {
        require(allocator->pfnAllocation != nullptr, "allocator->pfnAllocation");
        require(allocator->pfnReallocation != nullptr, "allocator->pfnReallocation");
        require(allocator->pfnFree != nullptr, "allocator->pfnFree");
        const bool tells = allocator->pfnInternalAllocation != nullptr;
        const bool tells_the_end = allocator->pfnInternalFree != nullptr;
        require(tells || !tells_the_end, "allocator->pfnInternalAllocation");
        require(tells_the_end || !tells, "allocator->pfnInternalFree");
    }
    return missing;
}

void refuse_if_any(std::vector<std::string> missing, const std::string& device) {
    if (!missing.empty()) {
        throw StatusException(
            Status(StatusCode::unsupported_device,
                   device + " lacks what nearfield needs; each reason names one thing",
                   std::move(missing)));
    }
}

}  // namespace

Device::~Device() = default;

Device::Device(const HostDevice& host)
    : host_(host), memory_blocks_(std::make_unique<MemoryBlocks>(*this)) {
    require_vulkan_1(host.api_version, "HostDevice");
    refuse_if_any(null_handles(host), "the host's device");
    if (host.allocator != nullptr) {
        allocator_ = *host.allocator;
    }
    std::vector<std::string> missing;
    load_instance_functions(missing);
    refuse_if_any(std::move(missing), "the host's instance");

    functions_.vkGetPhysicalDeviceProperties(host.physical_device, &properties_);
    functions_.vkGetPhysicalDeviceMemoryProperties(host.physical_device, &memory_);
    name_ = properties_.deviceName;
    PhysicalDevice asked;
    asked.queue_family = host.queue_family;
    asked.instance = host.instance;
    asked.physical_device = host.physical_device;
    asked.get_instance_proc_addr = host.get_instance_proc_addr;
    asked.api_version = host.api_version;
    Requirements found;
    survey_base(asked, found);
    missing = std::move(found.unmet);
    load_device_functions(missing);
    refuse_if_any(std::move(missing), "device '" + name_ + "'");

    stencil_format_ =
        find_stencil_format(functions_.vkGetPhysicalDeviceFormatProperties, host.physical_device);
    strategy_support_ = gpu::strategy_support(functions_.vkGetPhysicalDeviceFormatProperties,
                                              host.physical_device, host.logic_op);
    gradient_format_ =
        find_gradient_format(functions_.vkGetPhysicalDeviceFormatProperties, host.physical_device);
    const std::vector<VkQueueFamilyProperties> families =
        queue_families(functions_.vkGetPhysicalDeviceQueueFamilyProperties, host.physical_device);
    timestamp_bits_ = families[host.queue_family].timestampValidBits;
    queue_flags_ = families[host.queue_family].queueFlags;
    set_reader_families(families.size());
}

void Device::set_reader_families(std::size_t family_count) {
    reader_families_.push_back(host_.queue_family);
    for (std::uint32_t i = 0; i < host_.reader_family_count; ++i) {
        const std::uint32_t family = host_.reader_families[i];
        if (family >= family_count) {
            throw StatusException({StatusCode::invalid_settings,
                                   "HostDevice::reader_families[" + std::to_string(i) + "] is " +
                                       std::to_string(family) + ", and device '" + name_ +
                                       "' has " + std::to_string(family_count) +
                                       " queue families"});
        }
        if (std::find(reader_families_.begin(), reader_families_.end(), family) ==
            reader_families_.end()) {
            reader_families_.push_back(family);
        }
    }
    if (reader_families_.size() == 1) {
        reader_families_.clear();
    }
    host_.reader_families = nullptr;  // borrowed for the constructor
}

void Device::load_instance_functions(std::vector<std::string>& missing) {
    const auto load = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
            host_.get_instance_proc_addr(host_.instance, name));
        if (function == nullptr) {
            missing.push_back(std::string("entry point ") + name +
                              ": vkGetInstanceProcAddr does not know it");
        }
    };
#define NEARFIELD_LOAD(name) load(functions_.name, #name);
    NEARFIELD_INSTANCE_FUNCTIONS(NEARFIELD_LOAD)
    if (host_.debug_utils) {
        NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_LOAD)
    }
#undef NEARFIELD_LOAD
}

void Device::load_device_functions(std::vector<std::string>& missing) {
    const auto load = [&](auto& function, const char* name) {
        using Function = std::remove_reference_t<decltype(function)>;
        function = reinterpret_cast<Function>(functions_.vkGetDeviceProcAddr(host_.device, name));
        if (function == nullptr) {  // of an extension that became part of the core
            const std::string alias = std::string(name) + "KHR";
            function = reinterpret_cast<Function>(
                functions_.vkGetDeviceProcAddr(host_.device, alias.c_str()));
        }
        if (function == nullptr) {
            missing.push_back(std::string("entry point ") + name +
                              ": vkGetDeviceProcAddr does not know it");
        }
    };
#define NEARFIELD_LOAD(name) load(functions_.name, #name);
    NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_LOAD)
    if (host_.completion_by_timeline) {
        NEARFIELD_SEMAPHORE_FUNCTIONS(NEARFIELD_LOAD)
    }
#undef NEARFIELD_LOAD
}

bool Device::is_usable_type(std::uint32_t type, std::uint32_t allowed,
                            VkMemoryPropertyFlags required) const {
    // Memory types with any other property (protected, AMD's coherent and uncached types, ...) may
    // only be allocated with a feature enabled, and nothing is enabled.
    constexpr VkMemoryPropertyFlags usable =
        VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
        VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT |
        VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT;
    const VkMemoryPropertyFlags flags = memory_flags(type);
    return ((allowed >> type) & 1U) != 0 && (flags & required) == required &&
           (flags & ~usable) == 0;
}

bool Device::has_memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required) const {
    std::uint32_t type = 0;
    while (type < memory_.memoryTypeCount && !is_usable_type(type, allowed, required)) {
        ++type;
    }
    return type < memory_.memoryTypeCount;
}

std::uint32_t Device::usable_types(std::uint32_t allowed, VkMemoryPropertyFlags required) const {
    std::uint32_t usable = 0;
    for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
        usable |= is_usable_type(type, allowed, required) ? 1U << type : 0U;
    }
    if (usable == 0) {
        throw StatusException(
            Status(StatusCode::device_error, "device '" + name_ +
                                                 "' has no memory type with property flags " +
                                                 std::to_string(required) + " among the types " +
                                                 std::to_string(allowed) + " (bit mask)"));
    }
    return usable;
}

std::uint32_t Device::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags preferred) const {
    const std::uint32_t usable = usable_types(allowed, required);
    std::uint32_t best = 0;
    int best_score = -1;
    for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
        const int score = std::popcount(memory_flags(type) & preferred);
        if (((usable >> type) & 1U) != 0 && score > best_score) {
            best = type;
            best_score = score;
        }
    }
    return best;
}

VkResult Device::submit(const VkSubmitInfo& info, VkFence fence) const {
    const QueueAccess& access = host_.queue_access;
    if (access.submit != nullptr) {
        return access.submit(access.user, 1, &info, fence);
    }
    if (host_.queue == VK_NULL_HANDLE) {
        throw StatusException({StatusCode::invalid_submission,
                               "HostDevice::queue is null: the library has no queue to submit to; "
                               "record what the device is to do, or use Technique::cpu"});
    }
    if (access.lock != nullptr) {
        access.lock(access.user);
    }
    const VkResult result = functions_.vkQueueSubmit(host_.queue, 1, &info, fence);
    if (access.unlock != nullptr) {
        access.unlock(access.user);
    }
    return result;
}

VkMemoryPropertyFlags Device::memory_flags(std::uint32_t type) const {
    return memory_.memoryTypes[type].propertyFlags;
}

void Device::set_name(VkObjectType type, std::uint64_t object, const std::string& name) const {
    if (functions_.vkSetDebugUtilsObjectNameEXT == nullptr) {
        return;
    }
    const VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             nullptr, type, object, name.c_str()};
    check(functions_.vkSetDebugUtilsObjectNameEXT(host_.device, &info),
          "vkSetDebugUtilsObjectNameEXT", name);
}

void Device::begin_label(VkCommandBuffer commands, const char* name) const {
    if (functions_.vkCmdBeginDebugUtilsLabelEXT != nullptr) {
        const VkDebugUtilsLabelEXT label{
            VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name, {0.0F, 0.0F, 0.0F, 0.0F}};
        functions_.vkCmdBeginDebugUtilsLabelEXT(commands, &label);
    }
}

void Device::end_label(VkCommandBuffer commands) const {
    if (functions_.vkCmdEndDebugUtilsLabelEXT != nullptr) {
        functions_.vkCmdEndDebugUtilsLabelEXT(commands);
    }
}

}  // namespace nearfield::gpu
