#include <engine/gpu/pipeline.hpp>
#include <engine/graph/print.hpp>
#include <engine/plan/point_search.hpp>
#include <passes/point_search.hpp>

#include <shaders/search_edges_comp.hpp>
#include <shaders/search_items_comp.hpp>
#include <shaders/search_pack_comp.hpp>
#include <shaders/search_points_comp.hpp>
#include <shaders/search_scan_comp.hpp>

namespace nearfield::passes {
namespace {

using graph::Access;

struct SearchPush {
    std::uint32_t first, items, directions, direction_count;
    std::uint32_t item_blocks, edge_blocks, point_blocks, item_words;
    std::uint32_t edge_units, point_units, stage, capacity;
};
static_assert(sizeof(SearchPush) <= ComputeLayout::push_bytes);

// Of the arguments of one stage: three numbers of workgroups, and the number of elements.
constexpr VkDeviceSize argument_bytes = 4 * sizeof(std::uint32_t);

// Whether shaders read the input as texels: where these can address as much as a storage buffer.
VkBool32 reads_texels(const gpu::Device& device) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    return limits.maxTexelBufferElements >= limits.maxStorageBufferRange / sizeof(plan::SearchUnit)
               ? VK_TRUE
               : VK_FALSE;
}

}  // namespace

PointSearch::PointSearch(const gpu::Device& device, const ComputeLayout& layout)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      items_(gpu::make_compute_pipeline(device, layout_, shaders::search_items_comp,
                                        "nearfield search items", reads_texels(device))),
      scan_(gpu::make_compute_pipeline(device, layout_, shaders::search_scan_comp,
                                       "nearfield search scan")),
      edges_(gpu::make_compute_pipeline(device, layout_, shaders::search_edges_comp,
                                        "nearfield search edges", reads_texels(device))),
      points_(gpu::make_compute_pipeline(device, layout_, shaders::search_points_comp,
                                         "nearfield search points", reads_texels(device))),
      pack_(gpu::make_compute_pipeline(device, layout_, shaders::search_pack_comp,
                                       "nearfield pack points")),
      input_(graph_.import_buffer({"search input", true, false})),
      scratch_(graph_.import_buffer({"search scratch"})),
      arguments_(graph_.import_buffer({"search arguments", true, true})),
      records_(graph_.import_buffer({"found points", false, true})) {
    declare();
    executor_ = graph::make_executor(device, graph_);
}

void PointSearch::declare() {
    graph::Handle scratch = scratch_;
    graph::Handle arguments = arguments_;
    const auto scan = [&](const char* name, Stage stage) {
        graph_.add_pass(
            name, graph::PassKind::compute,
            [&](graph::PassBuilder& pass) {
                scratch = pass.write(scratch, Access::storage_write_in_compute);
                arguments = pass.write(arguments, Access::storage_write_in_compute);
            },
            [this, stage](VkCommandBuffer commands) { dispatch_scan(commands, stage); });
    };
    const auto search = [&](const char* name, const gpu::Owned<VkPipeline>& pipeline, Stage of) {
        graph_.add_pass(
            name, graph::PassKind::compute,
            [&](graph::PassBuilder& pass) {
                pass.read(input_, Access::storage_read_in_compute);
                pass.read(arguments, Access::indirect_arguments);
                scratch = pass.write(scratch, Access::storage_write_in_compute);
            },
            [this, &pipeline, of](VkCommandBuffer commands) { dispatch(commands, pipeline, of); });
    };
    graph_.add_pass(
        "search items", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input_, Access::storage_read_in_compute);
            scratch = pass.write(scratch, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { dispatch_items(commands); });
    scan("count edges", Stage::edges);
    search("search edges", edges_, Stage::edges);
    scan("count points", Stage::points);
    search("search points", points_, Stage::points);
    scan("count found points", Stage::records);
    graph_.add_pass(
        "pack points", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(arguments, Access::indirect_arguments);
            pass.read(scratch, Access::storage_read_in_compute);
            static_cast<void>(pass.write(records_, Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { dispatch(commands, pack_, Stage::points); });
}

void PointSearch::record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) {
    item_ = item;
    executor_->set_buffer(input_, item.input);
    executor_->set_buffer(scratch_, item.scratch);
    executor_->set_buffer(arguments_, item.arguments);
    executor_->set_buffer(records_, item.records);
    executor_->execute(graph_, commands, timestamps);
}

void PointSearch::bind(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                      &item_.set, 0, nullptr);
}

void PointSearch::push(VkCommandBuffer commands, std::uint32_t first, Stage stage) const {
    const SearchLayout& layout = item_.layout;
    const SearchPush push{first,
                          item_.items,
                          item_.first_direction,
                          item_.directions,
                          layout.item_blocks,
                          layout.edge_blocks,
                          layout.point_blocks,
                          layout.item_words,
                          layout.edge_units,
                          layout.point_units,
                          static_cast<std::uint32_t>(stage),
                          layout.capacities[static_cast<std::size_t>(stage)]};
    device_->functions().vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                            sizeof(push), &push);
}

void PointSearch::dispatch_items(VkCommandBuffer commands) const {
    bind(commands, items_);
    dispatch_points(device_->functions(), commands, 0, item_.items,
                    [&](std::uint32_t first) { push(commands, first, Stage::edges); });
}

void PointSearch::dispatch_scan(VkCommandBuffer commands, Stage stage) const {
    bind(commands, scan_);
    push(commands, 0, stage);
    device_->functions().vkCmdDispatch(commands, 1, 1, 1);
}

void PointSearch::dispatch(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline,
                           Stage arguments) const {
    bind(commands, pipeline);
    push(commands, 0, Stage::records);
    device_->functions().vkCmdDispatchIndirect(
        commands, item_.arguments, argument_bytes * static_cast<VkDeviceSize>(arguments));
}

std::string PointSearch::print(GraphFormat format) const {
    return graph::print(graph_, executor_->baked(), format);
}

}  // namespace nearfield::passes
