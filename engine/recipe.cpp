#include <engine/failure.hpp>
#include <engine/graph/print.hpp>
#include <engine/recipe.hpp>
#include <passes/tile_renderer.hpp>

#include <utility>

namespace nearfield {
namespace {

using graph::Handle;

/// The baked form of a graph of our own; that it bakes is an invariant.
graph::BakedGraph baked_form(const graph::Graph& graph) {
    Expected<graph::BakedGraph> baked = graph::bake(graph);
    if (!baked.ok()) {
        throw Failure(baked.status());
    }
    return std::move(*baked);
}

/// A render pass with one number image and one depth-stencil image.
gpu::Owned<VkRenderPass> make_prototype(const gpu::Device& device, VkFormat depth_stencil) {
    graph::Graph graph;
    const Handle color = graph.create_image({"prototype colour", passes::number_format, {1, 1}});
    const Handle depth = graph.create_image({"prototype depth", depth_stencil, {1, 1}});
    graph.add_pass(
        "prototype", graph::PassKind::graphics,
        [&](graph::PassBuilder& pass) {
            static_cast<void>(pass.write(color, graph::Access::color_attachment));
            static_cast<void>(pass.write(depth, graph::Access::depth_stencil_attachment));
        },
        [](VkCommandBuffer) {});
    return graph::make_render_pass(device, graph, baked_form(graph).passes.front());
}

}  // namespace

Passes::Passes(const gpu::Device& device, const passes::ComputeLayout& layout,
               const passes::Frame& frame)
    : stencil_render_pass_(make_prototype(device, device.stencil_format())),
      distance_render_pass_(make_prototype(device, passes::distance_depth_format)),
      draw_layout_(passes::make_draw_layout(device)),
      stencil_(device, draw_layout_.get(), stencil_render_pass_.get()),
      fill(device, draw_layout_.get(), stencil_, frame),
      cone_mesh(device, draw_layout_.get(), distance_render_pass_.get(), frame),
      intersect(device, draw_layout_.get(), stencil_, frame),
      resolve_points(device, layout, frame),
      resolve_field(device, layout, frame),
      collect(device, layout, frame) {}

Recipe::Recipe(const gpu::Device& device, const Passes& passes, Needs needs, VkExtent2D extent)
    : needs_(needs), extent_(extent) {
    mesh_ = graph_.import_buffer({"mesh", true, false});
    input_ = graph_.import_buffer({"input", true, false});
    if (needs.points || needs.field) {
        sign_ = passes.fill.declare(graph_, mesh_, extent);
        features_ = passes.cone_mesh.declare(graph_, mesh_, extent);
    }
    if (needs.points) {
        results_ = graph_.import_buffer({"point results", false, true});
        passes.resolve_points.declare(graph_, input_, features_, sign_, results_);
    }
    if (needs.field) {
        values_ = graph_.import_buffer({"field values", false, true});
        passes.resolve_field.declare(graph_, input_, features_, sign_, values_);
    }
    if (needs.overlap) {
        hits_ = passes.intersect.declare(graph_, mesh_, extent);
        samples_ = graph_.import_buffer({"samples", true, true});
        passes.collect.declare(graph_, input_, hits_, samples_);
    }
    executor_ = std::make_unique<graph::Executor>(device, graph_, baked_form(graph_));
}

void Recipe::set_buffers(VkBuffer mesh, VkBuffer input, VkBuffer read_back) {
    executor_->set_buffer(mesh_, mesh);
    executor_->set_buffer(input_, input);
    for (const Handle handle : {results_, values_, samples_}) {
        if (handle != Handle{}) {
            executor_->set_buffer(handle, read_back);
        }
    }
}

void Recipe::bind_images(const passes::ComputeLayout& layout, const passes::Frame& frame) const {
    using Layout = passes::ComputeLayout;
    for (const auto& [needed, set] :
         {std::pair{needs_.points, frame.points}, std::pair{needs_.field, frame.field}}) {
        if (needed) {
            layout.write_image(set, Layout::image, executor_->sampled_view(features_));
            layout.write_image(set, Layout::sign_image, executor_->sampled_view(sign_));
        }
    }
    if (needs_.overlap) {
        layout.write_image(frame.samples, Layout::image, executor_->sampled_view(hits_));
    }
}

std::string Recipe::print(GraphFormat format) const {
    return format == GraphFormat::text ? graph::print_text(graph_, executor_->baked())
                                       : graph::print_graphviz(graph_, executor_->baked());
}

}  // namespace nearfield
