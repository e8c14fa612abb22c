#include <tests/support/mock_entry.hpp>

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
