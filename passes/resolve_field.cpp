#include <passes/color_fill.hpp>
#include <passes/feature_bit.hpp>
#include <passes/fill.hpp>
#include <passes/resolve_field.hpp>

#include <shaders/collect_gradients_comp.hpp>
#include <shaders/resolve_field_comp.hpp>
#include <shaders/resolve_field_points_comp.hpp>

#include <vector>

namespace nearfield::passes {

using graph::Access;

namespace {

/// The bits of a texel of an encoding's sign image that are set inside B.
std::uint32_t sign_mask(SignEncoding encoding) {
    switch (encoding) {
        case SignEncoding::color:
            return white_mask;
        case SignEncoding::feature_bit:
            return plan::feature_bit_mask;
        case SignEncoding::stencil:
            break;
    }
    return filled_mask;
}

/// Tiles, edges and images; there is a descriptor set for each encoding.
std::vector<graph::Bound> bound_to(graph::Handle& input, FieldImages& images) {
    std::vector<graph::Bound> bound{{0, input, read, input_parts::tiles},
                                    {1, input, read, input_parts::edges}};
    for (std::uint32_t i = 0; i < images.by_encoding.size(); ++i) {
        auto& [features, sign] = images.by_encoding[i];
        bound.push_back({4, features, Access::sampled_in_compute, 0, i});
        bound.push_back({5, sign, Access::sampled_in_compute, 0, i});
    }
    return bound;
}

void dispatch_gradients(const ComputeShader& shader, VkCommandBuffer commands,
                        const RecordContext& context) {
    for (const plan::FieldTile& field : context.batch.field_tiles) {
        if (field.first_gradient != plan::not_asked) {
            const plan::TileData& tile = context.batch.tiles[field.tile];
            shader.dispatch_elements<plan::CollectGradientsPush>(
                commands, 0, tile.width * tile.height, field.first_gradient, 0U, 0U, field.tile);
        }
    }
    for (const plan::FieldPointRun& run : context.batch.field_point_runs) {
        if (run.parts.blended) {
            shader.dispatch_elements<plan::CollectGradientsPush>(
                commands, 4 * run.first, 4 * (run.first + run.count), run.first_word, run.first,
                run.parts.words_per_point, 0U);
        }
    }
}

}  // namespace

ResolveField::ResolveField(const gpu::Device& device, const graph::ComputeLayout& layout)
    : cells_(device, layout, shaders::resolve_field_comp, "nearfield resolve field"),
      points_(device, layout, shaders::resolve_field_points_comp, "nearfield resolve field points"),
      gradients_(device, layout, shaders::collect_gradients_comp, "nearfield collect gradients") {}

void ResolveField::declare_cells(TileGraph& graph, graph::Handle input, FieldImages images,
                                 graph::Handle& field) const {
    std::vector<graph::Bound> bound = bound_to(input, images);
    bound.push_back({3, field, write});
    add_pass(graph, "resolve field", cells_, bound,
             [](const ComputeShader& shader, const graph::PassCommands& commands,
                const RecordContext& context) {
                 for (std::size_t encoding = 0; encoding < plan::sign_encodings; ++encoding) {
                     const auto sign = static_cast<SignEncoding>(encoding);
                     const std::size_t list = plan::group_list(sign);
                     if (!context.batch.raster.groups[list].empty()) {
                         shader.bind_set(commands, commands.set(encoding));
                         shader.dispatch_groups<plan::ResolveFieldPush>(commands, context.batch,
                                                                        list, sign_mask(sign));
                     }
                 }
             });
}

void ResolveField::declare_points(TileGraph& graph, graph::Handle input, FieldImages images,
                                  graph::Handle& field) const {
    std::vector<graph::Bound> bound = bound_to(input, images);
    bound.push_back({2, input, read, input_parts::field_points});
    bound.push_back({3, field, write});
    add_pass(graph, "resolve field points", points_, bound,
             [](const ComputeShader& shader, const graph::PassCommands& commands,
                const RecordContext& context) {
                 for (const plan::FieldPointRun& run : context.batch.field_point_runs) {
                     shader.bind_set(commands, commands.set(static_cast<std::size_t>(run.sign)));
                     shader.dispatch_elements<plan::ResolveFieldPointsPush>(
                         commands, run.first, run.first + run.count, sign_mask(run.sign),
                         run.first_word, run.first, run.parts.words_per_point,
                         run.parts.cells_per_point);
                 }
             });
}

void ResolveField::declare_gradients(TileGraph& graph, graph::Handle input, graph::Handle gradients,
                                     graph::Handle& field) const {
    add_pass(graph, "collect gradients", gradients_,
             {{0, input, read, input_parts::tiles},
              {2, input, read, input_parts::field_points},
              {4, gradients, Access::sampled_in_compute},
              {3, field, write}},
             dispatch_gradients);
}

}  // namespace nearfield::passes
