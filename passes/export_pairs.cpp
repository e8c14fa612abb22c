#include <passes/export_pairs.hpp>
#include <passes/search_shaders.hpp>

#include <shaders/export_pair_records_comp.hpp>
#include <shaders/export_pairs_comp.hpp>

namespace nearfield::passes {

using graph::Access;

namespace {

constexpr graph::ExternalAccess after_search{.before = Access::storage_write_in_compute};
constexpr graph::ExternalAccess of_host{.before = Access::exported_buffer,
                                        .after = Access::exported_buffer};

ComputeShader make_shader(const gpu::Device& device, const ComputeLayout& layout, gpu::Spirv code,
                          const char* name) {
    return {device, layout, code, name, search_constants(device)};
}

}  // namespace

ExportPairs::ExportPairs(const gpu::Device& device, const ComputeLayout& layout)
    : rows_(make_shader(device, layout, shaders::export_pairs_comp, "nearfield export pairs")),
      records_(make_shader(device, layout, shaders::export_pair_records_comp,
                           "nearfield export pair records")),
      shapes_(graph_.import_buffer({"pair shapes", true, false})),
      instances_(graph_.import_buffer({"pair instances", true, false})),
      scratch_(graph_.import_buffer({"pair scratch"}, after_search)),
      arguments_(graph_.import_buffer({"pair arguments"}, after_search)),
      found_rows_(graph_.import_buffer({"pair rows"}, after_search)),
      pair_output_(graph_.import_buffer({"resident pairs"}, of_host)),
      record_output_(graph_.import_buffer({"resident pair records"}, of_host)),
      header_output_(graph_.import_buffer({"resident pair headers"}, of_host)) {
    declare_rows();
    declare_records();
    graph_.compile(device);
}

void ExportPairs::declare_rows() {
    graph_.add_pass(
        "export pairs", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(arguments_, Access::indirect_arguments);
            pass.read(instances_, Access::storage_read_in_compute);
            pass.read(found_rows_, Access::storage_read_in_compute);
            pair_output_ = pass.write(pair_output_, Access::storage_write_in_compute);
            header_output_ = pass.write(header_output_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            rows_.bind(commands, item.sets[of_rows]);
            rows_.push(commands, plan::ExportPairsPush{item.origin});
            rows_.dispatch_indirect(commands, item.search->arguments,
                                    search_argument_bytes * plan::pair_total);
        });
}

void ExportPairs::declare_records() {
    graph_.add_pass(
        "export pair records", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(arguments_, Access::indirect_arguments);
            pass.read(shapes_, Access::storage_read_in_compute);
            pass.read(scratch_, Access::storage_read_in_compute);
            record_output_ = pass.write(record_output_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            records_.bind(commands, item.sets[of_records]);
            records_.push(commands, item.search->push);
            records_.dispatch_indirect(commands, item.search->arguments,
                                       search_argument_bytes * plan::point_total);
        });
}

void ExportPairs::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                         const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(shapes_, item.search->shapes);
    executor.set_buffer(instances_, item.search->instances);
    executor.set_buffer(scratch_, item.search->scratch);
    executor.set_buffer(arguments_, item.search->arguments);
    executor.set_buffer(found_rows_, item.search->rows);
    executor.set_buffer(pair_output_, item.pairs);
    executor.set_buffer(record_output_, item.records);
    executor.set_buffer(header_output_, item.headers);
    graph_.execute(commands, timestamps, item);
}

}  // namespace nearfield::passes
