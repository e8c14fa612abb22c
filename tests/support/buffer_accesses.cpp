#include <tests/support/buffer_accesses.hpp>
#include <tests/support/shader_accesses.hpp>

#include <map>
#include <span>
#include <utility>

namespace nearfield::test_support {
namespace {

struct State {
    using Accesses = std::map<std::uint32_t, ShaderAccess>;

    std::map<VkShaderModule, Accesses> modules;
    std::map<VkPipeline, Accesses> pipelines;
    std::map<std::pair<VkDescriptorSet, std::uint32_t>, BufferRange> bindings;
    std::map<VkBuffer, std::string> names;
    std::map<VkBuffer, VkDeviceSize> sizes;
    std::map<VkCommandBuffer, Recording> recordings;
    std::vector<Recording> ended;
    std::size_t barriers = 0;
};

State state;

template <class Function>
Function driver(const char* name) {
    return reinterpret_cast<Function>(true_device_function(name));
}

// Objects.

VkResult VKAPI_CALL create_module(VkDevice device, const VkShaderModuleCreateInfo* info,
                                  const VkAllocationCallbacks* allocator, VkShaderModule* module) {
    const VkResult result =
        driver<PFN_vkCreateShaderModule>("vkCreateShaderModule")(device, info, allocator, module);
    if (result == VK_SUCCESS) {
        state.modules[*module] = buffer_accesses({info->pCode, info->codeSize / 4});
    }
    return result;
}

void add_stage(VkPipeline pipeline, const VkPipelineShaderStageCreateInfo& stage) {
    for (const auto& [binding, access] : state.modules[stage.module]) {
        ShaderAccess& all = state.pipelines[pipeline][binding];
        all.reads = all.reads || access.reads;
        all.writes = all.writes || access.writes;
    }
}

VkResult VKAPI_CALL create_compute(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                   const VkComputePipelineCreateInfo* infos,
                                   const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
    const VkResult result = driver<PFN_vkCreateComputePipelines>("vkCreateComputePipelines")(
        device, cache, count, infos, allocator, pipelines);
    for (std::uint32_t i = 0; result == VK_SUCCESS && i < count; ++i) {
        state.pipelines[pipelines[i]].clear();
        add_stage(pipelines[i], infos[i].stage);
    }
    return result;
}

VkResult VKAPI_CALL create_graphics(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                    const VkGraphicsPipelineCreateInfo* infos,
                                    const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
    const VkResult result = driver<PFN_vkCreateGraphicsPipelines>("vkCreateGraphicsPipelines")(
        device, cache, count, infos, allocator, pipelines);
    for (std::uint32_t i = 0; result == VK_SUCCESS && i < count; ++i) {
        state.pipelines[pipelines[i]].clear();
        for (std::uint32_t k = 0; k < infos[i].stageCount; ++k) {
            add_stage(pipelines[i], infos[i].pStages[k]);
        }
    }
    return result;
}

VkResult VKAPI_CALL create_buffer(VkDevice device, const VkBufferCreateInfo* info,
                                  const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
    const VkResult result =
        driver<PFN_vkCreateBuffer>("vkCreateBuffer")(device, info, allocator, buffer);
    if (result == VK_SUCCESS) {
        state.sizes[*buffer] = info->size;
    }
    return result;
}

VkResult VKAPI_CALL name_object(VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
    if (info->objectType == VK_OBJECT_TYPE_BUFFER) {
        state.names[reinterpret_cast<VkBuffer>(info->objectHandle)] = info->pObjectName;
    }
    return driver<PFN_vkSetDebugUtilsObjectNameEXT>("vkSetDebugUtilsObjectNameEXT")(device, info);
}

BufferRange range_of(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    return {buffer, offset, size == VK_WHOLE_SIZE ? state.sizes[buffer] : offset + size};
}

void VKAPI_CALL update_sets(VkDevice device, std::uint32_t count,
                            const VkWriteDescriptorSet* writes, std::uint32_t copy_count,
                            const VkCopyDescriptorSet* copies) {
    for (const VkWriteDescriptorSet& write : std::span(writes, count)) {
        if (write.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
            state.bindings[{write.dstSet, write.dstBinding}] = range_of(
                write.pBufferInfo->buffer, write.pBufferInfo->offset, write.pBufferInfo->range);
        }
    }
    driver<PFN_vkUpdateDescriptorSets>("vkUpdateDescriptorSets")(device, count, writes, copy_count,
                                                                 copies);
}

// Commands.

void note(Recording& recording, const BufferRange& range, VkPipelineStageFlags stage, bool reads,
          bool writes, VkPipeline pipeline = VK_NULL_HANDLE) {
    VkAccessFlags flags = 0;
    if (stage == VK_PIPELINE_STAGE_TRANSFER_BIT) {
        flags = writes ? VK_ACCESS_TRANSFER_WRITE_BIT : VK_ACCESS_TRANSFER_READ_BIT;
    } else if (stage == VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT) {
        flags = VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    } else {
        flags |= reads ? VK_ACCESS_SHADER_READ_BIT : VK_ACCESS_NONE;
        flags |= writes ? VK_ACCESS_SHADER_WRITE_BIT : VK_ACCESS_NONE;
    }
    recording.commands.emplace_back(BufferAccess{range, stage, flags, writes, pipeline,
                                                 recording.next_command, state.barriers});
}

void note_shaders(Recording& recording, VkPipeline pipeline, VkDescriptorSet set,
                  VkPipelineStageFlags stage) {
    for (const auto& [binding, access] : state.pipelines[pipeline]) {
        const auto bound = state.bindings.find({set, binding});
        if (bound != state.bindings.end() && (access.reads || access.writes)) {
            // The host's input stands in for an output that a push constant turns off.
            const bool writes =
                access.writes && state.names[bound->second.buffer] != "nearfield input";
            note(recording, bound->second, stage, access.reads, writes, pipeline);
        }
    }
}

VkResult VKAPI_CALL begin(VkCommandBuffer commands, const VkCommandBufferBeginInfo* info) {
    state.recordings[commands] = {};
    state.recordings[commands].is_submitted_again =
        (info->flags & VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT) == 0;
    return driver<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands, info);
}

VkResult VKAPI_CALL end(VkCommandBuffer commands) {
    state.ended.push_back(std::move(state.recordings[commands]));
    state.recordings.erase(commands);
    return driver<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(commands);
}

void VKAPI_CALL bind_pipeline(VkCommandBuffer commands, VkPipelineBindPoint point,
                              VkPipeline pipeline) {
    Recording& recording = state.recordings[commands];
    (point == VK_PIPELINE_BIND_POINT_COMPUTE ? recording.compute : recording.graphics) = pipeline;
    driver<PFN_vkCmdBindPipeline>("vkCmdBindPipeline")(commands, point, pipeline);
}

void VKAPI_CALL bind_sets(VkCommandBuffer commands, VkPipelineBindPoint point,
                          VkPipelineLayout layout, std::uint32_t first, std::uint32_t count,
                          const VkDescriptorSet* sets, std::uint32_t offset_count,
                          const std::uint32_t* offsets) {
    Recording& recording = state.recordings[commands];
    (point == VK_PIPELINE_BIND_POINT_COMPUTE ? recording.compute_set : recording.graphics_set) =
        sets[0];
    driver<PFN_vkCmdBindDescriptorSets>("vkCmdBindDescriptorSets")(
        commands, point, layout, first, count, sets, offset_count, offsets);
}

void note_dispatch(VkCommandBuffer commands) {
    Recording& recording = state.recordings[commands];
    note_shaders(recording, recording.compute, recording.compute_set,
                 VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    ++recording.next_command;
}

void VKAPI_CALL dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y,
                         std::uint32_t z) {
    note_dispatch(commands);
    driver<PFN_vkCmdDispatch>("vkCmdDispatch")(commands, x, y, z);
}

void VKAPI_CALL dispatch_indirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
    note(state.recordings[commands], range_of(buffer, offset, sizeof(VkDispatchIndirectCommand)),
         VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, true, false);
    note_dispatch(commands);
    driver<PFN_vkCmdDispatchIndirect>("vkCmdDispatchIndirect")(commands, buffer, offset);
}

