#include <engine/base/status_exception.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/headless.hpp>

#include <algorithm>
#include <string>

namespace nearfield::gpu {
namespace {

int rank(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 0;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 1;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return 3;
        default:
            return 4;
    }
}

// The devices whose name contains `wanted`, ranked by kind, best first.
std::vector<Candidate> ranked_candidates(const Instance& instance, const std::string& wanted) {
    std::vector<Candidate> candidates = instance.candidates();
    if (candidates.empty()) {
        throw StatusException(
            Status(StatusCode::no_device,
                   "the installed Vulkan drivers have no device; install one that needs "
                   "no graphics card (package mesa-vulkan-drivers)"));
    }
    std::vector<std::string> names;
    names.reserve(candidates.size());
    for (const Candidate& candidate : candidates) {
        names.push_back(std::string("there is '") + candidate.properties.deviceName + "'");
    }
    std::erase_if(candidates, [&wanted](const Candidate& candidate) {
        return std::string_view(candidate.properties.deviceName).find(wanted) ==
               std::string_view::npos;
    });
    if (candidates.empty()) {
        throw StatusException(Status(StatusCode::no_device,
                                     "no Vulkan device has a name with '" + wanted + "' in it",
                                     std::move(names)));
    }
    std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return rank(a.properties.deviceType) < rank(b.properties.deviceType);
    });
    return candidates;
}

void append_reasons(const Candidate& candidate, std::vector<std::string>& reasons) {
    for (const std::string& missing : candidate.requirements.unmet) {
        reasons.push_back(std::string(candidate.properties.deviceName).append(": ") + missing);
    }
}

VkResult create_device(const Instance& instance, const Candidate& candidate, VkDevice& device) {
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = *candidate.requirements.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &candidate.requirements.features;
    return instance.function<PFN_vkCreateDevice>("vkCreateDevice")(candidate.handle, &info, nullptr,
                                                                   &device);
}

}  // namespace

HeadlessDevice::HeadlessDevice(const HeadlessOptions& options) {
    const std::string wanted = options.device_name != nullptr ? options.device_name : "";
    destroy_ = instance_.function<PFN_vkDestroyDevice>("vkDestroyDevice");
    const auto get_queue = instance_.function<PFN_vkGetDeviceQueue>("vkGetDeviceQueue");
    std::vector<std::string> reasons;
    for (const Candidate& candidate : ranked_candidates(instance_, wanted)) {
        if (!candidate.requirements.met()) {
            append_reasons(candidate, reasons);
            continue;
        }
        const VkResult result = create_device(instance_, candidate, host_.device);
        if (result < VK_SUCCESS) {
            reasons.push_back(std::string(candidate.properties.deviceName) +
                              ": vkCreateDevice failed with " + to_string(result));
            continue;
        }
        host_.instance = instance_.handle();
        host_.physical_device = candidate.handle;
        host_.queue_family = *candidate.requirements.queue_family;
        host_.get_instance_proc_addr = instance_.get_instance_proc_addr();
        host_.debug_utils = instance_.debug_utils();
        host_.log = options.log;
        host_.logic_op = candidate.support.logic_op;
        get_queue(host_.device, host_.queue_family, 0, &host_.queue);
        return;
    }
    throw StatusException(
        Status(StatusCode::unsupported_device,
               "no Vulkan device can be used; each reason names a device and what it "
               "lacks",
               std::move(reasons)));
}

HeadlessDevice::~HeadlessDevice() {
    destroy_(host_.device, nullptr);
}

}  // namespace nearfield::gpu
