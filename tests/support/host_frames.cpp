#include <tests/support/host_frames.hpp>

#include <stdexcept>
#include <string>

namespace nearfield::test_support {
namespace {

void require_success(VkResult result, const char* call) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string("host frames: ") + call + " failed with VkResult " +
                                 std::to_string(result));
    }
}

}  // namespace

#define NEARFIELD_HOST_CALL(name) host_function<PFN_##name>(host_, #name)

HostFrames::HostFrames(const HostDevice& host, std::uint32_t count) : host_(host), frames_(count) {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = host.queue_family;
    require_success(NEARFIELD_HOST_CALL(vkCreateCommandPool)(host_.device, &pool, nullptr, &pool_),
                    "vkCreateCommandPool");
    for (Frame& frame : frames_) {
        VkCommandBufferAllocateInfo commands{};
        commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        commands.commandPool = pool_;
        commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        commands.commandBufferCount = 1;
        require_success(
            NEARFIELD_HOST_CALL(vkAllocateCommandBuffers)(host_.device, &commands, &frame.commands),
            "vkAllocateCommandBuffers");
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
        require_success(
            NEARFIELD_HOST_CALL(vkCreateFence)(host_.device, &fence, nullptr, &frame.fence),
            "vkCreateFence");
    }
}

HostFrames::~HostFrames() {
    for (const Frame& frame : frames_) {
        NEARFIELD_HOST_CALL(vkWaitForFences)
        (host_.device, 1, &frame.fence, VK_TRUE, UINT64_MAX);
        NEARFIELD_HOST_CALL(vkDestroyFence)(host_.device, frame.fence, nullptr);
    }
    NEARFIELD_HOST_CALL(vkDestroyCommandPool)(host_.device, pool_, nullptr);
}

VkCommandBuffer HostFrames::begin(std::uint64_t frame) {
    wait(frame);
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    require_success(NEARFIELD_HOST_CALL(vkBeginCommandBuffer)(at(frame).commands, &info),
                    "vkBeginCommandBuffer");
    return at(frame).commands;
}

void HostFrames::submit(std::uint64_t frame) {
    abandon(frame);
    require_success(NEARFIELD_HOST_CALL(vkResetFences)(host_.device, 1, &at(frame).fence),
                    "vkResetFences");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &at(frame).commands;
    require_success(NEARFIELD_HOST_CALL(vkQueueSubmit)(host_.queue, 1, &info, at(frame).fence),
                    "vkQueueSubmit");
}

void HostFrames::abandon(std::uint64_t frame) {
    require_success(NEARFIELD_HOST_CALL(vkEndCommandBuffer)(at(frame).commands),
                    "vkEndCommandBuffer");
}

void HostFrames::wait(std::uint64_t frame) {
    require_success(NEARFIELD_HOST_CALL(vkWaitForFences)(host_.device, 1, &at(frame).fence, VK_TRUE,
                                                         UINT64_MAX),
                    "vkWaitForFences");
}

namespace {

/// Begins a primary or secondary command buffer.
void begin_outside_passes(const HostDevice& host, VkCommandBuffer commands,
                          VkCommandBufferUsageFlags flags) {
    VkCommandBufferInheritanceInfo outside{};
    outside.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO;
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = flags;
    info.pInheritanceInfo = &outside;
    require_success(
        host_function<PFN_vkBeginCommandBuffer>(host, "vkBeginCommandBuffer")(commands, &info),
        "vkBeginCommandBuffer");
}

}  // namespace

KeptCommands::KeptCommands(const HostDevice& host) : host_(host) {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.queueFamilyIndex = host.queue_family;
    require_success(NEARFIELD_HOST_CALL(vkCreateCommandPool)(host_.device, &pool, nullptr, &pool_),
                    "vkCreateCommandPool");
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    require_success(NEARFIELD_HOST_CALL(vkCreateFence)(host_.device, &fence, nullptr, &fence_),
                    "vkCreateFence");
}

KeptCommands::~KeptCommands() {
    NEARFIELD_HOST_CALL(vkDestroyFence)(host_.device, fence_, nullptr);
    NEARFIELD_HOST_CALL(vkDestroyCommandPool)(host_.device, pool_, nullptr);
}

VkCommandBuffer KeptCommands::begin(VkCommandBufferLevel level) const {
    VkCommandBufferAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = pool_;
    allocation.level = level;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    require_success(
        NEARFIELD_HOST_CALL(vkAllocateCommandBuffers)(host_.device, &allocation, &commands),
        "vkAllocateCommandBuffers");
    begin_outside_passes(host_, commands, VK_COMMAND_BUFFER_USAGE_SIMULTANEOUS_USE_BIT);
    return commands;
}

void KeptCommands::end(VkCommandBuffer commands) const {
    require_success(NEARFIELD_HOST_CALL(vkEndCommandBuffer)(commands), "vkEndCommandBuffer");
}

void KeptCommands::execute(VkCommandBuffer primary, VkCommandBuffer secondary) const {
    NEARFIELD_HOST_CALL(vkCmdExecuteCommands)(primary, 1, &secondary);
}

void KeptCommands::run(std::span<const VkCommandBuffer> commands) const {
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = static_cast<std::uint32_t>(commands.size());
    info.pCommandBuffers = commands.data();
    require_success(NEARFIELD_HOST_CALL(vkQueueSubmit)(host_.queue, 1, &info, fence_),
                    "vkQueueSubmit");
    require_success(
        NEARFIELD_HOST_CALL(vkWaitForFences)(host_.device, 1, &fence_, VK_TRUE, UINT64_MAX),
        "vkWaitForFences");
    require_success(NEARFIELD_HOST_CALL(vkResetFences)(host_.device, 1, &fence_), "vkResetFences");
}

SecondaryCommands::SecondaryCommands(const HostDevice& host) : host_(host) {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.queueFamilyIndex = host.queue_family;
    require_success(NEARFIELD_HOST_CALL(vkCreateCommandPool)(host_.device, &pool, nullptr, &pool_),
                    "vkCreateCommandPool");
    VkCommandBufferAllocateInfo commands{};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands.commandPool = pool_;
    commands.level = VK_COMMAND_BUFFER_LEVEL_SECONDARY;
    commands.commandBufferCount = 1;
    require_success(
        NEARFIELD_HOST_CALL(vkAllocateCommandBuffers)(host_.device, &commands, &commands_),
        "vkAllocateCommandBuffers");
}

SecondaryCommands::~SecondaryCommands() {
    NEARFIELD_HOST_CALL(vkDestroyCommandPool)(host_.device, pool_, nullptr);
}

VkCommandBuffer SecondaryCommands::begin() const {
    begin_outside_passes(host_, commands_, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT);
    return commands_;
}

void SecondaryCommands::execute_in(VkCommandBuffer primary) const {
    require_success(NEARFIELD_HOST_CALL(vkEndCommandBuffer)(commands_), "vkEndCommandBuffer");
    NEARFIELD_HOST_CALL(vkCmdExecuteCommands)(primary, 1, &commands_);
}

#undef NEARFIELD_HOST_CALL

}  // namespace nearfield::test_support
