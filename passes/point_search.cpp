#include <engine/plan/point_search.hpp>
#include <passes/point_search.hpp>
#include <passes/reads_texels.hpp>

#include <shaders/search_edges_comp.hpp>
#include <shaders/search_items_comp.hpp>
#include <shaders/search_pack_comp.hpp>
#include <shaders/search_points_comp.hpp>
#include <shaders/search_scan_comp.hpp>

#include <array>
#include <functional>

namespace nearfield::passes {
namespace {

using graph::Access;

constexpr VkDeviceSize argument_bytes = plan::words_of_arguments * sizeof(std::uint32_t);

// The directions are given, in the input.
std::array<VkBool32, 2> constants_of(const gpu::Device& device) {
    return {reads_texels(device), VK_FALSE};
}

}  // namespace

PointSearch::PointSearch(const gpu::Device& device, const ComputeLayout& layout)
    : items_(device, layout, shaders::search_items_comp, "nearfield search items",
             constants_of(device)),
      scan_(device, layout, shaders::search_scan_comp, "nearfield search scan",
            constants_of(device)),
      edges_(device, layout, shaders::search_edges_comp, "nearfield search edges",
             constants_of(device)),
      points_(device, layout, shaders::search_points_comp, "nearfield search points",
              constants_of(device)),
      pack_(device, layout, shaders::search_pack_comp, "nearfield pack points",
            constants_of(device)),
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
    graph_.add_pass(
        "search items", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input_, Access::storage_read_in_compute);
            scratch = pass.write(scratch, Access::storage_write_in_compute);
        },
        std::bind_front(&PointSearch::dispatch_items, this));
    scan("count edges", plan::edge_total);
    search("search edges", edges_, plan::edge_total);
    scan("count points", plan::point_total);
    search("search points", points_, plan::point_total);
    scan("count found points", plan::record_total);
    graph_.add_pass(
        "pack points", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(arguments, Access::indirect_arguments);
            // Its shader also writes there, but only where the device finds the pairs.
            scratch = pass.write(scratch, Access::storage_write_in_compute);
            static_cast<void>(pass.write(records_, Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands, const Item& item) {
            dispatch(commands, item, pack_, plan::point_total);
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
    const SearchLayout& layout = item.layout;
    plan::SearchPush push{};
    push.first = first;
    push.items = item.items;
    push.directions = item.first_direction;
    push.direction_count = item.directions;
    push.item_blocks = layout.item_blocks;
    push.edge_blocks = layout.edge_blocks;
    push.point_blocks = layout.point_blocks;
    push.item_words = layout.item_words;
    push.edge_units = layout.edge_units;
    push.point_units = layout.point_units;
    push.stage = stage;
    push.capacity = layout.capacities[stage];
    shader.push(commands, push);
}

void PointSearch::dispatch_items(VkCommandBuffer commands, const Item& item) const {
    items_.bind(commands, item.set);
    items_.dispatch_in_parts(commands, 0, item.items, [&](std::uint32_t first) {
        push(commands, item, items_, first, plan::edge_total);
    });
}

void PointSearch::dispatch_scan(VkCommandBuffer commands, const Item& item,
                                std::uint32_t stage) const {
    scan_.bind(commands, item.set);
    push(commands, item, scan_, 0, stage);
    scan_.dispatch(commands, 1);
}

void PointSearch::dispatch(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                           std::uint32_t arguments) const {
    shader.bind(commands, item.set);
    push(commands, item, shader, 0, plan::record_total);
    shader.dispatch_indirect(commands, item.arguments, argument_bytes * arguments);
}

}  // namespace nearfield::passes