void VKAPI_CALL draw(VkCommandBuffer commands, std::uint32_t vertices, std::uint32_t instances,
                     std::uint32_t first_vertex, std::uint32_t first_instance) {
    Recording& recording = state.recordings[commands];
    note_shaders(recording, recording.graphics, recording.graphics_set,
                 VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    ++recording.next_command;
    driver<PFN_vkCmdDraw>("vkCmdDraw")(commands, vertices, instances, first_vertex, first_instance);
}

void VKAPI_CALL fill(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                     VkDeviceSize size, std::uint32_t value) {
    Recording& recording = state.recordings[commands];
    note(recording, range_of(buffer, offset, size), VK_PIPELINE_STAGE_TRANSFER_BIT, false, true);
    ++recording.next_command;
    driver<PFN_vkCmdFillBuffer>("vkCmdFillBuffer")(commands, buffer, offset, size, value);
}

void VKAPI_CALL copy(VkCommandBuffer commands, VkBuffer source, VkBuffer target,
                     std::uint32_t count, const VkBufferCopy* regions) {
    Recording& recording = state.recordings[commands];
    for (const VkBufferCopy& region : std::span(regions, count)) {
        note(recording, range_of(source, region.srcOffset, region.size),
             VK_PIPELINE_STAGE_TRANSFER_BIT, true, false);
        note(recording, range_of(target, region.dstOffset, region.size),
             VK_PIPELINE_STAGE_TRANSFER_BIT, false, true);
    }
    ++recording.next_command;
    driver<PFN_vkCmdCopyBuffer>("vkCmdCopyBuffer")(commands, source, target, count, regions);
}

void VKAPI_CALL copy_queries(VkCommandBuffer commands, VkQueryPool pool, std::uint32_t first,
                             std::uint32_t count, VkBuffer buffer, VkDeviceSize offset,
                             VkDeviceSize stride, VkQueryResultFlags flags) {
    Recording& recording = state.recordings[commands];
    for (std::uint32_t i = 0; i < count; ++i) {
        note(recording, range_of(buffer, offset + i * stride, sizeof(std::uint32_t)),
             VK_PIPELINE_STAGE_TRANSFER_BIT, false, true);
    }
    ++recording.next_command;
    driver<PFN_vkCmdCopyQueryPoolResults>("vkCmdCopyQueryPoolResults")(
        commands, pool, first, count, buffer, offset, stride, flags);
}

void VKAPI_CALL barrier(VkCommandBuffer commands, VkPipelineStageFlags source,
                        VkPipelineStageFlags destination, VkDependencyFlags flags,
                        std::uint32_t memory_count, const VkMemoryBarrier* memory,
                        std::uint32_t buffer_count, const VkBufferMemoryBarrier* buffers,
                        std::uint32_t image_count, const VkImageMemoryBarrier* images) {
    state.recordings[commands].commands.emplace_back(
        RecordedBarrier{source,
                        destination,
                        {memory, memory + memory_count},
                        {buffers, buffers + buffer_count},
                        image_count > 0});
    ++state.barriers;
    driver<PFN_vkCmdPipelineBarrier>("vkCmdPipelineBarrier")(commands, source, destination, flags,
                                                             memory_count, memory, buffer_count,
                                                             buffers, image_count, images);
}

}  // namespace

