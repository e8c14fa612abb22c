#include <passes/export_pairs.hpp>
#include <passes/search_shaders.hpp>

#include <shaders/export_pair_frames_comp.hpp>
#include <shaders/export_pair_headers_comp.hpp>
#include <shaders/export_pair_records_comp.hpp>
#include <shaders/export_pairs_comp.hpp>

#include <algorithm>

namespace nearfield::passes {

using graph::Access;

namespace {

constexpr graph::ExternalAccess after_search{.before = Access::storage_write_in_compute};
constexpr graph::ExternalAccess of_host{.before = Access::exported_buffer,
                                        .after = Access::exported_buffer};

ComputeShader make_shader(const gpu::Device& device, const ComputeLayout& layout, gpu::Spirv code,
                          const char* name) {
    return {device, layout, code, name, search_constants(device, true)};
}

}  // namespace

ExportPairs::ExportPairs(const gpu::Device& device, const ComputeLayout& layout)
    : frames_(make_shader(device, layout, shaders::export_pair_frames_comp,
                          "nearfield export pair frames")),
      rows_(make_shader(device, layout, shaders::export_pairs_comp, "nearfield export pairs")),
      records_(make_shader(device, layout, shaders::export_pair_records_comp,
                           "nearfield export pair records")),
      headers_(device, layout, shaders::export_pair_headers_comp, "nearfield export pair headers"),
      shapes_(graph_.import_buffer({"pair shapes", true, false})),
      instances_(graph_.import_buffer({"pair instances", true, false})),
      scratch_(graph_.import_buffer({"pair scratch"}, after_search)),
      arguments_(graph_.import_buffer({"pair arguments"}, after_search)),
      found_(graph_.import_buffer({"pair points"}, after_search)),
      found_rows_(graph_.import_buffer({"pair rows"}, after_search)),
      pair_output_(graph_.import_buffer({"resident pairs"}, of_host)),
      record_output_(graph_.import_buffer({"resident pair records"}, of_host)),
      header_output_(graph_.import_buffer({"resident pair headers"}, of_host)) {
    declare_frames();
    declare_outputs();
    graph_.compile(device);
}

void ExportPairs::declare_frames() {
    graph_.add_pass(
        "export pair frames", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(arguments_, Access::indirect_arguments);
            pass.read(instances_, Access::storage_read_in_compute);
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            frames_.bind(commands, item.search->sets[PairSearch::of_instances]);
            frames_.push(commands, item.search->push);
            frames_.dispatch_indirect(commands, item.search->arguments,
                                      search_argument_bytes * plan::pair_total);
        });
}

/// A pass of a thread per element that a stage has counted.
void ExportPairs::add_output(const char* name, const ComputeShader& shader, Set set,
                             std::uint32_t stage, graph::Handle input, graph::Handle& output) {
    graph_.add_pass(
        name, graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(arguments_, Access::indirect_arguments);
            pass.read(set == of_rows ? instances_ : shapes_, Access::storage_read_in_compute);
            pass.read(scratch_, Access::storage_read_in_compute);
            pass.read(input, Access::storage_read_in_compute);
            output = pass.write(output, Access::storage_write_in_compute);
        },
        [&shader, set, stage](VkCommandBuffer commands, const Item& item) {
            shader.bind(commands, item.sets[set]);
            shader.push(commands, item.search->push);
            shader.dispatch_indirect(commands, item.search->arguments,
                                     search_argument_bytes * stage);
        });
}

void ExportPairs::declare_outputs() {
    add_output("export pairs", rows_, of_rows, plan::row_total, found_rows_, pair_output_);
    add_output("export pair records", records_, of_records, plan::record_total, found_,
               record_output_);
    graph_.add_pass(
        "export pair headers", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(arguments_, Access::storage_read_in_compute);
            header_output_ = pass.write(header_output_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            plan::ExportPairsPush push{{}, item.origin};
            std::copy(item.search->capacities.begin(), item.search->capacities.end(),
                      push.capacities);
            headers_.bind(commands, item.sets[of_headers]);
            headers_.push(commands, push);
            headers_.dispatch(commands, 1);
        });
}

void ExportPairs::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                         const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(shapes_, item.search->shapes);
    executor.set_buffer(instances_, item.search->instances);
    executor.set_buffer(scratch_, item.search->scratch);
    executor.set_buffer(arguments_, item.search->arguments);
    executor.set_buffer(found_, item.search->records);
    executor.set_buffer(found_rows_, item.search->rows);
    executor.set_buffer(pair_output_, item.pairs);
    executor.set_buffer(record_output_, item.records);
    executor.set_buffer(header_output_, item.headers);
    graph_.execute(commands, timestamps, item);
}

}  // namespace nearfield::passes
