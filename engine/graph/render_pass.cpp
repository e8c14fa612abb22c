#include <engine/graph/access.hpp>
#include <engine/graph/execute.hpp>

#include <array>
#include <vector>

namespace nearfield::graph {

namespace {

VkAttachmentDescription describe(const Graph& graph, const Attachment& attachment) {
    const VkAttachmentLoadOp load =
        attachment.load ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    const VkAttachmentStoreOp store =
        attachment.store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    const VkImageLayout layout = traits(attachment.access).layout;
    return {.flags = 0,
            .format = graph.resources()[attachment.resource].image.format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = load,
            .storeOp = store,
            .stencilLoadOp = load,
            .stencilStoreOp = store,
            .initialLayout = layout,
            .finalLayout = layout};
}

/// The graph's barriers order everything around the render pass, so these two dependencies order
/// nothing: nothing comes before TOP_OF_PIPE or after BOTTOM_OF_PIPE. They replace the implicit
/// dependencies that Vulkan adds otherwise. Correctness needs neither: the implicit ones belong to
/// layout transitions, of which this render pass has none; but they name all commands, so a driver
/// may treat them as a wait.
std::array<VkSubpassDependency, 2> no_dependencies(VkPipelineStageFlags stages) {
    return {{{.srcSubpass = VK_SUBPASS_EXTERNAL,
              .dstSubpass = 0,
              .srcStageMask = VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
              .dstStageMask = stages,
              .srcAccessMask = 0,
              .dstAccessMask = 0,
              .dependencyFlags = 0},
             {.srcSubpass = 0,
              .dstSubpass = VK_SUBPASS_EXTERNAL,
              .srcStageMask = stages,
              .dstStageMask = VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT,
              .srcAccessMask = 0,
              .dstAccessMask = 0,
              .dependencyFlags = 0}}};
}

}  // namespace

gpu::Owned<VkRenderPass> make_render_pass(const gpu::Device& device, const Graph& graph,
                                          const BakedPass& pass) {
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> colors;
    VkAttachmentReference depth_stencil{};
    VkPipelineStageFlags stages = 0;
    for (const Attachment& attachment : pass.attachments) {
        const VkAttachmentReference reference = {static_cast<std::uint32_t>(attachments.size()),
                                                 traits(attachment.access).layout};
        attachments.push_back(describe(graph, attachment));
        stages |= traits(attachment.access).stages;
        if (attachment.access == Access::color_attachment) {
            colors.push_back(reference);
        } else {
            depth_stencil = reference;
        }
    }
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    subpass.pColorAttachments = colors.data();
    subpass.pDepthStencilAttachment = colors.size() < attachments.size() ? &depth_stencil : nullptr;
    const std::array<VkSubpassDependency, 2> dependencies = no_dependencies(stages);

    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    const std::string name = "nearfield render pass " + graph.passes()[pass.pass].name;
    return gpu::make_object(device, info, name, name);
}

}  // namespace nearfield::graph
