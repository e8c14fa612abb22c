#include <engine/raster/drawn_graph.hpp>

#include <shaders/number_frag.hpp>

#include <algorithm>
#include <functional>

namespace nearfield::raster {

using graph::Handle;

Pipelines::Pipelines(const gpu::Device& device, const graph::ComputeLayout& layout)
    : number_render_pass_(
          make_prototype(device, number_format, device.stencil_format(), "stencil")),
      draw_layout_(make_draw_layout(device)),
      stencil_(device, draw_layout_.get(), number_render_pass_.get(), shaders::number_frag,
               "stencil"),
      fields(device, layout, draw_layout_.get(), stencil_),
      intersect(device, draw_layout_.get(), number_render_pass_.get(), stencil_),
      resolve(device, layout) {}

DrawKey::DrawKey(const DrawnBatch& batch)
    : points(!batch.points.empty()),
      field_points(!batch.field_point_runs.empty()),
      blended(batch.meshes.range(TileMeshId::gradients).count > 0) {
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        overlap[i] = !batch.overlaps[i].empty();
    }
    for (const device_input::FieldTile& tile : batch.field_tiles) {
        field[static_cast<std::size_t>(tile.sign)] = true;
        field_cells = field_cells || tile.first_value != shaders::not_asked ||
                      tile.first_feature != shaders::not_asked;
    }
}

DrawnGraph::DrawnGraph(const gpu::Device& device, const Pipelines& passes, const DrawKey& needs,
                       VkExtent2D extent)
    : needs_(needs), extent_(extent) {
    input_ = import_buffer({"input", true, false});
    mesh_ = import_buffer({"mesh", true, false});
    const FieldImages images = draw_fields(passes.fields);
    if (needs_.points) {
        outputs_.results = import_buffer({"point results", false, true});
        passes.resolve.points(*this, input_, outputs_.results, images.by_encoding.front());
    }
    if (needs_.field_cells || needs_.field_points) {
        outputs_.field = import_buffer({"field results", false, true});
        resolve_fields(passes, images);
    }
    if (std::any_of(needs_.overlap.begin(), needs_.overlap.end(), std::identity())) {
        declare_overlaps(passes);
    }
    compile(device);
}

/// Points read the images of the first encoding, the stencil's.
FieldImages DrawnGraph::draw_fields(const FieldDrawings& drawings) {
    const bool by_stencil = needs_.points || needs_.field_by(SignEncoding::stencil);
    const bool by_color = needs_.field_by(SignEncoding::color);
    FieldImages images;
    auto& [stencil, color, feature_bit] = images.by_encoding;
    if (by_stencil) {
        stencil.sign = drawings.fill(canvas());
    }
    if (by_color) {
        color.sign = drawings.color_fill(canvas());
    }
    if (by_stencil || by_color) {
        const Handle features = drawings.features(canvas());
        stencil.features = by_stencil ? features : Handle{};
        color.features = by_color ? features : Handle{};
    }
    if (needs_.field_by(SignEncoding::feature_bit)) {
        feature_bit.features = feature_bit.sign = drawings.signed_features(canvas());
    }
    return images;
}

void DrawnGraph::resolve_fields(const Pipelines& passes, FieldImages images) {
    if (!needs_.field_by(SignEncoding::stencil)) {
        images.by_encoding.front() = {};  // drawn for points of penetration
    }
    Handle field = outputs_.field;
    if (needs_.field_cells) {
        passes.resolve.field_cells(*this, input_, images, field);
    }
    if (needs_.field_points) {
        passes.resolve.field_points(*this, input_, images, field);
    }
    if (needs_.blended) {
        const Handle gradients = passes.fields.gradients(canvas(), field);
        passes.resolve.gradients(*this, input_, gradients, field);
    }
}

void DrawnGraph::declare_overlaps(const Pipelines& passes) {
    outputs_.samples = import_buffer({"samples", true, true});
    Handle samples = outputs_.samples;
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        const auto strategy = static_cast<IntersectionStrategy>(i);
        if (!needs_.overlap[i]) {
            continue;
        }
        const Handle hits = passes.intersect.draw(canvas(), strategy);
        if (strategy == IntersectionStrategy::stencil || strategy == IntersectionStrategy::depth) {
            passes.intersect.copy_passed(*this, samples, strategy);
        }
        passes.resolve.samples(*this, input_, hits, samples, strategy);
    }
}

}  // namespace nearfield::raster
