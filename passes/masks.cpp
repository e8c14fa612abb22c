#include <engine/gpu/pipeline.hpp>
#include <passes/masks.hpp>

#include <shaders/collect_masks_comp.hpp>
#include <shaders/mask_edges_comp.hpp>
#include <shaders/mask_polygons_comp.hpp>
#include <shaders/mask_rows_comp.hpp>

#include <algorithm>

namespace nearfield::passes {
namespace {

// The flag in the push constants of mask_polygons.comp.
constexpr std::uint32_t of_a_flag = 256;

}  // namespace

Masks::Masks(const gpu::Device& device, const ComputeLayout& layout, const RecordContext& context)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      context_(&context),
      edges_(gpu::make_compute_pipeline(device, layout_, shaders::mask_edges_comp,
                                        "nearfield mask edges")),
      rows_(gpu::make_compute_pipeline(device, layout_, shaders::mask_rows_comp,
                                       "nearfield mask rows")),
      polygons_(gpu::make_compute_pipeline(device, layout_, shaders::mask_polygons_comp,
                                           "nearfield mask polygons")),
      collect_(gpu::make_compute_pipeline(device, layout_, shaders::collect_masks_comp,
                                          "nearfield collect masks")) {}

void Masks::bind(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                      &context_->masks, 0, nullptr);
}

template <std::size_t Count>
void Masks::dispatch(VkCommandBuffer commands, std::uint32_t count,
                     const std::uint32_t (&words)[Count]) const {
    const gpu::Functions& functions = device_->functions();
    std::uint32_t push[2 + Count];
    static_assert(sizeof(push) <= ComputeLayout::push_bytes);
    std::copy_n(words, Count, push + 2);
    dispatch_points(functions, commands, 0, count, [&](std::uint32_t first) {
        push[0] = first;
        push[1] = count;
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), push);
    });
}

graph::Handle Masks::declare_clear(graph::Graph& graph, graph::Handle scratch) const {
    graph.add_pass(
        "clear masks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            scratch = pass.write(scratch, graph::Access::transfer_write);
        },
        [this](VkCommandBuffer commands) { record_clear(commands); });
    return scratch;
}

// The scratch memory belongs to the tile batch, whose former use has been waited for.
void Masks::record_clear(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    const plan::ComputeWork& work = context_->round->compute;
    const auto fill = [&](std::uint64_t first, std::uint64_t words, std::uint32_t value) {
        if (words > 0) {
            functions.vkCmdFillBuffer(commands, context_->scratch, first * sizeof(value),
                                      words * sizeof(value), value);
        }
    };
    fill(0, work.mask_words, 0);
    fill(work.mask_words, work.run_words, UINT32_MAX);
}

graph::Handle Masks::declare_fill(graph::Graph& graph, graph::Handle input,
                                  graph::Handle scratch) const {
    const auto add = [&](const char* name, graph::Record record) {
        graph.add_pass(
            name, graph::PassKind::compute,
            [&](graph::PassBuilder& pass) {
                pass.read(input, graph::Access::storage_read_in_compute);
                scratch = pass.write(scratch, graph::Access::storage_write_in_compute);
            },
            std::move(record));
    };
    add("mark edges", [this](VkCommandBuffer commands) {
        const auto ranges = context_->round->compute.ranges();
        bind(commands, edges_);
        dispatch(commands, ranges.edges.count,
                 {ranges.edges.first_word, ranges.masks.first_word, context_->subpixel_bits});
    });
    add("fill rows", [this](VkCommandBuffer commands) {
        const auto ranges = context_->round->compute.ranges();
        bind(commands, rows_);
        dispatch(commands, ranges.rows.count, {ranges.rows.first_word});
    });
    return scratch;
}

graph::Handle Masks::declare_boundaries_b(graph::Graph& graph, graph::Handle input,
                                          graph::Handle scratch) const {
    graph.add_pass(
        "boundaries of B", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            scratch = pass.write(scratch, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { record_polygons(commands, false); });
    return scratch;
}

graph::Handle Masks::declare_boundaries_a(graph::Graph& graph, graph::Handle input,
                                          graph::Handle scratch) const {
    graph.add_pass(
        "boundaries of A", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            scratch = pass.write(scratch, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { record_polygons(commands, true); });
    return scratch;
}

void Masks::record_polygons(VkCommandBuffer commands, bool of_a) const {
    const plan::ComputeWork& work = context_->round->compute;
    const auto ranges = work.ranges();
    const plan::WorkRange& polygons = of_a ? ranges.polygons_a : ranges.polygons_b;
    bind(commands, polygons_);
    dispatch(commands, polygons.count,
             {polygons.first_word, ranges.masks.first_word, ranges.overlaps.first_word,
              static_cast<std::uint32_t>(work.mask_words),
              context_->subpixel_bits | (of_a ? of_a_flag : 0U)});
}

graph::Handle Masks::declare_collect(graph::Graph& graph, graph::Handle input,
                                     graph::Handle scratch, graph::Handle samples) const {
    graph.add_pass(
        "collect masks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(scratch, graph::Access::storage_read_in_compute);
            samples = pass.write(samples, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) {
            const plan::ComputeWork& work = context_->round->compute;
            const auto ranges = work.ranges();
            bind(commands, collect_);
            dispatch(commands, ranges.overlap_rows.count,
                     {ranges.overlap_rows.first_word, ranges.masks.first_word,
                      ranges.overlaps.first_word, static_cast<std::uint32_t>(work.mask_words),
                      context_->sample_capacity});
        });
    return samples;
}

}  // namespace nearfield::passes
