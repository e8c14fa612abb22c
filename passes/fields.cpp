#include <passes/fields.hpp>
#include <passes/search_shaders.hpp>

#include <shaders/field_blocks_by_groups_comp.hpp>
#include <shaders/field_blocks_comp.hpp>
#include <shaders/field_quarters_comp.hpp>
#include <shaders/field_regions_by_groups_comp.hpp>
#include <shaders/field_regions_comp.hpp>
#include <shaders/fields.h>
#include <shaders/resolve_blocks_comp.hpp>
#include <shaders/resolve_crowded_comp.hpp>
#include <shaders/resolve_features_comp.hpp>
#include <shaders/resolve_field_points_by_walks_comp.hpp>

#include <functional>
#include <string>

namespace nearfield::passes {

using graph::Access;

namespace {

ComputeShader make_field_shader(const gpu::Device& device, const ComputeLayout& layout,
                                gpu::Spirv code, const char* name) {
    return {device, layout, code, name, search_constants(device)};
}

void write(graph::PassBuilder& pass, Fields::Output& output) {
    output.long_searches = pass.write(output.long_searches, Access::storage_write_in_compute);
    output.field = pass.write(output.field, Access::storage_write_in_compute);
}

plan::FieldPush push_of(const RecordContext& context) {
    const plan::ComputeWork& work = context.batch.compute;
    const plan::FieldLists lists = work.field_lists();
    plan::FieldPush push{};
    push.tiles = context.shape_units;
    push.tile_count = static_cast<std::uint32_t>(work.fields.tiles.size());
    push.regions = lists.regions;
    push.quarters = lists.quarters;
    push.blocks = lists.blocks;
    push.segments = lists.segments;
    push.room = lists.room;
    push.numbers = lists.numbers;
    push.crowd = lists.crowd;
    push.resident = context.batch.resident ? 1 : 0;
    return push;
}

}  // namespace

std::vector<Fields::ListPass> Fields::make_lists(const gpu::Device& device,
                                                 const ComputeLayout& layout, bool by_groups) {
    using plan::FieldWork;
    std::vector<ListPass> lists;
    const auto add = [&](const char* name, gpu::Spirv code, std::uint32_t FieldWork::*squares) {
        const std::string shader = std::string("nearfield ") + name;
        lists.push_back({name, make_field_shader(device, layout, code, shader.c_str()), squares});
    };
    if (by_groups) {
        add("list for regions", shaders::field_regions_by_groups_comp, &FieldWork::regions);
        add("list for blocks", shaders::field_blocks_by_groups_comp, &FieldWork::quarters);
    } else {
        add("list for regions", shaders::field_regions_comp, &FieldWork::regions);
        add("list for quarters", shaders::field_quarters_comp, &FieldWork::quarters);
        add("list for blocks", shaders::field_blocks_comp, &FieldWork::blocks);
    }
    return lists;
}

Fields::Fields(const gpu::Device& device, const ComputeLayout& layout)
    : lists_by_groups_(!device.is_software()),
      lists_(make_lists(device, layout, lists_by_groups_)),
      values_(make_field_shader(device, layout, shaders::resolve_blocks_comp,
                                "nearfield resolve blocks")),
      features_(make_field_shader(device, layout, shaders::resolve_features_comp,
                                  "nearfield resolve features")),
      crowded_(make_field_shader(device, layout, shaders::resolve_crowded_comp,
                                 "nearfield resolve crowded blocks")),
      points_(make_field_shader(device, layout, shaders::resolve_field_points_by_walks_comp,
                                "nearfield resolve field points by walks")) {}

Fields::Buffers Fields::declare_lists(TileGraph& graph, Buffers buffers) const {
    for (const ListPass& list : lists_) {
        graph.add_pass(
            list.name, graph::PassKind::compute,
            [&](graph::PassBuilder& pass) {
                pass.read(buffers.input, Access::storage_read_in_compute);
                buffers.scratch = pass.write(buffers.scratch, Access::storage_write_in_compute);
                if (&list == &lists_.back()) {
                    buffers.crowd = pass.write(buffers.crowd, Access::storage_write_in_compute);
                }
            },
            [this, &list](VkCommandBuffer commands, const RecordContext& context) {
                record_list(commands, context, list);
            });
    }
    return buffers;
}

graph::Handle Fields::declare_values(TileGraph& graph, const Buffers& buffers,
                                     graph::Handle field) const {
    return graph.add_compute_pass(
        "resolve blocks",
        {{buffers.input, Access::storage_read_in_compute},
         {buffers.scratch, Access::storage_read_in_compute}},
        field, [this](VkCommandBuffer commands, const RecordContext& context) {
            dispatch(commands, context, values_,
                     std::uint64_t{plan::threads_per_block} * context.batch.compute.fields.blocks);
        });
}

graph::Handle Fields::declare_features(TileGraph& graph, const Buffers& buffers,
                                       graph::Handle field) const {
    return graph.add_compute_pass(
        "resolve features",
        {{buffers.input, Access::storage_read_in_compute},
         {buffers.scratch, Access::storage_read_in_compute}},
        field, [this](VkCommandBuffer commands, const RecordContext& context) {
            constexpr std::uint64_t cells_per_thread = 4;
            constexpr std::uint64_t threads =
                std::uint64_t{plan::block_side} * plan::block_side / cells_per_thread;
            dispatch(commands, context, features_, threads * context.batch.compute.fields.blocks);
        });
}

Fields::Output Fields::declare_crowded(TileGraph& graph, const Buffers& buffers,
                                       Output output) const {
    graph.add_pass(
        "resolve crowded blocks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(buffers.input, Access::storage_read_in_compute);
            pass.read(buffers.scratch, Access::storage_read_in_compute);
            pass.read(buffers.crowd, Access::indirect_arguments);
            write(pass, output);
        },
        std::bind_front(&Fields::record_crowded, this));
    return output;
}

