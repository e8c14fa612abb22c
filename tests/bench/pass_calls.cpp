#include <tests/bench/pass_calls.hpp>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <map>
#include <utility>

namespace nearfield::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// Arguments of a dispatch, in a buffer.
struct Indirect {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
};
struct Pass {
    PassCalls calls;
    std::vector<Indirect> indirect;
    std::map<std::pair<VkBuffer, VkDeviceSize>, VkDeviceSize> bound;  // ranges
    Clock::time_point start;
};
struct Place {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
};
struct Mapped {
    std::byte* data = nullptr;
    VkDeviceSize offset = 0;
};

// Entry points carry no user data, so this is global.
std::vector<Pass> passes;
bool is_in_pass = false;
std::map<VkBuffer, Place> places;
std::map<VkDeviceMemory, Mapped> mapped;
std::map<VkDeviceMemory, VkDevice> mappable;  // and its device
VkPhysicalDeviceMemoryProperties memory_properties;
std::map<VkDescriptorSet, std::map<std::uint32_t, VkDescriptorBufferInfo>> sets;  // by binding

/// The driver's own entry point with this name.
template <class Function>
Function below(const char* name) {
    return reinterpret_cast<Function>(test_support::true_device_function(name));
}

void VKAPI_CALL reset(VkCommandBuffer commands, VkQueryPool pool, std::uint32_t first,
                      std::uint32_t count) {
    passes.clear();
    static const auto next = below<PFN_vkCmdResetQueryPool>("vkCmdResetQueryPool");
    next(commands, pool, first, count);
}
void VKAPI_CALL timestamp(VkCommandBuffer commands, VkPipelineStageFlagBits stage, VkQueryPool pool,
                          std::uint32_t query) {
    static const auto next = below<PFN_vkCmdWriteTimestamp>("vkCmdWriteTimestamp");
    next(commands, stage, pool, query);
    is_in_pass = query % 2 == 0;
    if (is_in_pass) {
        passes.emplace_back().start = Clock::now();
    } else {
        Pass& pass = passes.back();
        pass.calls.microseconds =
            std::chrono::duration<double, std::micro>(Clock::now() - pass.start).count();
    }
}
void VKAPI_CALL dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y,
                         std::uint32_t z) {
    ++passes.back().calls.dispatches;
    passes.back().calls.workgroups += std::uint64_t{x} * y * z;
    static const auto next = below<PFN_vkCmdDispatch>("vkCmdDispatch");
    next(commands, x, y, z);
}
void VKAPI_CALL dispatch_indirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
    ++passes.back().calls.dispatches;
    passes.back().indirect.push_back({buffer, offset});
    static const auto next = below<PFN_vkCmdDispatchIndirect>("vkCmdDispatchIndirect");
    next(commands, buffer, offset);
}
void VKAPI_CALL barrier(VkCommandBuffer commands, VkPipelineStageFlags from,
                        VkPipelineStageFlags to, VkDependencyFlags flags,
                        std::uint32_t memory_count, const VkMemoryBarrier* memory,
                        std::uint32_t buffer_count, const VkBufferMemoryBarrier* buffers,
                        std::uint32_t image_count, const VkImageMemoryBarrier* images) {
    if (is_in_pass) {
        ++passes.back().calls.barriers;
    }
    static const auto next = below<PFN_vkCmdPipelineBarrier>("vkCmdPipelineBarrier");
    next(commands, from, to, flags, memory_count, memory, buffer_count, buffers, image_count,
         images);
}
void VKAPI_CALL bind_sets(VkCommandBuffer commands, VkPipelineBindPoint point,
                          VkPipelineLayout layout, std::uint32_t first, std::uint32_t count,
                          const VkDescriptorSet* bound, std::uint32_t offset_count,
                          const std::uint32_t* offsets) {
    for (std::uint32_t i = 0; i < count && is_in_pass; ++i) {
        for (const auto& [binding, info] : sets[bound[i]]) {
            passes.back().bound[{info.buffer, info.offset}] = info.range;
        }
    }
    static const auto next = below<PFN_vkCmdBindDescriptorSets>("vkCmdBindDescriptorSets");
    next(commands, point, layout, first, count, bound, offset_count, offsets);
}
void VKAPI_CALL update_sets(VkDevice device, std::uint32_t count,
                            const VkWriteDescriptorSet* writes, std::uint32_t copy_count,
                            const VkCopyDescriptorSet* copies) {
    for (std::uint32_t i = 0; i < count; ++i) {
        if (writes[i].pBufferInfo != nullptr) {
            sets[writes[i].dstSet][writes[i].dstBinding] = writes[i].pBufferInfo[0];
        }
    }
    static const auto next = below<PFN_vkUpdateDescriptorSets>("vkUpdateDescriptorSets");
    next(device, count, writes, copy_count, copies);
}
VkResult VKAPI_CALL bind_memory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                VkDeviceSize offset) {
    places[buffer] = {memory, offset};
    static const auto next = below<PFN_vkBindBufferMemory>("vkBindBufferMemory");
    return next(device, buffer, memory, offset);
}
VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                    const VkAllocationCallbacks* callbacks,
                                    VkDeviceMemory* memory) {
    static const auto next = below<PFN_vkAllocateMemory>("vkAllocateMemory");
    const VkResult result = next(device, info, callbacks, memory);
    const VkMemoryPropertyFlags flags =
        memory_properties.memoryTypes[info->memoryTypeIndex].propertyFlags;
    mapped.erase(*memory);
    mappable.erase(*memory);
    if (result == VK_SUCCESS && (flags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0) {
        mappable[*memory] = device;
    }
    return result;
}
VkResult VKAPI_CALL map_memory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                               VkDeviceSize size, VkMemoryMapFlags flags, void** data) {
    static const auto next = below<PFN_vkMapMemory>("vkMapMemory");
    const VkResult result = next(device, memory, offset, size, flags, data);
    mapped[memory] = {static_cast<std::byte*>(*data), offset};
    return result;
}

