#include <tests/support/mock_entry.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

namespace nearfield::test_support::mock {

template <class Info>
VkResult make_pipelines(std::string_view call, VkDevice device, std::uint32_t count,
                        const Info* infos, VkPipeline* pipelines) {
    for (std::uint32_t i = 0; i < count; ++i) {
        driver().find(call, infos[i].layout);
        pipelines[i] = driver().make<VkPipeline>(call, number(device));
    }
    return VK_SUCCESS;
}

/// The threads of a workgroup, as SPIR-V code says; 1 of code that is for no compute shader.
std::uint64_t threads_of(std::span<const std::uint32_t> code) {
    constexpr std::size_t words_of_header = 5;
    constexpr std::uint32_t execution_mode = 16;
    constexpr std::uint32_t local_size = 17;
    for (std::size_t i = words_of_header; i < code.size(); i += std::max(code[i] >> 16U, 1U)) {
        if ((code[i] & 0xffffU) == execution_mode && code[i + 2] == local_size) {
            return std::uint64_t{code[i + 3]} * code[i + 4] * code[i + 5];
        }
    }
    return 1;
}

VkResult perform(Tag_vkCreateShaderModule tag, VkDevice device,
                 const VkShaderModuleCreateInfo* info, const VkAllocationCallbacks*,
                 VkShaderModule* module) {
    // Of maxComputeWorkGroupInvocations, all that Vulkan promises.
    if (threads_of({info->pCode, info->codeSize / sizeof(std::uint32_t)}) > 128) {
        driver().breach(tag.name, "a workgroup of more than 128 threads");
    }
    *module = driver().make<VkShaderModule>(tag.name, number(device));
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateGraphicsPipelines tag, VkDevice device, VkPipelineCache,
                 std::uint32_t count, const VkGraphicsPipelineCreateInfo* infos,
                 const VkAllocationCallbacks*, VkPipeline* pipelines) {
    return make_pipelines(tag.name, device, count, infos, pipelines);
}

VkResult perform(Tag_vkCreateComputePipelines tag, VkDevice device, VkPipelineCache,
                 std::uint32_t count, const VkComputePipelineCreateInfo* infos,
                 const VkAllocationCallbacks*, VkPipeline* pipelines) {
    return make_pipelines(tag.name, device, count, infos, pipelines);
}

VkResult perform(Tag_vkAllocateDescriptorSets tag, VkDevice,
                 const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets) {
    driver().find(tag.name, info->descriptorPool);
    for (std::uint32_t i = 0; i < info->descriptorSetCount; ++i) {
        sets[i] = driver().make<VkDescriptorSet>(tag.name, number(info->descriptorPool));
        refer(tag.name, *driver().find(tag.name, sets[i]), UINT32_MAX, info->pSetLayouts[i]);
    }
    return VK_SUCCESS;
}

void perform(Tag_vkUpdateDescriptorSets tag, VkDevice, std::uint32_t count,
             const VkWriteDescriptorSet* writes, std::uint32_t, const VkCopyDescriptorSet*) {
    for (std::uint32_t i = 0; i < count; ++i) {
        MockObject* const set = driver().find(tag.name, writes[i].dstSet);
        if (set == nullptr) {
            continue;
        }
        driver().expect_unused(tag.name, number(writes[i].dstSet));
        if (writes[i].pImageInfo != nullptr) {
            refer(tag.name, *set, writes[i].dstBinding, writes[i].pImageInfo->imageView);
        } else if (writes[i].pTexelBufferView != nullptr) {
            refer(tag.name, *set, writes[i].dstBinding, *writes[i].pTexelBufferView);
        } else {
            const VkDescriptorBufferInfo& info = *writes[i].pBufferInfo;
            refer(tag.name, *set, writes[i].dstBinding, info.buffer);
            // Shaders read what is bound to the first two as vectors of four words.
            if (writes[i].dstBinding < 2 && info.range % 16 != 0) {
                driver().breach(tag.name, "a range that ends within a vector of four words");
            }
            set->ranges[writes[i].dstBinding] = {info.offset / sizeof(std::uint32_t),
                                                 info.range / sizeof(std::uint32_t)};
        }
    }
}

VkResult perform(Tag_vkSetDebugUtilsObjectNameEXT tag, VkDevice,
                 const VkDebugUtilsObjectNameInfoEXT* info) {
    if (!driver().objects.contains(info->objectHandle)) {
        driver().breach(tag.name, "a handle of nothing that is there");
    }
    return VK_SUCCESS;
}

}  // namespace nearfield::test_support::mock
