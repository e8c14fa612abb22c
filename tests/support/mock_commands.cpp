#include <tests/support/mock_entry.hpp>

#include <span>

namespace nearfield::test_support::mock {

VkResult perform(Tag_vkAllocateCommandBuffers tag, VkDevice,
                 const VkCommandBufferAllocateInfo* info, VkCommandBuffer* buffers) {
    driver().find(tag.name, info->commandPool);
    for (std::uint32_t i = 0; i < info->commandBufferCount; ++i) {
        buffers[i] = driver().make<VkCommandBuffer>(tag.name, number(info->commandPool));
    }
    return VK_SUCCESS;
}

VkResult perform(Tag_vkResetCommandPool tag, VkDevice, VkCommandPool pool,
                 VkCommandPoolResetFlags) {
    for (auto& [child, object] : driver().objects) {
        if (object.parent == number(pool)) {
            driver().expect_unused(tag.name, child);
            object.commands = MockObject::Commands::empty;
            object.needs.clear();
            object.writes.clear();
        }
    }
    return VK_SUCCESS;
}

VkResult perform(Tag_vkBeginCommandBuffer tag, VkCommandBuffer commands,
                 const VkCommandBufferBeginInfo*) {
    driver().change(tag.name, number(commands), MockObject::Commands::empty,
                    MockObject::Commands::recording);
    return VK_SUCCESS;
}

VkResult perform(Tag_vkEndCommandBuffer tag, VkCommandBuffer commands) {
    driver().change(tag.name, number(commands), MockObject::Commands::recording,
                    MockObject::Commands::executable);
    return VK_SUCCESS;
}

void perform(Tag_vkCmdBeginRenderPass tag, VkCommandBuffer commands,
             const VkRenderPassBeginInfo* info, VkSubpassContents) {
    use(tag.name, commands, info->renderPass);
    use(tag.name, commands, info->framebuffer);
}

void perform(Tag_vkCmdBindDescriptorSets tag, VkCommandBuffer commands, VkPipelineBindPoint,
             VkPipelineLayout layout, std::uint32_t, std::uint32_t count,
             const VkDescriptorSet* sets, std::uint32_t, const std::uint32_t*) {
    use(tag.name, commands, layout);
    for (std::uint32_t i = 0; i < count; ++i) {
        use(tag.name, commands, sets[i]);
        const MockObject* const set = driver().find(tag.name, sets[i]);
        if (set == nullptr) {
            continue;
        }
        // The specification requires this only if a shader uses the binding, but lavapipe always
        // reads it.
        for (const auto& [binding, needed] : set->needs) {
            if (!driver().objects.contains(needed)) {
                driver().breach(tag.name, "binding " + std::to_string(binding) +
                                              " of a set names something that is gone");
            }
        }
    }
}

void perform(Tag_vkCmdBindVertexBuffers tag, VkCommandBuffer commands, std::uint32_t,
             std::uint32_t count, const VkBuffer* buffers, const VkDeviceSize*) {
    for (std::uint32_t i = 0; i < count; ++i) {
        use(tag.name, commands, buffers[i]);
    }
}

namespace {

constexpr VkPipelineStageFlags stages_of_drawing =
    VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
    VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
    VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT;
constexpr VkAccessFlags accesses_of_drawing =
    VK_ACCESS_INDEX_READ_BIT | VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT |
    VK_ACCESS_INPUT_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_READ_BIT |
    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

void check_barrier(std::string_view call, VkPipelineStageFlags stages, VkAccessFlags accesses) {
    if ((stages & stages_of_drawing) != 0 || (accesses & accesses_of_drawing) != 0) {
        driver().expect_drawing(call);
    }
}

}  // namespace

void perform(Tag_vkCmdPipelineBarrier tag, VkCommandBuffer commands, VkPipelineStageFlags source,
             VkPipelineStageFlags destination, VkDependencyFlags, std::uint32_t memory_count,
             const VkMemoryBarrier* memory, std::uint32_t buffer_count,
             const VkBufferMemoryBarrier* buffers, std::uint32_t image_count,
             const VkImageMemoryBarrier* images) {
    check_barrier(tag.name, source | destination, 0);
    for (std::uint32_t i = 0; i < memory_count; ++i) {
        check_barrier(tag.name, 0, memory[i].srcAccessMask | memory[i].dstAccessMask);
    }
    for (std::uint32_t i = 0; i < buffer_count; ++i) {
        check_barrier(tag.name, 0, buffers[i].srcAccessMask | buffers[i].dstAccessMask);
        use(tag.name, commands, buffers[i].buffer);
    }
    for (std::uint32_t i = 0; i < image_count; ++i) {
        check_barrier(tag.name, 0, images[i].srcAccessMask | images[i].dstAccessMask);
        use(tag.name, commands, images[i].image);
    }
}

namespace {

/// Records a write for the execution of the commands; a breach if the range does not exist.
void note(std::string_view call, VkCommandBuffer commands, const MockWrite& write) {
    const auto outside = [](Number buffer, std::uint64_t first, std::uint64_t words) {
        return (first + words) * sizeof(std::uint32_t) > driver().objects[buffer].bytes;
    };
    if (outside(write.buffer, write.first_word, write.words) ||
        (write.from != 0 && outside(write.from, write.first_word_from, write.words))) {
        driver().breach(call, "words that are not in the buffer");
    }
    if (!driver().objects[write.buffer].written) {
        driver().breach(call, "a buffer that is not to be written (VK_BUFFER_USAGE_TRANSFER_DST)");
    }
    if (MockObject* const object = driver().find(call, commands)) {
        object->writes.push_back(write);
    }
}

}  // namespace

void perform(Tag_vkCmdFillBuffer tag, VkCommandBuffer commands, VkBuffer buffer,
             VkDeviceSize offset, VkDeviceSize size, std::uint32_t value) {
    use(tag.name, commands, buffer);
    note(tag.name, commands, {number(buffer), offset / sizeof(value), size / sizeof(value), value});
}

void perform(Tag_vkCmdCopyBuffer tag, VkCommandBuffer commands, VkBuffer from, VkBuffer to,
             std::uint32_t count, const VkBufferCopy* regions) {
    use(tag.name, commands, from);
    use(tag.name, commands, to);
    if (!driver().objects[number(from)].copied_from) {
        driver().breach(tag.name, "a buffer to copy from (VK_BUFFER_USAGE_TRANSFER_SRC)");
    }
    constexpr std::uint64_t word = sizeof(std::uint32_t);
    for (const VkBufferCopy& region : std::span(regions, count)) {
        note(tag.name, commands,
             {number(to), region.dstOffset / word, region.size / word, 0, number(from),
              region.srcOffset / word});
    }
}

}  // namespace nearfield::test_support::mock
