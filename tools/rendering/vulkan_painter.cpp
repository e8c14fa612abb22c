#include <tools/drawing/canvas.hpp>
#include <tools/rendering/shaders/painter_frag.hpp>
#include <tools/rendering/shaders/painter_vert.hpp>
#include <tools/rendering/vulkan_painter.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>

namespace nearfield::tools {
namespace {

/// The vertex shader's scale for pixels.
struct Scale {
    float x = 0.0F;
    float y = 0.0F;
};

vk::raii::RenderPass make_render_pass(const Gpu& gpu) {
    const std::array attachments{vk::AttachmentDescription()
                                     .setFormat(PaintedPage::format)
                                     .setSamples(PaintedPage::samples)
                                     .setLoadOp(vk::AttachmentLoadOp::eClear)
                                     .setStoreOp(vk::AttachmentStoreOp::eDontCare)
                                     .setFinalLayout(vk::ImageLayout::eColorAttachmentOptimal),
                                 vk::AttachmentDescription()
                                     .setFormat(PaintedPage::format)
                                     .setLoadOp(vk::AttachmentLoadOp::eDontCare)
                                     .setStoreOp(vk::AttachmentStoreOp::eStore)
                                     .setFinalLayout(vk::ImageLayout::eTransferSrcOptimal)};
    const vk::AttachmentReference sampled(0, vk::ImageLayout::eColorAttachmentOptimal);
    const vk::AttachmentReference resolved(1, vk::ImageLayout::eColorAttachmentOptimal);
    const auto subpass =
        vk::SubpassDescription().setColorAttachments(sampled).setResolveAttachments(resolved);
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const std::array dependencies{
        // Earlier frames paint to the same images and copy from them.
        vk::SubpassDependency()
            .setSrcSubpass(VK_SUBPASS_EXTERNAL)
            .setSrcStageMask(Stage::eColorAttachmentOutput | Stage::eTransfer)
            .setDstStageMask(Stage::eColorAttachmentOutput)
            .setSrcAccessMask(Access::eColorAttachmentWrite)
            .setDstAccessMask(Access::eColorAttachmentWrite),
        vk::SubpassDependency()
            .setDstSubpass(VK_SUBPASS_EXTERNAL)
            .setSrcStageMask(Stage::eColorAttachmentOutput)
            .setDstStageMask(Stage::eTransfer)
            .setSrcAccessMask(Access::eColorAttachmentWrite)
            .setDstAccessMask(Access::eTransferRead)};
    return {gpu.device(), vk::RenderPassCreateInfo()
                              .setAttachments(attachments)
                              .setSubpasses(subpass)
                              .setDependencies(dependencies)};
}

vk::raii::Sampler make_sampler(const Gpu& gpu) {
    return {gpu.device(), vk::SamplerCreateInfo()
                              .setMagFilter(vk::Filter::eLinear)
                              .setMinFilter(vk::Filter::eLinear)
                              .setAddressModeU(vk::SamplerAddressMode::eClampToBorder)
                              .setAddressModeV(vk::SamplerAddressMode::eClampToBorder)
                              .setBorderColor(vk::BorderColor::eFloatOpaqueWhite)};
}

vk::raii::DescriptorSetLayout make_set_layout(const Gpu& gpu, const vk::raii::Sampler& sampler) {
    const auto binding = vk::DescriptorSetLayoutBinding()
                             .setDescriptorType(vk::DescriptorType::eCombinedImageSampler)
                             .setStageFlags(vk::ShaderStageFlagBits::eFragment)
                             .setImmutableSamplers(*sampler);
    return {gpu.device(), vk::DescriptorSetLayoutCreateInfo().setBindings(binding)};
}

vk::raii::PipelineLayout make_layout(const Gpu& gpu, const vk::raii::DescriptorSetLayout& set) {
    const vk::PushConstantRange scale(vk::ShaderStageFlagBits::eVertex, 0, sizeof(Scale));
    return {gpu.device(),
            vk::PipelineLayoutCreateInfo().setSetLayouts(*set).setPushConstantRanges(scale)};
}

vk::raii::ShaderModule make_shader(const Gpu& gpu, std::span<const std::uint32_t> words) {
    return {gpu.device(),
            vk::ShaderModuleCreateInfo().setCodeSize(words.size_bytes()).setPCode(words.data())};
}

vk::raii::Pipeline make_pipeline(const Gpu& gpu, vk::PipelineLayout layout,
                                 vk::RenderPass render_pass) {
    const vk::raii::ShaderModule vertex = make_shader(gpu, shaders::painter_vert);
    const vk::raii::ShaderModule fragment = make_shader(gpu, shaders::painter_frag);
    using Shader = vk::ShaderStageFlagBits;
    const std::array stages{vk::PipelineShaderStageCreateInfo()
                                .setStage(Shader::eVertex)
                                .setModule(*vertex)
                                .setPName("main"),
                            vk::PipelineShaderStageCreateInfo()
                                .setStage(Shader::eFragment)
                                .setModule(*fragment)
                                .setPName("main")};
    const vk::VertexInputBindingDescription binding(0, sizeof(MeshVertex));
    const std::array attributes{vk::VertexInputAttributeDescription(0, 0, vk::Format::eR32G32Sfloat,
                                                                    offsetof(MeshVertex, x)),
                                vk::VertexInputAttributeDescription(1, 0, vk::Format::eR32G32Sfloat,
                                                                    offsetof(MeshVertex, u)),
                                vk::VertexInputAttributeDescription(
                                    2, 0, vk::Format::eR8G8B8A8Unorm, offsetof(MeshVertex, color))};
    const auto input = vk::PipelineVertexInputStateCreateInfo()
                           .setVertexBindingDescriptions(binding)
                           .setVertexAttributeDescriptions(attributes);
    const auto assembly = vk::PipelineInputAssemblyStateCreateInfo().setTopology(
        vk::PrimitiveTopology::eTriangleList);
    const auto viewport =
        vk::PipelineViewportStateCreateInfo().setViewportCount(1).setScissorCount(1);
    const auto rasterization = vk::PipelineRasterizationStateCreateInfo().setLineWidth(1.0F);
    const auto multisample =
        vk::PipelineMultisampleStateCreateInfo().setRasterizationSamples(PaintedPage::samples);
    using Component = vk::ColorComponentFlagBits;
    const auto over =
        vk::PipelineColorBlendAttachmentState()
            .setBlendEnable(VK_TRUE)
            .setSrcColorBlendFactor(vk::BlendFactor::eSrcAlpha)
            .setDstColorBlendFactor(vk::BlendFactor::eOneMinusSrcAlpha)
            .setSrcAlphaBlendFactor(vk::BlendFactor::eOne)
            .setDstAlphaBlendFactor(vk::BlendFactor::eOneMinusSrcAlpha)
            .setColorWriteMask(Component::eR | Component::eG | Component::eB | Component::eA);
    const auto blend = vk::PipelineColorBlendStateCreateInfo().setAttachments(over);
    const std::array dynamic_states{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const auto dynamic = vk::PipelineDynamicStateCreateInfo().setDynamicStates(dynamic_states);
    return {gpu.device(), nullptr,
            vk::GraphicsPipelineCreateInfo()
                .setStages(stages)
                .setPVertexInputState(&input)
                .setPInputAssemblyState(&assembly)
                .setPViewportState(&viewport)
                .setPRasterizationState(&rasterization)
                .setPMultisampleState(&multisample)
                .setPColorBlendState(&blend)
                .setPDynamicState(&dynamic)
                .setLayout(layout)
                .setRenderPass(render_pass)};
}

vk::raii::DescriptorPool make_descriptor_pool(const Gpu& gpu) {
    const vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 1);
    return {gpu.device(), vk::DescriptorPoolCreateInfo()
                              .setFlags(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet)
                              .setMaxSets(1)
                              .setPoolSizes(size)};
}

vk::raii::DescriptorSet make_set(const Gpu& gpu, vk::DescriptorPool pool,
                                 vk::DescriptorSetLayout layout) {
    vk::raii::DescriptorSets made(
        gpu.device(),
        vk::DescriptorSetAllocateInfo().setDescriptorPool(pool).setSetLayouts(layout));
    return std::move(made.front());
}

/// Copies `data` into a buffer, which grows if necessary.
template <class Value>
void put(const Gpu& gpu, HostBuffer& buffer, const std::vector<Value>& data,
         vk::BufferUsageFlagBits usage) {
    const std::size_t size = sizeof(Value) * data.size();
    if (buffer.bytes().size() < size) {
        buffer = HostBuffer(gpu, 2 * size, usage);
    }
    if (size > 0) {
        std::memcpy(buffer.bytes().data(), data.data(), size);
    }
}

std::array<float, 4> floats_of(const Color& color) {
    return {static_cast<float>(color.red), static_cast<float>(color.green),
            static_cast<float>(color.blue), 1.0F};
}

}  // namespace

PaintedPage::PaintedPage(const Gpu& gpu, vk::RenderPass render_pass, vk::Extent2D extent)
    : extent_(extent),
      sampled_(
          gpu, extent, format, samples,
          vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransientAttachment),
      resolved_(gpu, extent, format, vk::SampleCountFlagBits::e1,
                vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc),
      framebuffer_(nullptr) {
    const std::array views{sampled_.view(), resolved_.view()};
    framebuffer_ = vk::raii::Framebuffer(gpu.device(), vk::FramebufferCreateInfo()
                                                           .setRenderPass(render_pass)
                                                           .setAttachments(views)
                                                           .setWidth(extent.width)
                                                           .setHeight(extent.height)
                                                           .setLayers(1));
}

VulkanPainter::VulkanPainter(const Gpu& gpu, const Letters& letters, std::uint32_t frames_in_flight)
    : gpu_(gpu),
      render_pass_(make_render_pass(gpu)),
      sampler_(make_sampler(gpu)),
      set_layout_(make_set_layout(gpu, sampler_)),
      layout_(make_layout(gpu, set_layout_)),
      pipeline_(make_pipeline(gpu, *layout_, *render_pass_)),
      letters_(gpu, {letters.width, letters.height}, vk::Format::eR8Unorm,
               vk::SampleCountFlagBits::e1,
               vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst),
      sets_(make_descriptor_pool(gpu)),
      set_(make_set(gpu, *sets_, *set_layout_)),
      slots_(frames_in_flight) {
    upload(letters);
    const auto image = vk::DescriptorImageInfo()
                           .setImageView(letters_.view())
                           .setImageLayout(vk::ImageLayout::eShaderReadOnlyOptimal);
    gpu.device().updateDescriptorSets(
        vk::WriteDescriptorSet()
            .setDstSet(*set_)
            .setDescriptorType(vk::DescriptorType::eCombinedImageSampler)
            .setImageInfo(image),
        {});
}

void VulkanPainter::upload(const Letters& letters) {
    const HostBuffer buffer(gpu_, letters.coverage.size(), vk::BufferUsageFlagBits::eTransferSrc);
    std::memcpy(buffer.bytes().data(), letters.coverage.data(), letters.coverage.size());
    Commands once(gpu_);
    const vk::raii::CommandBuffer& commands = once.begin();
    const ImageUse copied{vk::ImageLayout::eTransferDstOptimal,
                          vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferWrite};
    change_use(commands, letters_.get(), {}, copied);
    commands.copyBufferToImage(buffer.get(), letters_.get(), copied.layout,
                               vk::BufferImageCopy()
                                   .setImageSubresource(whole_layer)
                                   .setImageExtent({letters.width, letters.height, 1}));
    change_use(commands, letters_.get(), copied,
               {vk::ImageLayout::eShaderReadOnlyOptimal, vk::PipelineStageFlagBits::eFragmentShader,
                vk::AccessFlagBits::eShaderRead});
    once.submit();
    once.wait();
}

void VulkanPainter::paint(const vk::raii::CommandBuffer& commands, std::uint32_t slot,
                          const Mesh& mesh, const Color& background, const PaintedPage& page) {
    Slot& buffers = slots_.at(slot);
    put(gpu_, buffers.vertices, mesh.vertices(), vk::BufferUsageFlagBits::eVertexBuffer);
    put(gpu_, buffers.indices, mesh.indices(), vk::BufferUsageFlagBits::eIndexBuffer);
    const vk::Extent2D extent = page.extent();
    const vk::ClearValue clear{vk::ClearColorValue(floats_of(background))};
    commands.beginRenderPass(vk::RenderPassBeginInfo()
                                 .setRenderPass(*render_pass_)
                                 .setFramebuffer(page.framebuffer())
                                 .setRenderArea({{0, 0}, extent})
                                 .setClearValues(clear),
                             vk::SubpassContents::eInline);
    if (!mesh.indices().empty()) {
        const auto width = static_cast<float>(extent.width);
        const auto height = static_cast<float>(extent.height);
        const Scale scale{2.0F / width, 2.0F / height};
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *set_, {});
        commands.setViewport(0, vk::Viewport(0.0F, 0.0F, width, height, 0.0F, 1.0F));
        commands.pushConstants<Scale>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, scale);
        commands.bindVertexBuffers(0, buffers.vertices.get(), vk::DeviceSize{0});
        commands.bindIndexBuffer(buffers.indices.get(), 0, vk::IndexType::eUint32);
        for (const MeshPart& part : mesh.parts()) {
            commands.setScissor(0, vk::Rect2D({part.left, part.top}, {part.width, part.height}));
            commands.drawIndexed(part.count, 1, part.first, 0, 0);
        }
    }
    commands.endRenderPass();
}