Fields::Output Fields::declare_points(TileGraph& graph, graph::Handle input, Output output) const {
    graph.add_pass(
        "resolve field points by walks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, Access::storage_read_in_compute);
            write(pass, output);
        },
        std::bind_front(&Fields::record_points, this));
    return output;
}

void Fields::dispatch(VkCommandBuffer commands, const RecordContext& context,
                      const ComputeShader& shader, std::uint64_t threads) const {
    plan::FieldPush push = push_of(context);
    push.end = static_cast<std::uint32_t>(threads);
    shader.bind(commands, context.sets.fields);
    shader.dispatch_in_parts(commands, 0, push.end, [&](std::uint32_t first) {
        push.first = first;
        shader.push(commands, push);
    });
}

void Fields::record_list(VkCommandBuffer commands, const RecordContext& context,
                         const ListPass& list) const {
    const std::uint32_t squares = context.batch.compute.fields.*list.squares;
    if (!lists_by_groups_) {
        dispatch(commands, context, list.shader, squares);
        return;
    }
    plan::FieldPush push = push_of(context);
    list.shader.bind(commands, context.sets.fields);
    list.shader.dispatch_workgroups(commands, squares, [&](std::uint32_t first) {
        push.first = first;
        list.shader.push(commands, push);
    });
}

void Fields::record_crowded(VkCommandBuffer commands, const RecordContext& context) const {
    crowded_.bind(commands, context.sets.places);
    crowded_.push(commands, push_of(context));
    crowded_.dispatch_indirect(commands, context.crowd, 0);
}

void Fields::record_points(VkCommandBuffer commands, const RecordContext& context) const {
    plan::FieldPush push = push_of(context);
    const std::uint32_t first_point =
        push.tiles + push.tile_count * plan::units_of_field_tile;  // units; one per point
    points_.bind(commands, context.sets.places);
    for (const plan::FieldPointRun& run : context.batch.field_point_runs) {
        push.points = first_point + run.first;
        push.first_word = run.first_word;
        push.words_per_point = run.parts.words_per_point;
        push.cells_per_point = run.parts.cells_per_point;
        push.end = run.count * (1 + push.cells_per_point);
        points_.dispatch_in_parts(commands, 0, push.end, [&](std::uint32_t first) {
            push.first = first;
            points_.push(commands, push);
        });
    }
}

}  // namespace nearfield::passes
