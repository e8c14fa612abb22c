#include <engine/render/pipeline_set.hpp>
#include <passes/prototype.hpp>
#include <passes/tile_renderer.hpp>

#include <shaders/number_frag.hpp>

#include <algorithm>
#include <cstddef>

namespace nearfield::render {

RasterPipelines::RasterPipelines(const gpu::Device& device, const graph::ComputeLayout& layout)
    : stencil_render_pass_(passes::make_prototype(device, passes::number_format,
                                                  device.stencil_format(), "stencil")),
      distance_render_pass_(passes::make_prototype(device, passes::number_format,
                                                   passes::distance_depth_format, "distance")),
      white_render_pass_(
          passes::make_prototype(device, passes::white_format, VK_FORMAT_UNDEFINED, "white")),
      signed_feature_render_pass_(passes::make_prototype(
          device, passes::signed_feature_format, passes::distance_depth_format, "signed feature")),
      gradient_render_pass_(passes::make_prototype(device, device.gradient_format(),
                                                   VK_FORMAT_UNDEFINED, "gradient")),
      draw_layout_(passes::make_draw_layout(device)),
      stencil_(device, draw_layout_.get(), stencil_render_pass_.get(), shaders::number_frag,
               "stencil"),
      strategies_(device, draw_layout_.get(), stencil_render_pass_.get(), stencil_),
      fill(device, draw_layout_.get(), stencil_),
      color_fill(device, draw_layout_.get(), white_render_pass_.get()),
      cone_mesh(device, draw_layout_.get(), distance_render_pass_.get()),
      feature_bit(device, draw_layout_.get(), signed_feature_render_pass_.get()),
      gradient(device, layout, gradient_render_pass_.get()),
      early_out(device),
      intersect(device, draw_layout_.get(), strategies_, early_out),
      resolve_points(device, layout),
      resolve_field(device, layout),
      collect(device, layout) {}

ExportPipelines::ExportPipelines(const gpu::Device& device, const graph::ComputeLayout& layout)
    : copy_back(device),
      field(device, layout),
      records(device, layout),
      samples(device, layout),
      headers(device, layout) {}

const passes::PairSearch& PipelineSet::pair_search(const plan::PairSearchKind& kind) const {
    const auto found =
        std::find(plan::pair_search_kinds.begin(), plan::pair_search_kinds.end(), kind);
    auto& search =
        pair_searches_[static_cast<std::size_t>(found - plan::pair_search_kinds.begin())];
    if (search) {
        return *search;
    }
    const passes::FoundPairShaders* const finding =
        kind.are_given() ? nullptr : &made(found_pair_shaders_, &instance_shaders());
    return made(search, &made(search_shaders_), finding, kind);
}

const passes::WorldQueries& PipelineSet::world_queries(plan::WorldQuestion question) const {
    return made(world_queries_[static_cast<std::size_t>(question)], &instance_shaders(), question);
}

void PipelineSet::make(const DeviceTechniques& techniques) const {
    static_cast<void>(exports());
    if (techniques.raster) {
        static_cast<void>(raster());
    }
    if (techniques.compute) {
        static_cast<void>(masks());
        static_cast<void>(fields());
        static_cast<void>(pair_poses());
        static_cast<void>(export_pairs());
        for (const plan::PairSearchKind& kind : plan::pair_search_kinds) {
            static_cast<void>(pair_search(kind));
        }
        for (std::size_t question = 0; question < plan::world_questions; ++question) {
            static_cast<void>(world_queries(static_cast<plan::WorldQuestion>(question)));
        }
    }
}

}  // namespace nearfield::render
