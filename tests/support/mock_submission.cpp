#include <tests/support/mock_entry.hpp>

#include <algorithm>
#include <cstring>
#include <span>

namespace nearfield::test_support::mock {

VkResult perform(Tag_vkCreateFence tag, VkDevice device, const VkFenceCreateInfo* info,
                 const VkAllocationCallbacks*, VkFence* fence) {
    *fence = driver().make<VkFence>(tag.name, number(device));
    driver().find(tag.name, *fence)->signalled = (info->flags & VK_FENCE_CREATE_SIGNALED_BIT) != 0;
    return VK_SUCCESS;
}

VkResult perform(Tag_vkResetFences tag, VkDevice, std::uint32_t count, const VkFence* fences) {
    for (std::uint32_t i = 0; i < count; ++i) {
        if (MockObject* const fence = driver().find(tag.name, fences[i])) {
            if (!fence->in_use.empty()) {
                driver().breach(tag.name, "a fence of a submission that is not done");
            }
            fence->signalled = false;
        }
    }
    return VK_SUCCESS;
}

namespace {

using Semaphore = MockDriver::Submitted::Semaphore;

/// A binary semaphore to wait for must be signalled, and one to signal must not be; a timeline
/// semaphore must have at least the value to wait for, and less than the value to signal.
void pass(std::string_view call, const Semaphore& passed, bool signalled) {
    MockObject* const object = driver().find(call, passed.semaphore);
    if (object == nullptr) {
        return;
    }
    if (object->value) {
        if (signalled ? passed.value <= *object->value : passed.value > *object->value) {
            driver().breach(call, signalled ? "a value that the semaphore has already"
                                            : "a value that nothing will ever signal");
        }
        object->value = std::max(*object->value, passed.value);
        return;
    }
    if (object->signalled == signalled) {
        driver().breach(call, signalled ? "a semaphore that is signalled already"
                                        : "a semaphore that nothing will ever signal");
    }
    object->signalled = signalled;
}

/// Semaphore `i` of a list, with its value, which a timeline semaphore must have.
Semaphore with_value(std::string_view call, const VkSemaphore* semaphores, std::uint32_t i,
                     std::uint32_t values, const std::uint64_t* value) {
    const MockObject* const object = driver().find(call, semaphores[i]);
    if (object != nullptr && object->value && i >= values) {
        driver().breach(call, "a timeline semaphore without a value");
    }
    return {semaphores[i], i < values ? value[i] : 0, 0};
}

/// The submitted values of timeline semaphores; empty if there are none.
VkTimelineSemaphoreSubmitInfo values_of(std::string_view call, const VkSubmitInfo& info) {
    VkTimelineSemaphoreSubmitInfo values{};
    if (info.pNext == nullptr) {
        return values;
    }
    values = *static_cast<const VkTimelineSemaphoreSubmitInfo*>(info.pNext);
    if (values.sType != VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO ||
        !driver().timeline_semaphores) {
        driver().breach(call, "a structure that the host did not enable");
    }
    if (values.waitSemaphoreValueCount != info.waitSemaphoreCount ||
        values.signalSemaphoreValueCount != info.signalSemaphoreCount) {
        driver().breach(call, "as many values as semaphores are wanted");
    }
    return values;
}

MockDriver::Submitted read(std::string_view call, const VkSubmitInfo& info) {
    const VkTimelineSemaphoreSubmitInfo values = values_of(call, info);
    MockDriver::Submitted submitted;
    submitted.command_buffers = info.commandBufferCount;
    for (std::uint32_t i = 0; i < info.waitSemaphoreCount; ++i) {
        submitted.waits.push_back(with_value(call, info.pWaitSemaphores, i,
                                             values.waitSemaphoreValueCount,
                                             values.pWaitSemaphoreValues));
        submitted.waits.back().stages = info.pWaitDstStageMask[i];
    }
    for (std::uint32_t i = 0; i < info.signalSemaphoreCount; ++i) {
        submitted.signals.push_back(with_value(call, info.pSignalSemaphores, i,
                                               values.signalSemaphoreValueCount,
                                               values.pSignalSemaphoreValues));
    }
    return submitted;
}

}  // namespace

VkResult perform(Tag_vkQueueSubmit tag, VkQueue queue, std::uint32_t count,
                 const VkSubmitInfo* infos, VkFence fence) {
    if (number(queue) != driver().queue) {
        driver().breach(tag.name, "another queue");
    }
    std::set<Number> used;
    for (const VkSubmitInfo& info : std::span(infos, count)) {
        const MockDriver::Submitted& submitted =
            driver().submissions.emplace_back(read(tag.name, info));
        for (const Semaphore& wait : submitted.waits) {
            pass(tag.name, wait, false);
        }
        for (std::uint32_t i = 0; i < info.commandBufferCount; ++i) {
            driver().execute(tag.name, number(info.pCommandBuffers[i]), used);
        }
        for (const Semaphore& signal : submitted.signals) {
            pass(tag.name, signal, true);
        }
    }
    if (fence == VK_NULL_HANDLE) {
        if (!used.empty()) {
            driver().breach(tag.name, "commands, and no fence to say when they are done");
        }
        return VK_SUCCESS;
    }
    MockObject& signalled = *driver().find(tag.name, fence);
    if (signalled.signalled) {
        driver().breach(tag.name, "a fence that is signalled");
    }
    signalled.in_use = std::move(used);
    signalled.signalled = true;
    return VK_SUCCESS;
}

VkResult perform(Tag_vkWaitForFences tag, VkDevice, std::uint32_t count, const VkFence* fences,
                 VkBool32, std::uint64_t) {
    for (std::uint32_t i = 0; i < count; ++i) {
        if (MockObject* const fence = driver().find(tag.name, fences[i])) {
            if (!fence->signalled) {
                driver().breach(tag.name, "a fence that nothing will ever signal");
            }
            driver().finish(*fence);
        }
    }
    return VK_SUCCESS;
}

VkResult perform(Tag_vkGetFenceStatus tag, VkDevice, VkFence fence) {
    MockObject& object = *driver().find(tag.name, fence);
    driver().finish(object);
    return object.signalled ? VK_SUCCESS : VK_NOT_READY;
}

VkResult perform(Tag_vkGetQueryPoolResults tag, VkDevice, VkQueryPool pool, std::uint32_t,
                 std::uint32_t, std::size_t bytes, void* data, VkDeviceSize, VkQueryResultFlags) {
    driver().find(tag.name, pool);
    std::memset(data, 0, bytes);
    return VK_SUCCESS;
}

}  // namespace nearfield::test_support::mock