std::string png_of(const FrameImage& image) {
    const int width = static_cast<int>(image.width);
    const int height = static_cast<int>(image.height);
    Canvas canvas(width, height, palette::page);
    canvas.image(image.pixels, width, height, {});
    return canvas.png();
}

PageReader::PageReader(const Gpu& gpu, vk::Extent2D extent)
    : extent_(extent),
      pixels_(gpu, sizeof(std::uint32_t) * extent.width * extent.height,
              vk::BufferUsageFlagBits::eTransferDst) {}

void PageReader::record(const vk::raii::CommandBuffer& commands, const PaintedPage& page) const {
    commands.copyImageToBuffer(page.image(), vk::ImageLayout::eTransferSrcOptimal, pixels_.get(),
                               vk::BufferImageCopy()
                                   .setImageSubresource(whole_layer)
                                   .setImageExtent({extent_.width, extent_.height, 1}));
    commands.pipelineBarrier(
        vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost, {},
        vk::MemoryBarrier(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eHostRead), {},
        {});
}

FrameImage PageReader::read() const {
    FrameImage image{extent_.width, extent_.height, {}};
    image.pixels.resize(std::size_t{image.width} * image.height);
    std::memcpy(image.pixels.data(), pixels_.bytes().data(), pixels_.bytes().size());
    return image;
}

OffscreenPage::OffscreenPage(const Gpu& gpu, std::uint32_t width, std::uint32_t height)
    : painter_(gpu, {}, 1),
      page_(painter_.make_page({width, height})),
      reader_(gpu, page_.extent()),
      commands_(gpu) {}

FrameImage OffscreenPage::paint(const Drawing& drawing) {
    Mesh mesh(page_.extent().width, page_.extent().height);
    mesh.add(drawing);
    const vk::raii::CommandBuffer& commands = commands_.begin();
    painter_.paint(commands, 0, mesh, palette::panel, page_);
    reader_.record(commands, page_);
    commands_.submit();
    commands_.wait();
    return reader_.read();
}

}  // namespace nearfield::tools