template <class Function>
PFN_vkVoidFunction erased(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

/// Maps memory that the library leaves to the device.
Mapped mapped_by_all_means(VkDeviceMemory memory) {
    const auto found = mappable.find(memory);
    if (mapped[memory].data == nullptr && found != mappable.end()) {
        void* data = nullptr;
        static_cast<void>(map_memory(found->second, memory, 0, VK_WHOLE_SIZE, 0, &data));
    }
    return mapped[memory];
}

/// Workgroups in three dimensions, and the number that was counted.
void add_counted(const Indirect& one, PassCalls& calls) {
    const Place& place = places.at(one.buffer);
    const Mapped memory = mapped_by_all_means(place.memory);
    if (memory.data == nullptr) {
        return;
    }
    std::uint32_t words[4];
    std::memcpy(words, memory.data + (place.offset + one.offset - memory.offset), sizeof(words));
    calls.workgroups += std::uint64_t{words[0]} * words[1] * words[2];
    calls.items += words[3];
}

}  // namespace

void count_passes(test_support::Lies& lies) {
    lies.memory = [](VkPhysicalDeviceMemoryProperties& properties) {
        memory_properties = properties;
    };
    lies.entry_points["vkAllocateMemory"] = erased(&allocate_memory);
    lies.entry_points["vkCmdResetQueryPool"] = erased(&reset);
    lies.entry_points["vkCmdWriteTimestamp"] = erased(&timestamp);
    lies.entry_points["vkCmdDispatch"] = erased(&dispatch);
    lies.entry_points["vkCmdDispatchIndirect"] = erased(&dispatch_indirect);
    lies.entry_points["vkCmdPipelineBarrier"] = erased(&barrier);
    lies.entry_points["vkCmdBindDescriptorSets"] = erased(&bind_sets);
    lies.entry_points["vkUpdateDescriptorSets"] = erased(&update_sets);
    lies.entry_points["vkBindBufferMemory"] = erased(&bind_memory);
    lies.entry_points["vkMapMemory"] = erased(&map_memory);
}

std::vector<PassCalls> recorded_passes() {
    std::vector<PassCalls> all;
    for (const Pass& pass : passes) {
        PassCalls& calls = all.emplace_back(pass.calls);
        for (const Indirect& one : pass.indirect) {
            add_counted(one, calls);
        }
        for (const auto& [part, range] : pass.bound) {
            calls.megabytes += static_cast<double>(range) / 1e6;
        }
    }
    return all;
}

void print_passes(const char* scene, std::span<const PassCalls> passes_of_scene,
                  std::span<const PassTime> times) {
    for (std::size_t i = 0; i < passes_of_scene.size() && i < times.size(); ++i) {
        const PassCalls& calls = passes_of_scene[i];
        std::printf("| %s | %s | %u | %llu | %llu | %u | %.2f | %.1f | %.3f |\n", scene,
                    times[i].name.c_str(), calls.dispatches,
                    static_cast<unsigned long long>(calls.workgroups),
                    static_cast<unsigned long long>(calls.items), calls.barriers, calls.megabytes,
                    calls.microseconds, times[i].milliseconds);
    }
}

}  // namespace nearfield::bench
