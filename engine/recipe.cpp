#include <engine/failure.hpp>
#include <engine/graph/print.hpp>
#include <engine/recipe.hpp>
#include <passes/prototype.hpp>
#include <passes/tile_renderer.hpp>

#include <shaders/number_frag.hpp>

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

}  // namespace

Passes::Passes(const gpu::Device& device, const passes::ComputeLayout& layout,
               const passes::Frame& frame)
    : stencil_render_pass_(passes::make_prototype(device, passes::number_format,
                                                  device.stencil_format(), "stencil")),
      distance_render_pass_(passes::make_prototype(device, passes::number_format,
                                                   passes::distance_depth_format, "distance")),
      draw_layout_(passes::make_draw_layout(device)),
      stencil_(device, draw_layout_.get(), stencil_render_pass_.get(), shaders::number_frag,
               "stencil"),
      strategies_(device, draw_layout_.get(), stencil_render_pass_.get(), stencil_),
      fill(device, draw_layout_.get(), stencil_, frame),
      cone_mesh(device, draw_layout_.get(), distance_render_pass_.get(), frame),
      early_out(device, frame),
      intersect(device, draw_layout_.get(), strategies_, early_out, frame),
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
    if (needs.overlap != Needs{}.overlap) {
        samples_ = graph_.import_buffer({"samples", true, true});
        Handle collected = samples_;
        for (std::size_t i = 0; i < intersection_strategies; ++i) {
            const auto strategy = static_cast<IntersectionStrategy>(i);
            if (needs.overlap[i]) {
                hits_[i] = passes.intersect.declare(graph_, mesh_, extent, strategy);
                if (strategy == IntersectionStrategy::stencil ||
                    strategy == IntersectionStrategy::depth) {
                    collected = passes.early_out.declare(graph_, collected, strategy);
                }
                collected = passes.collect.declare(graph_, input_, hits_[i], collected, strategy);
            }
        }
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
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        if (needs_.overlap[i]) {
            layout.write_image(frame.samples[i], Layout::image, executor_->sampled_view(hits_[i]));
        }
    }
}

std::string Recipe::print(GraphFormat format) const {
    return format == GraphFormat::text ? graph::print_text(graph_, executor_->baked())
                                       : graph::print_graphviz(graph_, executor_->baked());
}

}  // namespace nearfield
