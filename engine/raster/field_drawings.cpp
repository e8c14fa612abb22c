#include <engine/raster/field_drawings.hpp>

#include <shaders/color_frag.hpp>
#include <shaders/color_in_tile_frag.hpp>
#include <shaders/gradient_frag.hpp>
#include <shaders/mesh_vert.hpp>
#include <shaders/number_frag.hpp>
#include <shaders/number_in_tile_frag.hpp>
#include <shaders/tile_mesh_vert.hpp>

#include <array>
#include <functional>
#include <limits>

namespace nearfield::raster {
namespace {

constexpr VkFormat white_format = VK_FORMAT_R8_UNORM;
constexpr VkFormat signed_feature_format = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat distance_format = VK_FORMAT_D32_SFLOAT;

constexpr std::uint32_t black = 0;
constexpr std::uint32_t all_bits = 0xffffffff;
constexpr std::uint32_t no_feature_outside = shaders::max_signed_features;
constexpr float largest_half = 65504.0F;

gpu::Owned<VkPipelineLayout> make_gradients_layout(const gpu::Device& device,
                                                   VkDescriptorSetLayout set) {
    const std::array<VkPushConstantRange, 2> push{
        {{draw_push_stages, 0, sizeof(shaders::MeshPush)},
         {VK_SHADER_STAGE_FRAGMENT_BIT, shaders::gradient_push_offset,
          sizeof(shaders::GradientPush)}}};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = static_cast<std::uint32_t>(push.size());
    info.pPushConstantRanges = push.data();
    return gpu::make_object(device, info, "blended gradients", "nearfield gradient layout");
}

/// Drawing white replaces a colour by one minus that colour.
VkPipelineColorBlendAttachmentState inverting(VkBlendFactor one_minus,
                                              VkColorComponentFlags channels) {
    return blending(one_minus, VK_BLEND_FACTOR_ZERO, VK_BLEND_OP_ADD, channels);
}

}  // namespace

FieldDrawings::FieldDrawings(const gpu::Device& device, const graph::ComputeLayout& compute_layout,
                             VkPipelineLayout layout, const StencilPipelines& stencil)
    : device_(&device),
      layout_(layout),
      stencil_(&stencil),
      color_render_pass_(make_prototype(device, white_format, VK_FORMAT_UNDEFINED, "white")),
      features_render_pass_(make_prototype(device, number_format, distance_format, "distance")),
      signed_features_render_pass_(
          make_prototype(device, signed_feature_format, distance_format, "signed feature")),
      gradients_render_pass_(
          make_prototype(device, device.gradient_format(), VK_FORMAT_UNDEFINED, "gradient")),
      gradients_layout_(make_gradients_layout(device, compute_layout.set_layout())) {
    make_color_fill();
    make_features();
    make_signed_features();
    make_gradients();
}

void FieldDrawings::make_color_fill() {
    gpu::GraphicsPipelineDescription description = describe_drawing(
        layout_, color_render_pass_.get(), shaders::mesh_vert, shaders::color_frag);

    description.name = "nearfield white clear";
    color_.clear = gpu::make_graphics_pipeline(*device_, description);

    description.name = "nearfield white parity";
    description.blend = inverting(VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR, VK_COLOR_COMPONENT_R_BIT);
    color_.parity = gpu::make_graphics_pipeline(*device_, description);
}

void FieldDrawings::make_features() {
    gpu::GraphicsPipelineDescription description = describe_drawing(
        layout_, features_render_pass_.get(), shaders::mesh_vert, shaders::number_frag);
    description.depth_test = true;

    description.name = "nearfield distance clear";
    description.depth_compare = VK_COMPARE_OP_ALWAYS;
    features_.clear = gpu::make_graphics_pipeline(*device_, description);

    description.name = "nearfield distance mesh";
    description.vertex_shader = shaders::tile_mesh_vert;
    description.fragment_shader = shaders::number_in_tile_frag;
    description.depth_compare = VK_COMPARE_OP_LESS;
    features_.mesh = gpu::make_graphics_pipeline(*device_, description);
}

void FieldDrawings::make_signed_features() {
    gpu::GraphicsPipelineDescription description = describe_drawing(
        layout_, signed_features_render_pass_.get(), shaders::mesh_vert, shaders::color_frag);
    description.depth_test = true;

    description.name = "nearfield signed feature clear";
    description.depth_compare = VK_COMPARE_OP_ALWAYS;
    signed_features_.clear = gpu::make_graphics_pipeline(*device_, description);

    description.name = "nearfield signed feature parity";
    description.depth_test = false;
    description.blend = inverting(VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA, VK_COLOR_COMPONENT_A_BIT);
    signed_features_.parity = gpu::make_graphics_pipeline(*device_, description);

    VkPipelineColorBlendAttachmentState only_ids{};
    only_ids.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT;
    description.name = "nearfield signed feature mesh";
    description.vertex_shader = shaders::tile_mesh_vert;
    description.fragment_shader = shaders::color_in_tile_frag;
    description.depth_test = true;
    description.depth_compare = VK_COMPARE_OP_LESS;
    description.blend = only_ids;
    signed_features_.mesh = gpu::make_graphics_pipeline(*device_, description);
}

void FieldDrawings::make_gradients() {
    constexpr VkColorComponentFlags both = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT;
    gpu::GraphicsPipelineDescription description =
        describe_drawing(gradients_layout_.get(), gradients_render_pass_.get(),
                         shaders::tile_mesh_vert, shaders::gradient_frag);
    description.name = "nearfield gradient shifted";
    gradients_.shifted = gpu::make_graphics_pipeline(*device_, description);
    description.name = "nearfield gradient subtract";
    description.blend =
        blending(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE, VK_BLEND_OP_REVERSE_SUBTRACT, both);
    gradients_.subtract = gpu::make_graphics_pipeline(*device_, description);
    description.name = "nearfield gradient multiply";
    description.blend =
        blending(VK_BLEND_FACTOR_ZERO, VK_BLEND_FACTOR_SRC_COLOR, VK_BLEND_OP_ADD, both);
    gradients_.multiply = gpu::make_graphics_pipeline(*device_, description);
}

graph::Handle FieldDrawings::fill(const Canvas& canvas) const {
    const auto record = [this](VkCommandBuffer commands, const DrawContext& context) {
        using namespace stencil_bits;
        const TileRenderer renderer(*device_, layout_, commands, context);
        const TileMeshes& meshes = context.batch.meshes;
        const DrawRange rectangles = meshes.range(rectangles_of(SignEncoding::stencil));
        renderer.bind(stencil_->clear.get());
        renderer.stencil(all, all, 0);
        renderer.draw(rectangles, 1.0F, 0);
        renderer.bind(stencil_->parity.get());
        renderer.stencil(all, parity_b, 0);
        renderer.draw(meshes.range(fills_of(SignEncoding::stencil)), 1.0F, 0);
        renderer.bind(stencil_->mark.get());
        renderer.stencil(parity_b, 0, parity_b);
        renderer.draw(rectangles, 1.0F, filled_mask);
    };
    return add_drawing(canvas, "fill", {"sign", number_format},
                       {"fill stencil", device_->stencil_format()}, record);
}

graph::Handle FieldDrawings::color_fill(const Canvas& canvas) const {
    const auto record = [this](VkCommandBuffer commands, const DrawContext& context) {
        const TileRenderer renderer(*device_, layout_, commands, context);
        const TileMeshes& meshes = context.batch.meshes;
        renderer.stencil(0, 0, 0);
        renderer.bind(color_.clear.get());
        renderer.draw(meshes.range(rectangles_of(SignEncoding::color)), 1.0F, black);
        renderer.bind(color_.parity.get());
        renderer.draw(meshes.range(fills_of(SignEncoding::color)), 1.0F, all_bits);
    };
    return add_drawing(canvas, "color fill", {"white inside", white_format, {}, VK_FORMAT_R8_UINT},
                       {}, record);
}

graph::Handle FieldDrawings::features(const Canvas& canvas) const {
    const auto record = [this](VkCommandBuffer commands, const DrawContext& context) {
        const TileRenderer renderer(*device_, layout_, commands, context);
        renderer.stencil(0, 0, 0);
        renderer.bind(features_.clear.get());
        renderer.draw(context.batch.meshes.range(rectangles_of(SignEncoding::stencil),
                                                 rectangles_of(SignEncoding::color)),
                      1.0F, shaders::no_feature);
        renderer.bind(features_.mesh.get());
        renderer.draw(TileMeshId::distances);
    };
    return add_drawing(canvas, "cone mesh", {"features", number_format},
                       {"distance", distance_format}, record);
}

graph::Handle FieldDrawings::signed_features(const Canvas& canvas) const {
    const auto record = [this](VkCommandBuffer commands, const DrawContext& context) {
        const TileRenderer renderer(*device_, layout_, commands, context);
        const TileMeshes& meshes = context.batch.meshes;
        renderer.stencil(0, 0, 0);
        renderer.bind(signed_features_.clear.get());
        renderer.draw(meshes.range(rectangles_of(SignEncoding::feature_bit)), 1.0F,
                      no_feature_outside);
        renderer.bind(signed_features_.parity.get());
        renderer.draw(meshes.range(fills_of(SignEncoding::feature_bit)), 1.0F, all_bits);
        renderer.bind(signed_features_.mesh.get());
        renderer.draw(TileMeshId::signed_distances);
    };
    return add_drawing(canvas, "signed cone mesh",
                       {"signed features", signed_feature_format, {}, number_format},
                       {"distance under signed features", distance_format}, record);
}

graph::Handle FieldDrawings::gradients(const Canvas& canvas, graph::Handle field) const {
    return add_drawing(canvas, "gradient", {"gradient", device_->gradient_format()}, {},
                       std::bind_front(&FieldDrawings::record_gradients, this),
                       {{3, field, graph::Access::storage_read_in_fragment}});
}

void FieldDrawings::record_gradients(const graph::PassCommands& commands,
                                     const DrawContext& context) const {
    const VkPipelineLayout layout = gradients_layout_.get();
    const gpu::Functions& functions = device_->functions();
    const TileRenderer renderer(*device_, layout, commands, context);
    const VkDescriptorSet set = commands.set();
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set,
                                      0, nullptr);
    const float largest = device_->gradient_format() == VK_FORMAT_R16G16_SFLOAT
                              ? largest_half
                              : std::numeric_limits<float>::max();
    const auto draw_all = [&](const gpu::Owned<VkPipeline>& pipeline, std::int32_t shift) {
        renderer.bind(pipeline.get());
        const shaders::GradientPush push{shift, 0.5F, largest};
        functions.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_FRAGMENT_BIT,
                                     shaders::gradient_push_offset, sizeof(push), &push);
        renderer.draw(TileMeshId::gradients);
    };
    renderer.stencil(0, 0, 0);
    draw_all(gradients_.shifted, 1);
    draw_all(gradients_.subtract, -1);
    draw_all(gradients_.multiply, 0);
}

}  // namespace nearfield::raster
