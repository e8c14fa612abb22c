#include <engine/render/compiled_graph.hpp>

namespace nearfield::render {
using graph::Handle;

CompiledGraph::CompiledGraph(const gpu::Device& device, const PipelineSet& passes, GraphKey needs,
                             VkExtent2D extent)
    : needs_(needs), extent_(extent) {
    if (needs.compute != ComputeKey{}) {
        declare_compute(passes);
    } else {
        declare_drawn(passes.raster());
    }
    graph_.compile(device);
}

void CompiledGraph::declare_compute(const PipelineSet& passes) {
    const ComputeKey& needs = needs_.compute;
    handles_.shapes = graph_.import_buffer({"shapes in tiles", true, false});
    if (needs.fields || needs.field_points) {
        handles_.long_searches = graph_.import_buffer({"long searches", true, true});
        handles_.field = graph_.import_buffer({"field results", false, true});
    }
    passes::Fields::Output output{handles_.long_searches, handles_.field};
    if (needs.fields || needs.overlap) {
        declare_masked(passes, output);
    }
    if (needs.field_points) {
        passes.fields().declare_points(graph_, handles_.shapes, output);
    }
}

void CompiledGraph::declare_masked(const PipelineSet& passes, passes::Fields::Output& output) {
    const ComputeKey& needs = needs_.compute;
    // The pass that exports samples reads the masks once more.
    handles_.scratch =
        needs.keeps_hits
            ? graph_.import_buffer({"scratch"}, {{}, graph::Access::storage_read_in_compute})
            : graph_.import_buffer({"scratch", false, false});
    Handle scratch = handles_.scratch;
    passes.masks().declare_clear(graph_, scratch);
    passes.masks().declare_shapes(graph_, handles_.shapes, scratch);
    if (needs.fields) {
        passes.fields().declare_fill(graph_, handles_.shapes, scratch);
    }
    if (needs.overlap) {
        handles_.samples = graph_.import_buffer({"samples", true, true});
        passes.masks().declare_collect(graph_, handles_.shapes, scratch, handles_.samples);
    }
    if (needs.fields) {
        declare_cells(passes.fields(), scratch, output);
    }
}

void CompiledGraph::declare_cells(const passes::Fields& fields, Handle scratch,
                                  passes::Fields::Output& output) {
    handles_.crowd = graph_.import_buffer({"crowded blocks", true, false});
    passes::Fields::Buffers buffers{handles_.shapes, scratch, handles_.crowd};
    fields.declare_lists(graph_, buffers);
    if (needs_.compute.field_values) {
        fields.declare_values(graph_, buffers, output.field);
    }
    if (needs_.compute.field_features) {
        fields.declare_features(graph_, buffers, output.field);
    }
    fields.declare_crowded(graph_, buffers, output);
}

void CompiledGraph::declare_drawn(const RasterPipelines& passes) {
    handles_.input = graph_.import_buffer({"input", true, false});
    handles_.mesh = graph_.import_buffer({"mesh", true, false});
    const passes::FieldImages images = declare_images(passes);
    if (needs_.points) {
        handles_.results = graph_.import_buffer({"point results", false, true});
        const auto& [features, sign] = images.by_encoding.front();
        passes.resolve_points.declare(graph_, handles_.input, handles_.results, features, sign);
    }
    if (needs_.any_field()) {
        handles_.field = graph_.import_buffer({"field results", false, true});
        declare_field(passes, images);
    }
    if (needs_.overlap != GraphKey{}.overlap) {
        declare_overlaps(passes);
    }
}

void CompiledGraph::declare_overlaps(const RasterPipelines& passes) {
    handles_.samples = graph_.import_buffer({"samples", true, true});
    Handle samples = handles_.samples;
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        const auto strategy = static_cast<IntersectionStrategy>(i);
        if (!needs_.overlap[i]) {
            continue;
        }
        const Handle hits = passes.intersect.declare(graph_, handles_.mesh, extent_, strategy);
        if (strategy == IntersectionStrategy::stencil || strategy == IntersectionStrategy::depth) {
            passes.early_out.declare(graph_, samples, strategy);
        }
        passes.collect.declare(graph_, handles_.input, hits, samples, strategy);
    }
}

/// Points read the images of the first encoding, the stencil's.
passes::FieldImages CompiledGraph::declare_images(const RasterPipelines& passes) {
    const bool by_stencil = needs_.points || needs_.field_by(SignEncoding::stencil);
    const bool by_color = needs_.field_by(SignEncoding::color);
    passes::FieldImages images;
    auto& [stencil, color, feature_bit] = images.by_encoding;
    if (by_stencil) {
        stencil.sign = passes.fill.declare(graph_, handles_.mesh, extent_);
    }
    if (by_color) {
        color.sign = passes.color_fill.declare(graph_, handles_.mesh, extent_);
    }
    if (by_stencil || by_color) {
        const Handle features = passes.cone_mesh.declare(graph_, handles_.mesh, extent_);
        stencil.features = by_stencil ? features : Handle{};
        color.features = by_color ? features : Handle{};
    }
    if (needs_.field_by(SignEncoding::feature_bit)) {
        feature_bit.features = passes.feature_bit.declare(graph_, handles_.mesh, extent_);
        feature_bit.sign = feature_bit.features;
    }
    return images;
}

void CompiledGraph::declare_field(const RasterPipelines& passes, passes::FieldImages images) {
    if (!needs_.field_by(SignEncoding::stencil)) {
        images.by_encoding.front() = {};  // drawn for points of penetration
    }
    Handle field = handles_.field;
    if (needs_.field_cells) {
        passes.resolve_field.declare_cells(graph_, handles_.input, images, field);
    }
    if (needs_.field_points) {
        passes.resolve_field.declare_points(graph_, handles_.input, images, field);
    }
    if (needs_.blended) {
        const Handle gradients = passes.gradient.declare(graph_, handles_.mesh, field, extent_);
        passes.resolve_field.declare_gradients(graph_, handles_.input, gradients, field);
    }
}

}  // namespace nearfield::render
