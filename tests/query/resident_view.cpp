#include <tests/query/resident_view.hpp>
#include <tests/query/shaders/resident_arrows_frag.hpp>
#include <tests/query/shaders/resident_arrows_vert.hpp>
#include <tests/query/shaders/resident_field_frag.hpp>
#include <tests/query/shaders/resident_field_vert.hpp>
#include <tests/query/shaders/resident_samples_frag.hpp>
#include <tests/query/shaders/resident_samples_vert.hpp>

#include <cstring>
#include <fstream>

namespace nearfield::test {
namespace {

using test_support::require;

constexpr VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;

/// Matches shaders/view.glsl.
struct Push {
    float field_low[2];
    float records_low[2];
    float samples_low[2];
    float pixels[2];
    float step;
    float cell;
    std::int32_t cells[2];
    float arrow_length;
    float line_spacing;
};
constexpr VkShaderStageFlags both_stages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// By binding. The distances are bound twice, the second time apart from the sampler.
constexpr std::array<VkDescriptorType, 6> descriptors{
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,          VK_DESCRIPTOR_TYPE_SAMPLER};

}  // namespace

void Picture::write(const std::string& path) const {
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << width << ' ' << height << "\n255\n";
    for (const auto& pixel : pixels) {
        file.write(reinterpret_cast<const char*>(pixel.data()), 3);
    }
}

ResidentView::ResidentView(const HostDevice& host, VkExtent2D pixels)
    : gpu_(host),
      extent_(pixels),
      pixels_(gpu_.make_buffer(std::uint64_t{4} * pixels.width * pixels.height)) {
    make_render_pass();
    make_target();
    make_layout();
    make_set();
    field_pipeline_ = make_pipeline(shaders::resident_field_vert, shaders::resident_field_frag);
    samples_pipeline_ =
        make_pipeline(shaders::resident_samples_vert, shaders::resident_samples_frag, true);
    arrows_pipeline_ = make_pipeline(shaders::resident_arrows_vert, shaders::resident_arrows_frag);
}

void ResidentView::make_render_pass() {
    VkAttachmentDescription color{};
    color.format = format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    const VkSubpassDependency to_copy{0,
                                      VK_SUBPASS_EXTERNAL,
                                      VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                      VK_PIPELINE_STAGE_TRANSFER_BIT,
                                      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                      VK_ACCESS_TRANSFER_READ_BIT,
                                      0};
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &to_copy;
    require(gpu_.vkCreateRenderPass(gpu_.device(), &info, nullptr, &render_pass_),
            "vkCreateRenderPass");
    gpu_.at_end([this] { gpu_.vkDestroyRenderPass(gpu_.device(), render_pass_, nullptr); });
}

void ResidentView::make_target() {
    target_ = gpu_.make_image(
        format, extent_, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass_;
    info.attachmentCount = 1;
    info.pAttachments = &target_.view;
    info.width = extent_.width;
    info.height = extent_.height;
    info.layers = 1;
    require(gpu_.vkCreateFramebuffer(gpu_.device(), &info, nullptr, &framebuffer_),
            "vkCreateFramebuffer");
    gpu_.at_end([this] { gpu_.vkDestroyFramebuffer(gpu_.device(), framebuffer_, nullptr); });
}

void ResidentView::make_layout() {
    std::array<VkDescriptorSetLayoutBinding, descriptors.size()> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = descriptors[i];
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = both_stages;
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    require(gpu_.vkCreateDescriptorSetLayout(gpu_.device(), &set, nullptr, &set_layout_),
            "vkCreateDescriptorSetLayout");
    gpu_.at_end([this] { gpu_.vkDestroyDescriptorSetLayout(gpu_.device(), set_layout_, nullptr); });
    const VkPushConstantRange push{both_stages, 0, sizeof(Push)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout_;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    require(gpu_.vkCreatePipelineLayout(gpu_.device(), &info, nullptr, &layout_),
            "vkCreatePipelineLayout");
    gpu_.at_end([this] { gpu_.vkDestroyPipelineLayout(gpu_.device(), layout_, nullptr); });
}

void ResidentView::make_set() {
    VkSamplerCreateInfo sampler{};
    sampler.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    require(gpu_.vkCreateSampler(gpu_.device(), &sampler, nullptr, &sampler_), "vkCreateSampler");
    gpu_.at_end([this] { gpu_.vkDestroySampler(gpu_.device(), sampler_, nullptr); });
    const std::array<VkDescriptorPoolSize, 4> sizes{{{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2},
                                                     {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2},
                                                     {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1},
                                                     {VK_DESCRIPTOR_TYPE_SAMPLER, 1}}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = 1;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    require(gpu_.vkCreateDescriptorPool(gpu_.device(), &info, nullptr, &pool),
            "vkCreateDescriptorPool");
    gpu_.at_end([this, pool] { gpu_.vkDestroyDescriptorPool(gpu_.device(), pool, nullptr); });
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &set_layout_;
    require(gpu_.vkAllocateDescriptorSets(gpu_.device(), &allocate, &set_),
            "vkAllocateDescriptorSets");
}

/// `per_sample`: reads the places of intersection samples as a vertex attribute, one an instance.
VkPipeline ResidentView::make_pipeline(std::span<const std::uint32_t> vertex,
                                       std::span<const std::uint32_t> fragment, bool per_sample) {
    const auto make_module = [&](std::span<const std::uint32_t> words) {
        VkShaderModuleCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        info.codeSize = words.size_bytes();
        info.pCode = words.data();
        VkShaderModule module = VK_NULL_HANDLE;
        require(gpu_.vkCreateShaderModule(gpu_.device(), &info, nullptr, &module),
                "vkCreateShaderModule");
        return module;
    };
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = make_module(vertex);
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = make_module(fragment);

    VkPipelineVertexInputStateCreateInfo input{};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    const VkVertexInputBindingDescription samples_input{0, sizeof(IntersectionSampleData),
                                                        VK_VERTEX_INPUT_RATE_INSTANCE};
    const VkVertexInputAttributeDescription place{0, 0, VK_FORMAT_R32G32_SFLOAT,
                                                  offsetof(IntersectionSampleData, position)};
    if (per_sample) {
        input.vertexBindingDescriptionCount = input.vertexAttributeDescriptionCount = 1;
        input.pVertexBindingDescriptions = &samples_input;
        input.pVertexAttributeDescriptions = &place;
    }
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    const VkViewport viewport{
        0.0F, 0.0F, static_cast<float>(extent_.width), static_cast<float>(extent_.height),
        0.0F, 1.0F};
    const VkRect2D scissor{{0, 0}, extent_};
    VkPipelineViewportStateCreateInfo viewports{};
    viewports.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewports.viewportCount = viewports.scissorCount = 1;
    viewports.pViewports = &viewport;
    viewports.pScissors = &scissor;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.lineWidth = 1.0F;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = 0xF;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &attachment;

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewports;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pColorBlendState = &blend;
    info.layout = layout_;
    info.renderPass = render_pass_;
    VkPipeline pipeline = VK_NULL_HANDLE;
    require(
        gpu_.vkCreateGraphicsPipelines(gpu_.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
    gpu_.at_end([this, pipeline] { gpu_.vkDestroyPipeline(gpu_.device(), pipeline, nullptr); });
    for (const VkPipelineShaderStageCreateInfo& stage : stages) {
        gpu_.vkDestroyShaderModule(gpu_.device(), stage.module, nullptr);
    }
    return pipeline;
}

void ResidentView::bind(const Subject& subject) const {
    const auto& [field, contacts, overlap] = subject;
    const std::array<VkDescriptorImageInfo, 2> images{
        {{sampler_, field.signed_distance.view, field.state.layout},
         {sampler_, field.feature.view, field.state.layout}}};
    const std::array<VkDescriptorBufferInfo, 2> buffers{
        {{contacts.buffer, contacts.offset, contacts.size},
         {overlap.buffer, overlap.offset, overlap.size}}};
    std::array<VkWriteDescriptorSet, 4> writes{};
    for (VkWriteDescriptorSet& write : writes) {
        write.descriptorCount = 1;
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set_;
    }
    writes[0].descriptorCount = static_cast<std::uint32_t>(images.size());
    writes[0].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    writes[0].pImageInfo = images.data();
    writes[1].dstBinding = 2;
    writes[1].descriptorCount = static_cast<std::uint32_t>(buffers.size());
    writes[1].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[1].pBufferInfo = buffers.data();
    for (const std::uint32_t i : {2U, 3U}) {
        writes[i].dstBinding = 2 + i;
        writes[i].descriptorType = descriptors[2 + i];
        writes[i].pImageInfo = images.data();
    }
    gpu_.vkUpdateDescriptorSets(gpu_.device(), static_cast<std::uint32_t>(writes.size()),
                                writes.data(), 0, nullptr);
}

void ResidentView::record(VkCommandBuffer commands, const Subject& subject,
                          const Shot& shot) const {
    const auto& [field, contacts, overlap] = subject;
    const auto narrow = [](double number) { return static_cast<float>(number); };
    const Push push{
        {narrow(shot.low.x - field.origin.x), narrow(shot.low.y - field.origin.y)},
        {narrow(shot.low.x - contacts.origin.x), narrow(shot.low.y - contacts.origin.y)},
        {narrow(shot.low.x - overlap.origin.x), narrow(shot.low.y - overlap.origin.y)},
        {static_cast<float>(extent_.width), static_cast<float>(extent_.height)},
        narrow(shot.step),
        narrow(field.cell),
        {static_cast<std::int32_t>(field.width), static_cast<std::int32_t>(field.height)},
        narrow(shot.arrow_length),
        narrow(shot.line_spacing)};
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = render_pass_;
    begin.framebuffer = framebuffer_;
    begin.renderArea = {{0, 0}, extent_};
    gpu_.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    gpu_.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0,
                                 nullptr);
    gpu_.vkCmdPushConstants(commands, layout_, both_stages, 0, sizeof(push), &push);
    const auto draw = [&](VkPipeline pipeline, std::uint32_t vertices, std::uint32_t instances) {
        gpu_.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        gpu_.vkCmdDraw(commands, vertices, instances, 0, 0);
    };
    draw(field_pipeline_, 3, 1);
    gpu_.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, samples_pipeline_);
    const VkDeviceSize first_sample = overlap.offset + sizeof(IntersectionSummaryData);
    gpu_.vkCmdBindVertexBuffers(commands, 0, 1, &overlap.buffer, &first_sample);
    gpu_.vkCmdDrawIndirect(commands, overlap.header.buffer,
                           overlap.header.offset + offsetof(HeaderData, quads), 1,
                           sizeof(VkDrawIndirectCommand));
    draw(arrows_pipeline_, 9, contacts.capacity);
    gpu_.vkCmdEndRenderPass(commands);
}

void ResidentView::record_copy(VkCommandBuffer commands) const {
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {extent_.width, extent_.height, 1};
    gpu_.vkCmdCopyImageToBuffer(commands, target_.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                pixels_.buffer, 1, &region);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    gpu_.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                              0, 1, &barrier, 0, nullptr, 0, nullptr);
}

Picture ResidentView::draw(const Subject& subject, const Shot& shot) {
    bind(subject);
    gpu_.submit([&](VkCommandBuffer commands) {
        record(commands, subject, shot);
        record_copy(commands);
    });
    gpu_.finish();
    Picture picture{extent_.width, extent_.height, {}};
    picture.pixels.resize(std::size_t{extent_.width} * extent_.height);
    std::memcpy(picture.pixels.data(), pixels_.data, 4 * picture.pixels.size());
    return picture;
}

}  // namespace nearfield::test
