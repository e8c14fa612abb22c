#include <passes/fields.hpp>

#include <shaders/field_blocks_by_groups_comp.hpp>
#include <shaders/field_blocks_comp.hpp>
#include <shaders/field_quarters_comp.hpp>
#include <shaders/field_regions_by_groups_comp.hpp>
#include <shaders/field_regions_comp.hpp>
#include <shaders/field_rows_comp.hpp>
#include <shaders/fields.h>
#include <shaders/resolve_blocks_comp.hpp>
#include <shaders/resolve_crowded_comp.hpp>
#include <shaders/resolve_features_comp.hpp>
#include <shaders/resolve_field_points_by_walks_comp.hpp>

#include <string>

namespace nearfield::passes {

using graph::Access;

namespace {

shaders::FieldPush push_of(const RecordContext& context) {
    const device_input::ComputeWork& work = context.batch.work;
    const device_input::FieldLists lists = work.field_lists();
    shaders::FieldPush push{};
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

void dispatch_threads_of(const ComputeShader& shader, VkCommandBuffer commands,
                         const RecordContext& context, std::uint64_t threads) {
    shaders::FieldPush push = push_of(context);
    push.end = static_cast<std::uint32_t>(threads);
    shader.dispatch_in_parts(commands, 0, push.end, push);
}

}  // namespace

std::vector<Fields::ListPass> Fields::make_lists(const gpu::Device& device,
                                                 const graph::ComputeLayout& layout,
                                                 bool by_groups) {
    using device_input::FieldWork;
    std::vector<ListPass> lists;
    const auto add = [&](const char* name, gpu::Spirv code, std::uint32_t FieldWork::*squares) {
        const std::string shader = std::string("nearfield ") + name;
        lists.push_back({name, {device, layout, code, shader.c_str()}, squares});
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

Fields::Fields(const gpu::Device& device, const graph::ComputeLayout& layout)
    : rows_(device, layout, shaders::field_rows_comp, "nearfield fill rows"),
      lists_by_groups_(!device.is_software()),
      lists_(make_lists(device, layout, lists_by_groups_)),
      values_(device, layout, shaders::resolve_blocks_comp, "nearfield resolve blocks"),
      features_(device, layout, shaders::resolve_features_comp, "nearfield resolve features"),
      crowded_(device, layout, shaders::resolve_crowded_comp, "nearfield resolve crowded blocks"),
      points_(device, layout, shaders::resolve_field_points_by_walks_comp,
              "nearfield resolve field points by walks") {}

void Fields::declare_lists(TileGraph& graph, Buffers& buffers) const {
    for (const ListPass& list : lists_) {
        graph::Handle none;
        add_pass(graph, list.name, list.shader,
                 {{0, buffers.input},
                  {1, buffers.scratch, write},
                  {2, &list == &lists_.back() ? buffers.crowd : none, write}},
                 [by_groups = lists_by_groups_, squares = list.squares](
                     const ComputeShader& shader, VkCommandBuffer commands,
                     const RecordContext& context) {
                     const std::uint32_t count = context.batch.work.fields.*squares;
                     if (by_groups) {
                         shader.dispatch_workgroups(commands, count, push_of(context));
                     } else {
                         dispatch_threads_of(shader, commands, context, count);
                     }
                 });
    }
}

void Fields::declare_cells(TileGraph& graph, Buffers buffers, const Cells& cells,
                           Output& output) const {
    add_pass(
        graph, "fill rows", rows_, {{0, buffers.input}, {1, buffers.scratch, write}},
        [](const ComputeShader& shader, VkCommandBuffer commands, const RecordContext& context) {
            dispatch_threads_of(shader, commands, context, context.batch.work.fields.rows);
        });
    declare_lists(graph, buffers);
    const auto add_resolve = [&](const char* name, const ComputeShader& resolve,
                                 std::uint64_t threads_per_block) {
        add_pass(graph, name, resolve,
                 {{0, buffers.input}, {1, buffers.scratch}, {3, output.field, write}},
                 [threads_per_block](const ComputeShader& shader, VkCommandBuffer commands,
                                     const RecordContext& context) {
                     dispatch_threads_of(shader, commands, context,
                                         threads_per_block * context.batch.work.fields.blocks);
                 });
    };
    if (cells.values) {
        add_resolve("resolve blocks", values_, shaders::threads_per_block);
    }
    if (cells.features) {
        constexpr std::uint32_t cells_per_thread = 4;
        add_resolve("resolve features", features_,
                    shaders::block_side * shaders::block_side / cells_per_thread);
    }
    add_pass(
        graph, "resolve crowded blocks", crowded_,
        {{0, buffers.input},
         {1, buffers.scratch},
         {graph::unbound, buffers.crowd, Access::indirect_arguments},
         {2, output.long_searches, write},
         {3, output.field, write}},
        [crowd = buffers.crowd](const ComputeShader& shader, const graph::PassCommands& commands,
                                const RecordContext& context) {
            shader.push(commands, push_of(context));
            shader.dispatch_indirect(commands, commands.part(crowd).buffer, 0);
        });
}

void Fields::declare_points(TileGraph& graph, graph::Handle input, Output& output) const {
    add_pass(
        graph, "resolve field points by walks", points_,
        {{0, input}, {2, output.long_searches, write}, {3, output.field, write}},
        [](const ComputeShader& shader, VkCommandBuffer commands, const RecordContext& context) {
            shaders::FieldPush push = push_of(context);
            const std::uint32_t first_point =
                push.tiles +
                push.tile_count * shaders::units_of_field_tile;  // units; one per point
            for (const device_input::FieldPointRun& run : context.batch.field_point_runs) {
                push.points = first_point + run.first;
                push.first_word = run.first_word;
                push.words_per_point = run.parts.words_per_point;
                push.cells_per_point = run.parts.cells_per_point;
                push.end = run.count * (1 + push.cells_per_point);
                shader.dispatch_in_parts(commands, 0, push.end, push);
            }
        });
}

}  // namespace nearfield::passes
