#include <passes/export_pairs.hpp>
#include <passes/pair_search.hpp>

#include <shaders/export_pair_records_comp.hpp>
#include <shaders/export_pairs_comp.hpp>

namespace nearfield::passes {

using graph::Access;

namespace {

constexpr graph::ExternalAccess after_search{.before = write};
constexpr graph::ExternalAccess of_host{.before = Access::exported_buffer,
                                        .after = Access::exported_buffer};

}  // namespace

ExportPairs::ExportPairs(const gpu::Device& device, const graph::ComputeLayout& layout)
    : row_shader(device, layout, shaders::export_pairs_comp, "nearfield export pairs"),
      record_shader(device, layout, shaders::export_pair_records_comp,
                    "nearfield export pair records"),
      shapes(graph.import_buffer({"pair shapes", true, false})),
      instances(graph.import_buffer({"pair instances", true, false})),
      scratch(graph.import_buffer({"pair scratch"}, after_search)),
      arguments(graph.import_buffer({"pair arguments"}, after_search)),
      rows(graph.import_buffer({"pair rows"}, after_search)),
      pairs(graph.import_buffer({"resident pairs"}, of_host)),
      records(graph.import_buffer({"resident pair records"}, of_host)),
      headers(graph.import_buffer({"resident pair headers"}, of_host)),
      copy_header(device) {
    graph::Handle of_pairs = pairs;
    graph::Handle of_records = records;
    graph::Handle of_headers = headers;
    add_pass(graph, "export pairs", row_shader,
             {{graph::unbound, arguments, Access::indirect_arguments},
              {0, instances},
              {2, rows},
              {3, of_pairs, write},
              {1, of_headers, write}},
             [this](const ComputeShader& shader, const graph::PassCommands& commands,
                    const Input& input) {
                 shader.push(commands, input.pairs);
                 shader.dispatch_indirect(commands, commands.part(arguments).buffer,
                                          search_argument_bytes * shaders::pair_total);
             });
    add_pass(graph, "export pair records", record_shader,
             {{graph::unbound, arguments, Access::indirect_arguments},
              {0, shapes},
              {1, scratch},
              {3, of_records, write}},
             [this](const ComputeShader& shader, const graph::PassCommands& commands,
                    const Input& input) {
                 shaders::SearchPush push = input.search;
                 push.capacity = input.pairs.point_room;
                 shader.push(commands, push);
                 shader.dispatch_indirect(commands, commands.part(arguments).buffer,
                                          search_argument_bytes * shaders::point_total);
             });
    graph.compile(device);
}

}  // namespace nearfield::passes
