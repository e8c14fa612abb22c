// A host with its own Vulkan device: nearfield records a batch into the host's command buffer, the
// host submits it with its frame, and reads the answer when the frame is complete.
#include <nearfield/vulkan.hpp>

#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        std::printf("%s: VkResult %d\n", call, static_cast<int>(result));
        std::exit(1);
    }
}

void check(const nearfield::Status& status) {
    if (!status.ok()) {
        std::printf("%s\n", status.text().c_str());
        std::exit(1);
    }
}

VkInstance make_instance() {
    VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    VkInstance instance{};
    check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
    return instance;
}

// Selects the first physical device that meets nearfield's requirements, and a queue family.
void choose_device(nearfield::HostDevice& host) {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(host.instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(host.instance, &count, devices.data()),
          "vkEnumeratePhysicalDevices");
    for (const VkPhysicalDevice device : devices) {
        nearfield::PhysicalDevice candidate;
        candidate.instance = host.instance;
        candidate.physical_device = device;
        candidate.get_instance_proc_addr = vkGetInstanceProcAddr;
        const auto requirements = nearfield::requirements(candidate);
        if (requirements && requirements->met()) {
            host.physical_device = device;
            host.queue_family = *requirements->queue_family;
            return;
        }
    }
    std::printf("no device meets the requirements; `nearfield info` says what is missing\n");
    std::exit(1);
}

// Makes the device without features and extensions: nearfield needs none.
void make_device(nearfield::HostDevice& host) {
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = host.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    check(vkCreateDevice(host.physical_device, &info, nullptr, &host.device), "vkCreateDevice");
    vkGetDeviceQueue(host.device, host.queue_family, 0, &host.queue);
}

VkCommandBuffer make_command_buffer(const nearfield::HostDevice& host, VkCommandPool& pool) {
    VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_info.queueFamilyIndex = host.queue_family;
    check(vkCreateCommandPool(host.device, &pool_info, nullptr, &pool), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkCommandBuffer commands{};
    check(vkAllocateCommandBuffers(host.device, &info, &commands), "vkAllocateCommandBuffers");
    return commands;
}

// One frame of the host, with nearfield's commands among its own.
void run_frame(nearfield::Context& context, const nearfield::HostDevice& host,
               VkCommandBuffer commands, VkFence fence, const nearfield::PenetrationQuery& query) {
    const std::uint64_t frame = 0;  // the host's own number
    nearfield::Batch batch;
    const auto penetration = batch.add(query);

    VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    const auto ticket = context.record(batch, {.commands = commands, .frame = frame});
    check(ticket.error());
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");

    VkSubmitInfo submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(host.queue, 1, &submit, fence), "vkQueueSubmit");
    // A real host continues with the next frames and learns later that this one is complete.
    check(vkWaitForFences(host.device, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    context.frame_completed(frame);

    nearfield::Results results;
    check(context.collect(*ticket, results));
    check(results[penetration].status);
    std::printf("%s: %u points inside, the deepest by %g\n", context.device_name().c_str(),
                results[penetration].count, results[penetration].deepest.depth);
}

}  // namespace

int main() {
    nearfield::HostDevice host;
    host.get_instance_proc_addr = vkGetInstanceProcAddr;
    host.instance = make_instance();
    choose_device(host);
    make_device(host);
    VkCommandPool pool{};
    const VkCommandBuffer commands = make_command_buffer(host, pool);
    const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence{};
    check(vkCreateFence(host.device, &fence_info, nullptr, &fence), "vkCreateFence");
    {
        auto context = nearfield::Context::create(host);
        check(context.error());
        const nearfield::Ring square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
        const auto shape = context->add_shape({&square, 1});
        check(shape.error());
        run_frame(*context, host, commands, fence,
                  {.a = {*shape, {}},
                   .b = {*shape, {.translation = {1, 0.5}}},
                   .tolerance = 0.05,
                   .technique = nearfield::Technique::compute});
    }
    vkDestroyFence(host.device, fence, nullptr);
    vkDestroyCommandPool(host.device, pool, nullptr);
    vkDestroyDevice(host.device, nullptr);
    vkDestroyInstance(host.instance, nullptr);
}
