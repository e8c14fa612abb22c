#include <engine/base/status_exception.hpp>
#include <engine/gpu/submission.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>

namespace nearfield::gpu {

void check_semaphores(const Device& device, const nearfield::Submission& order) {
    const auto refuse_if = [](bool wrong, const char* list, std::size_t i, const char* why) {
        if (wrong) {
            throw StatusException(
                {StatusCode::invalid_submission,
                 std::string("Submission::") + list + '[' + std::to_string(i) + ']' + why});
        }
    };
    constexpr const char* null = ".semaphore is null";
    constexpr const char* value =
        ".value is that of a timeline semaphore, and the host did not say that it enabled them "
        "(HostDevice::timeline_semaphore)";
    for (std::size_t i = 0; i < order.waits.size(); ++i) {
        const SemaphoreWait& wait = order.waits[i];
        refuse_if(wait.semaphore == VK_NULL_HANDLE, "waits", i, null);
        refuse_if(wait.stages == 0, "waits", i, ".stages is 0; at least one stage has to wait");
        refuse_if(wait.value != 0 && !device.timeline_semaphore(), "waits", i, value);
    }
    for (std::size_t i = 0; i < order.signals.size(); ++i) {
        const SemaphoreSignal& signal = order.signals[i];
        refuse_if(signal.semaphore == VK_NULL_HANDLE, "signals", i, null);
        refuse_if(signal.value != 0 && !device.timeline_semaphore(), "signals", i, value);
    }
}

Submission::Submission(const Device& device) : device_(&device), completion_(device) {
    const Functions& functions = device.functions();
    VkCommandPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool_info.queueFamilyIndex = device.queue_family();
    pool_ = make_object(device, pool_info, "a submission", "nearfield command pool");

    VkCommandBufferAllocateInfo commands_info{};
    commands_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands_info.commandPool = pool_.get();
    commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands_info.commandBufferCount = 1;
    check(functions.vkAllocateCommandBuffers(device.handle(), &commands_info, &commands_),
          "vkAllocateCommandBuffers", "a submission");
    device.name_object(VK_OBJECT_TYPE_COMMAND_BUFFER, commands_, "nearfield commands");
}

VkCommandBuffer Submission::begin(bool again) {
    const Functions& functions = device_->functions();
    check(functions.vkResetCommandPool(device_->handle(), pool_.get(), 0), "vkResetCommandPool",
          "a submission");
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    if (!again) {
        info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    }
    check(functions.vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer", "a submission");
    return commands_;
}

void Submission::submit(const nearfield::Submission& order) {
    const Functions& functions = device_->functions();
    check(functions.vkEndCommandBuffer(commands_), "vkEndCommandBuffer", "a submission");
    send_commands(order);
}

void Submission::submit_again() {
    send_commands({});
}

void Submission::send_commands(const nearfield::Submission& order) {
    completion_.begin();
    take(order);
    if (const VkSemaphore semaphore = completion_.semaphore(); semaphore != VK_NULL_HANDLE) {
        signals_.push_back(semaphore);
        signal_values_.push_back(completion_.value());
    }
    send(1, completion_.fence());
}

void Submission::submit_semaphores(const nearfield::Submission& order) {
    if (!order.waits.empty() || !order.signals.empty()) {
        take(order);
        send(0, VK_NULL_HANDLE);
    }
}

void Submission::take(const nearfield::Submission& order) {
    waits_.clear();
    wait_stages_.clear();
    wait_values_.clear();
    for (const SemaphoreWait& wait : order.waits) {
        waits_.push_back(wait.semaphore);
        wait_stages_.push_back(wait.stages);
        wait_values_.push_back(wait.value);
    }
    signals_.clear();
    signal_values_.clear();
    for (const SemaphoreSignal& signal : order.signals) {
        signals_.push_back(signal.semaphore);
        signal_values_.push_back(signal.value);
    }
}

void Submission::send(std::uint32_t command_buffers, VkFence fence) {
    VkTimelineSemaphoreSubmitInfo values{};
    values.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
    values.waitSemaphoreValueCount = static_cast<std::uint32_t>(wait_values_.size());
    values.pWaitSemaphoreValues = wait_values_.data();
    values.signalSemaphoreValueCount = static_cast<std::uint32_t>(signal_values_.size());
    values.pSignalSemaphoreValues = signal_values_.data();
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.pNext = device_->timeline_semaphore() ? &values : nullptr;
    info.waitSemaphoreCount = static_cast<std::uint32_t>(waits_.size());
    info.pWaitSemaphores = waits_.data();
    info.pWaitDstStageMask = wait_stages_.data();
    info.commandBufferCount = command_buffers;
    info.pCommandBuffers = &commands_;
    info.signalSemaphoreCount = static_cast<std::uint32_t>(signals_.size());
    info.pSignalSemaphores = signals_.data();
    check(device_->submit(info, fence), "vkQueueSubmit", "a submission");
}

bool Submission::is_done() const {
    return completion_.status() != VK_NOT_READY;
}

void Submission::wait() {
    check(completion_.wait(), completion_.wait_call(), "a submission");
}

void Submission::wait_to_the_end() noexcept {
    const auto out_of_memory = [](VkResult result) {
        return result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    };
    // A driver without memory for a wait may still answer a status query. If both fail this many
    // times, later attempts will fail, too.
    constexpr int max_refusals = 1000;
    int refusals = 0;
    while (refusals < max_refusals && out_of_memory(completion_.wait())) {
        const VkResult status = completion_.status();
        if (out_of_memory(status)) {
            ++refusals;
        } else if (status != VK_NOT_READY) {
            return;
        }
        std::this_thread::yield();
    }
}

}  // namespace nearfield::gpu
