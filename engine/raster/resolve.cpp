#include <engine/raster/field_drawings.hpp>
#include <engine/raster/resolve.hpp>
#include <passes/compute_shader.hpp>

#include <shaders/collect_colors_comp.hpp>
#include <shaders/collect_comp.hpp>
#include <shaders/collect_gradients_comp.hpp>
#include <shaders/resolve_field_comp.hpp>
#include <shaders/resolve_field_points_comp.hpp>
#include <shaders/resolve_points_comp.hpp>

#include <algorithm>
#include <vector>

namespace nearfield::raster {

using graph::Access;
using passes::ComputeShader;
using passes::read;
using passes::write;

namespace {

/// The bits of a texel of an encoding's sign image that are set inside B.
std::uint32_t sign_mask(SignEncoding encoding) {
    switch (encoding) {
        case SignEncoding::color:
            return white_mask;
        case SignEncoding::feature_bit:
            return shaders::feature_bit_mask;
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

/// Dispatches one workgroup for each shaders::CellGroup of a list, in as many dispatches as the
/// device's limits require. The push constants of each, a structure of shaders/push.h, are the
/// position of its first group, and `words`.
template <class Push, class... Words>
void dispatch_groups(const ComputeShader& shader, VkCommandBuffer commands, const DrawnBatch& batch,
                     std::size_t list, Words... words) {
    const auto count = static_cast<std::uint32_t>(batch.groups[list].size());
    for (std::uint32_t first = 0; first < count; first += shaders::max_workgroups) {
        shader.push(commands, Push{batch.first_group(list) + first, words...});
        shader.dispatch(commands, std::min(count - first, shaders::max_workgroups));
    }
}

void dispatch_gradients(const ComputeShader& shader, VkCommandBuffer commands,
                        const DrawContext& context) {
    for (const device_input::FieldTile& field : context.batch.field_tiles) {
        if (field.first_gradient != shaders::not_asked) {
            const shaders::TileData& tile = context.batch.tiles[field.tile];
            shader.dispatch_elements<shaders::CollectGradientsPush>(
                commands, 0, tile.width * tile.height, field.first_gradient, 0U, 0U, field.tile);
        }
    }
    for (const device_input::FieldPointRun& run : context.batch.field_point_runs) {
        if (run.parts.blended) {
            shader.dispatch_elements<shaders::CollectGradientsPush>(
                commands, 4 * run.first, 4 * (run.first + run.count), run.first_word, run.first,
                run.parts.words_per_point, 0U);
        }
    }
}

}  // namespace

Resolve::Resolve(const gpu::Device& device, const graph::ComputeLayout& layout)
    : points_(device, layout, shaders::resolve_points_comp, "nearfield resolve points"),
      field_cells_(device, layout, shaders::resolve_field_comp, "nearfield resolve field"),
      field_points_(device, layout, shaders::resolve_field_points_comp,
                    "nearfield resolve field points"),
      gradients_(device, layout, shaders::collect_gradients_comp, "nearfield collect gradients"),
      numbers_(device, layout, shaders::collect_comp, "nearfield collect numbers"),
      colors_(device, layout, shaders::collect_colors_comp, "nearfield collect colours") {}

void Resolve::points(DrawGraph& graph, graph::Handle input, graph::Handle results,
                     FieldImages::Pair images) const {
    add_pass(graph, "resolve points", points_,
             {{0, input, read, input_parts::tiles},
              {1, input, read, input_parts::edges},
              {2, input, read, input_parts::points},
              {4, images.features, Access::sampled_in_compute},
              {5, images.sign, Access::sampled_in_compute},
              {3, results, write}},
             [](const ComputeShader& shader, VkCommandBuffer commands, const DrawContext& context) {
                 const auto count = static_cast<std::uint32_t>(context.batch.points.size());
                 shader.dispatch_elements<shaders::ResolvePointsPush>(commands, 0, count);
             });
}

void Resolve::field_cells(DrawGraph& graph, graph::Handle input, FieldImages images,
                          graph::Handle& field) const {
    std::vector<graph::Bound> bound = bound_to(input, images);
    bound.push_back({3, field, write});
    add_pass(graph, "resolve field", field_cells_, bound,
             [](const ComputeShader& shader, const graph::PassCommands& commands,
                const DrawContext& context) {
                 for (std::size_t encoding = 0; encoding < sign_encodings; ++encoding) {
                     const auto sign = static_cast<SignEncoding>(encoding);
                     const std::size_t list = group_list(sign);
                     if (!context.batch.groups[list].empty()) {
                         shader.bind_set(commands, commands.set(encoding));
                         dispatch_groups<shaders::ResolveFieldPush>(shader, commands, context.batch,
                                                                    list, sign_mask(sign));
                     }
                 }
             });
}

void Resolve::field_points(DrawGraph& graph, graph::Handle input, FieldImages images,
                           graph::Handle& field) const {
    std::vector<graph::Bound> bound = bound_to(input, images);
    bound.push_back({2, input, read, input_parts::field_points});
    bound.push_back({3, field, write});
    add_pass(graph, "resolve field points", field_points_, bound,
             [](const ComputeShader& shader, const graph::PassCommands& commands,
                const DrawContext& context) {
                 for (const device_input::FieldPointRun& run : context.batch.field_point_runs) {
                     shader.bind_set(commands, commands.set(static_cast<std::size_t>(run.sign)));
                     shader.dispatch_elements<shaders::ResolveFieldPointsPush>(
                         commands, run.first, run.first + run.count, sign_mask(run.sign),
                         run.first_word, run.first, run.parts.words_per_point,
                         run.parts.cells_per_point);
                 }
             });
}

void Resolve::gradients(DrawGraph& graph, graph::Handle input, graph::Handle gradients,
                        graph::Handle& field) const {
    add_pass(graph, "collect gradients", gradients_,
             {{0, input, read, input_parts::tiles},
              {2, input, read, input_parts::field_points},
              {4, gradients, Access::sampled_in_compute},
              {3, field, write}},
             dispatch_gradients);
}

void Resolve::samples(DrawGraph& graph, graph::Handle input, graph::Handle hits,
                      graph::Handle& samples, IntersectionStrategy strategy) const {
    add_pass(graph, "collect", strategy == IntersectionStrategy::blend ? colors_ : numbers_,
             {{0, input, read, input_parts::tiles},
              {4, hits, Access::sampled_in_compute},
              {2, samples, write, passes::sample_parts::summaries},
              {3, samples, write, passes::sample_parts::samples}},
             [strategy](const ComputeShader& shader, VkCommandBuffer commands,
                        const DrawContext& context) {
                 dispatch_groups<shaders::CollectPush>(shader, commands, context.batch,
                                                       group_list(strategy),
                                                       context.sample_capacity);
             });
}

}  // namespace nearfield::raster
