#include <engine/plan/point_search.hpp>
#include <passes/point_search.hpp>

namespace nearfield::passes {
namespace {

using graph::Access;

}  // namespace

PointSearch::PointSearch(const gpu::Device& device, const ComputeLayout& layout)
    : shaders_(device, layout, false, "nearfield search"),
      input_(graph_.import_buffer({"search input", true, false})),
      scratch_(graph_.import_buffer({"search scratch"})),
      arguments_(graph_.import_buffer({"search arguments", true, true})),
      records_(graph_.import_buffer({"found points", false, true})) {
    declare();
    graph_.compile(device);
}

void PointSearch::declare() {
    graph::Handle scratch = scratch_;
    graph::Handle arguments = arguments_;
    const auto scan = [&](const char* name, std::uint32_t stage) {
        graph_.add_pass(
            name, graph::PassKind::compute,
            [&](graph::PassBuilder& pass) {
                scratch = pass.write(scratch, Access::storage_write_in_compute);
                arguments = pass.write(arguments, Access::storage_write_in_compute);
            },
            [this, stage](VkCommandBuffer commands, const Item& item) {
                dispatch_scan(commands, item, stage);
            });
    };
    const auto search = [&](const char* name, const ComputeShader& shader, std::uint32_t of) {
        graph_.add_pass(
            name, graph::PassKind::compute,
            [&](graph::PassBuilder& pass) {
                pass.read(input_, Access::storage_read_in_compute);
                pass.read(arguments, Access::indirect_arguments);
                scratch = pass.write(scratch, Access::storage_write_in_compute);
            },
            [this, &shader, of](VkCommandBuffer commands, const Item& item) {
                dispatch(commands, item, shader, of);
            });
    };
    // One thread per item, whose number is known.
    const auto search_items = [&](const char* name, const ComputeShader& shader) {
        graph_.add_pass(
            name, graph::PassKind::compute,
            [&](graph::PassBuilder& pass) {
                pass.read(input_, Access::storage_read_in_compute);
                scratch = pass.write(scratch, Access::storage_write_in_compute);
            },
            [&shader](VkCommandBuffer commands, const Item& item) {
                dispatch_items(commands, item, shader);
            });
    };
    search_items("search items", shaders_.items);
    scan("count edges", plan::edge_total);
    search_items("spread edges", shaders_.spread);
    search("search edges", shaders_.edges, plan::edge_total);
    scan("count points", plan::point_total);
    search("search points", shaders_.points, plan::point_total);
    scan("count found points", plan::record_total);
    graph_.add_pass(
        "pack points", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(arguments, Access::indirect_arguments);
            pass.read(scratch, Access::storage_read_in_compute);
            static_cast<void>(pass.write(records_, Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands, const Item& item) {
            dispatch(commands, item, shaders_.pack, plan::point_total);
        });
}

void PointSearch::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                         const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(input_, item.input);
    executor.set_buffer(scratch_, item.scratch);
    executor.set_buffer(arguments_, item.arguments);
    executor.set_buffer(records_, item.records);
    graph_.execute(commands, timestamps, item);
}

void PointSearch::push(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                       std::uint32_t first, std::uint32_t stage) {
    plan::SearchPush push = item.push;
    push.first = first;
    push.stage = stage;
    push.capacity = stage < item.capacities.size() ? item.capacities[stage] : 0;
    shader.push(commands, push);
}

void PointSearch::dispatch_items(VkCommandBuffer commands, const Item& item,
                                 const ComputeShader& shader) {
    shader.bind(commands, item.set);
    shader.dispatch_in_parts(commands, 0, item.push.items, [&](std::uint32_t first) {
        push(commands, item, shader, first, plan::edge_total);
    });
}

void PointSearch::dispatch_scan(VkCommandBuffer commands, const Item& item,
                                std::uint32_t stage) const {
    shaders_.scan.bind(commands, item.set);
    push(commands, item, shaders_.scan, 0, stage);
    const auto& room = item.capacities;
    shaders_.scan.dispatch(commands, stage == plan::edge_total ? scan_groups(item.push.items)
                                     : stage == plan::point_total
                                         ? scan_groups(room[plan::edge_total])
                                         : scan_groups_of_points(room[plan::point_total]));
}

void PointSearch::dispatch(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                           std::uint32_t arguments) const {
    shader.bind(commands, item.set);
    push(commands, item, shader, 0, plan::record_total);
    shader.dispatch_indirect(commands, item.arguments, search_argument_bytes * arguments);
}

}  // namespace nearfield::passes