Lies BufferAccesses::lies() {
    state = {};
    Lies lies;
    lies.entry_points = {{"vkCreateShaderModule", erased(&create_module)},
                         {"vkCreateComputePipelines", erased(&create_compute)},
                         {"vkCreateGraphicsPipelines", erased(&create_graphics)},
                         {"vkCreateBuffer", erased(&create_buffer)},
                         {"vkSetDebugUtilsObjectNameEXT", erased(&name_object)},
                         {"vkUpdateDescriptorSets", erased(&update_sets)},
                         {"vkBeginCommandBuffer", erased(&begin)},
                         {"vkEndCommandBuffer", erased(&end)},
                         {"vkCmdBindPipeline", erased(&bind_pipeline)},
                         {"vkCmdBindDescriptorSets", erased(&bind_sets)},
                         {"vkCmdDispatch", erased(&dispatch)},
                         {"vkCmdDispatchIndirect", erased(&dispatch_indirect)},
                         {"vkCmdDraw", erased(&draw)},
                         {"vkCmdFillBuffer", erased(&fill)},
                         {"vkCmdCopyBuffer", erased(&copy)},
                         {"vkCmdCopyQueryPoolResults", erased(&copy_queries)},
                         {"vkCmdPipelineBarrier", erased(&barrier)}};
    return lies;
}

std::vector<Recording> BufferAccesses::recordings() {
    std::vector<Recording> all = state.ended;
    for (const auto& [commands, recording] : state.recordings) {
        all.push_back(recording);  // the host's
    }
    return all;
}

std::string BufferAccesses::name_of(VkBuffer buffer) {
    return state.names[buffer];
}

BufferRange BufferAccesses::range_of(const VkBufferMemoryBarrier& barrier) {
    return test_support::range_of(barrier.buffer, barrier.offset, barrier.size);
}

}  // namespace nearfield::test_support
