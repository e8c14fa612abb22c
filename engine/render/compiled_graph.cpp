#include <engine/render/compiled_graph.hpp>

namespace nearfield::render {
using graph::Handle;

CompiledGraph::CompiledGraph(const gpu::Device& device, const PipelineSet& passes, GraphKey needs,
                             VkExtent2D extent)
    : needs_(needs), extent_(extent) {
    input_ = graph_.import_buffer({"input", true, false});
    if (needs.compute != ComputeKey{}) {
        declare_compute(passes);
    } else {
        declare_drawn(passes.raster());
    }
    graph_.compile(device);
}

void CompiledGraph::declare_compute(const PipelineSet& passes) {
    const ComputeKey& needs = needs_.compute;
    if (needs.points) {
        results_ = graph_.import_buffer({"point results", false, true});
        passes.resolve_points().declare(graph_, input_, results_);
    }
    if (needs.fields || needs.field_points || needs.overlap) {
        shapes_ = graph_.import_buffer({"shapes in tiles", true, false});
    }
    if (needs.fields || needs.field_points) {
        long_searches_ = graph_.import_buffer({"long searches", true, true});
        field_ = graph_.import_buffer({"field results", false, true});
    }
    passes::Fields::Output output{long_searches_, field_};
    if (needs.fields || needs.overlap) {
        output = declare_masked(passes, output);
    }
    if (needs.field_points) {
        static_cast<void>(passes.fields().declare_points(graph_, shapes_, output));
    }
}

passes::Fields::Output CompiledGraph::declare_masked(const PipelineSet& passes,
                                                     passes::Fields::Output output) {
    const ComputeKey& needs = needs_.compute;
    // The pass that exports samples reads the masks once more.
    scratch_ = needs_.keeps_hits
                   ? graph_.import_buffer({"scratch"}, {{}, graph::Access::storage_read_in_compute})
                   : graph_.import_buffer({"scratch", false, false});
    Handle scratch = passes.masks().declare_clear(graph_, scratch_);
    scratch = passes.masks().declare_shapes(graph_, shapes_, scratch);
    if (needs.fields) {
        scratch = passes.masks().declare_fill(graph_, input_, scratch);
    }
    if (needs.overlap) {
        samples_ = graph_.import_buffer({"samples", true, true});
        scratch = passes.masks().declare_collect(graph_, {input_, scratch, samples_});
    }
    return needs.fields ? declare_cells(passes.fields(), scratch, output) : output;
}

passes::Fields::Output CompiledGraph::declare_cells(const passes::Fields& fields, Handle scratch,
                                                    passes::Fields::Output output) {
    crowd_ = graph_.import_buffer({"crowded blocks", true, false});
    const passes::Fields::Buffers buffers =
        fields.declare_lists(graph_, {shapes_, scratch, crowd_});
    if (needs_.compute.field_values) {
        output.field = fields.declare_values(graph_, buffers, output.field);
    }
    if (needs_.compute.field_features) {
        output.field = fields.declare_features(graph_, buffers, output.field);
    }
    return fields.declare_crowded(graph_, buffers, output);
}

void CompiledGraph::declare_drawn(const RasterPipelines& passes) {
    mesh_ = graph_.import_buffer({"mesh", true, false});
    declare_images(passes);
    if (needs_.points) {
        results_ = graph_.import_buffer({"point results", false, true});
        const auto& [features, sign] = images_.by_encoding.front();
        passes.resolve_points.declare(graph_, input_, results_, features, sign);
    }
    if (needs_.any_field()) {
        field_ = graph_.import_buffer({"field results", false, true});
        declare_field(passes);
    }
    if (needs_.overlap != GraphKey{}.overlap) {
        samples_ = graph_.import_buffer({"samples", true, true});
        if (needs_.keeps_hits) {
            // Read once more by the pass that exports samples.
            kept_hits_ =
                graph_.import_buffer({"kept hits"}, {{}, graph::Access::storage_read_in_compute});
        }
        passes::Collect::Output collected{samples_, kept_hits_};
        for (std::size_t i = 0; i < intersection_strategies; ++i) {
            const auto strategy = static_cast<IntersectionStrategy>(i);
            if (needs_.overlap[i]) {
                hits_[i] = passes.intersect.declare(graph_, mesh_, extent_, strategy);
                if (strategy == IntersectionStrategy::stencil ||
                    strategy == IntersectionStrategy::depth) {
                    collected.samples =
                        passes.early_out.declare(graph_, collected.samples, strategy);
                }
                collected = passes.collect.declare(graph_, input_, hits_[i], collected, strategy);
            }
        }
    }
}

/// Points read the images of the first encoding, the stencil's.
void CompiledGraph::declare_images(const RasterPipelines& passes) {
    const bool by_stencil = needs_.points || needs_.field_by(SignEncoding::stencil);
    const bool by_color = needs_.field_by(SignEncoding::color);
    auto& [stencil, color, feature_bit] = images_.by_encoding;
    if (by_stencil) {
        stencil.sign = passes.fill.declare(graph_, mesh_, extent_);
    }
    if (by_color) {
        color.sign = passes.color_fill.declare(graph_, mesh_, extent_);
    }
    if (by_stencil || by_color) {
        const Handle features = passes.cone_mesh.declare(graph_, mesh_, extent_);
        stencil.features = by_stencil ? features : Handle{};
        color.features = by_color ? features : Handle{};
    }
    if (needs_.field_by(SignEncoding::feature_bit)) {
        feature_bit.features = passes.feature_bit.declare(graph_, mesh_, extent_);
        feature_bit.sign = feature_bit.features;
    }
}

void CompiledGraph::declare_field(const RasterPipelines& passes) {
    passes::FieldImages images = images_;
    if (!needs_.field_by(SignEncoding::stencil)) {
        images.by_encoding.front() = {};  // drawn for points of penetration
    }
    Handle field = field_;
    if (needs_.field_cells) {
        field = passes.resolve_field.declare(graph_, input_, images, field);
    }
    if (needs_.field_points) {
        field = passes.resolve_field_points.declare(graph_, input_, images, field);
    }
    if (needs_.blended) {
        gradients_ = passes.gradient.declare(graph_, mesh_, field, extent_);
        field = passes.collect_gradients.declare(graph_, input_, gradients_, field);
    }
}

void CompiledGraph::set_buffers(const Buffers& buffers) {
    const auto set = [&](Handle handle, VkBuffer buffer) {
        if (handle != Handle{}) {
            graph_.executor().set_buffer(handle, buffer);
        }
    };
    set(mesh_, buffers.mesh);
    set(input_, buffers.input);
    set(scratch_, buffers.scratch);
    set(shapes_, buffers.shapes);
    set(crowd_, buffers.crowd);
    set(long_searches_, buffers.long_searches);
    set(results_, buffers.words);
    set(field_, buffers.words);
    set(samples_, buffers.read_back);
    set(kept_hits_, buffers.hits);
}

void CompiledGraph::bind_images(const passes::ComputeLayout& layout,
                                const passes::TileBatchSets& sets) const {
    using Layout = passes::ComputeLayout;
    const auto bind_pair = [&](VkDescriptorSet set, const passes::FieldImages::Pair& images) {
        layout.write_image(set, Layout::image, graph_.executor().sampled_view(images.features));
        layout.write_image(set, Layout::sign_image, graph_.executor().sampled_view(images.sign));
    };
    if (needs_.points) {
        bind_pair(sets.points, images_.by_encoding.front());
    }
    for (std::size_t encoding = 0; encoding < plan::sign_encodings; ++encoding) {
        if (needs_.field[encoding]) {
            bind_pair(sets.field[encoding], images_.by_encoding[encoding]);
        }
    }
    if (needs_.blended) {
        layout.write_image(sets.gradients, Layout::image,
                           graph_.executor().sampled_view(gradients_));
    }
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        if (needs_.overlap[i]) {
            layout.write_image(sets.samples[i], Layout::image,
                               graph_.executor().sampled_view(hits_[i]));
        }
    }
}

}  // namespace nearfield::render
