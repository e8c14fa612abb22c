#include <passes/pair_search.hpp>

#include <shaders/pair_boxes_comp.hpp>
#include <shaders/pair_contacts_comp.hpp>
#include <shaders/pair_counts_comp.hpp>
#include <shaders/pair_crossings_comp.hpp>
#include <shaders/pair_directions_comp.hpp>
#include <shaders/pair_given_comp.hpp>
#include <shaders/pair_levels_comp.hpp>
#include <shaders/pair_lists_comp.hpp>
#include <shaders/pair_rows_comp.hpp>
#include <shaders/pair_summaries_comp.hpp>
#include <shaders/pair_verdicts_comp.hpp>
#include <shaders/search_edges_comp.hpp>
#include <shaders/search_items_comp.hpp>
#include <shaders/search_pack_comp.hpp>
#include <shaders/search_points_comp.hpp>
#include <shaders/search_spread_comp.hpp>

namespace nearfield::passes {

using graph::Access;

namespace {

/// The same commands may be submitted again, and a part follows another one, so what they write
/// waits for the search before.
constexpr graph::ExternalAccess after_writes{.before = Access::storage_write_in_compute};
constexpr graph::ExternalAccess after_dispatches{.before = Access::indirect_arguments};

/// What a part leaves for the host is its own. Commands of a batch are submitted once.
graph::ExternalAccess uses_of_found(const device_input::PairSearchKind& kind) {
    return kind.are_given() ? graph::ExternalAccess{} : after_writes;
}

std::uint32_t flags_of(const device_input::PairSearchKind& kind) {
    return (kind.points == device_input::FoundPoints::packed ? shaders::search_packs_all : 0U) |
           (kind.goal == device_input::PairGoal::contacts ? shaders::search_crosses : 0U);
}

}  // namespace

InstanceShaders::InstanceShaders(const gpu::Device& device, const graph::ComputeLayout& layout)
    : boxes(device, layout, shaders::pair_boxes_comp, "nearfield pair boxes"),
      levels(device, layout, shaders::pair_levels_comp, "nearfield pair levels") {}

SearchShaders::SearchShaders(const gpu::Device& device, const graph::ComputeLayout& layout)
    : items(device, layout, shaders::search_items_comp, "nearfield pair items"),
      spread(device, layout, shaders::search_spread_comp, "nearfield pair spread"),
      edges(device, layout, shaders::search_edges_comp, "nearfield pair edges"),
      points(device, layout, shaders::search_points_comp, "nearfield pair points"),
      summaries(device, layout, shaders::pair_summaries_comp, "nearfield pair summaries"),
      pack(device, layout, shaders::search_pack_comp, "nearfield pair packing"),
      rows(device, layout, shaders::pair_rows_comp, "nearfield pair rows") {}

FoundPairShaders::FoundPairShaders(const gpu::Device& device, const graph::ComputeLayout& layout,
                                   const InstanceShaders* instance_shaders)
    : instances(*instance_shaders),
      counts(device, layout, shaders::pair_counts_comp, "nearfield pair counts"),
      lists(device, layout, shaders::pair_lists_comp, "nearfield pair lists"),
      directions(device, layout, shaders::pair_directions_comp, "nearfield pair directions"),
      contacts(device, layout, shaders::pair_contacts_comp, "nearfield pair contacts"),
      crossings(device, layout, shaders::pair_crossings_comp, "nearfield pair crossings"),
      verdicts(device, layout, shaders::pair_verdicts_comp, "nearfield pair verdicts") {}

PairSearch::PairSearch(const gpu::Device& device, const graph::ComputeLayout& layout,
                       const SearchShaders* shaders, const FoundPairShaders* finding,
                       const device_input::PairSearchKind& kind)
    : shaders_(shaders), finding_(finding), flags_(flags_of(kind)) {
    const graph::ExternalAccess found = uses_of_found(kind);
    auto& graph = part_.graph;
    part_.shapes = graph.import_buffer({"pair shapes", true, false});
    part_.instances = graph.import_buffer({"pair instances", true, false});
    part_.scratch = graph.import_buffer({"pair scratch"}, after_writes);
    part_.arguments = graph.import_buffer({"pair arguments"}, after_dispatches);
    part_.rows = graph.import_buffer({"pair rows", false, true}, found);
    part_.counts = graph.import_buffer({"pair counts", false, true}, after_writes);
    if (kind.reads_points()) {
        part_.points = graph.import_buffer({"pair points", false, true}, found);
    }
    Versions at{part_.shapes, part_.instances, part_.scratch, part_.arguments,
                part_.points, part_.rows,      part_.counts};
    if (kind.are_given()) {
        given_.emplace(device, layout, shaders::pair_given_comp, "nearfield given pairs");
        declare_given_pairs(at);
    } else {
        declare_boxes();
        boxes_->graph.compile(device);
        declare_found_pairs(at);
    }
    declare_edges(at);
    if (kind.goal == device_input::PairGoal::tests) {
        add(at, "pair crossings", finding_->crossings, shaders::edge_total);
        add_answers(at, "pair verdicts", finding_->verdicts);
    } else {
        declare_points(at, kind);
    }
    declare_rows(at);
    graph.compile(device);
}

void PairSearch::declare_boxes() {
    Passes& boxes = boxes_.emplace();
    boxes.shapes = boxes.graph.import_buffer({"pair shapes", true, false});
    boxes.instances = boxes.graph.import_buffer({"pair instances", true, false});
    boxes.scratch = boxes.graph.import_buffer({"pair scratch"}, after_writes);
    graph::Handle scratch = boxes.scratch;
    add(boxes, "pair boxes", finding_->instances.boxes,
        {{0, boxes.shapes}, {2, boxes.instances}, {1, scratch, write}}, no_stage, no_stage);
    add_pass(boxes.graph, "pair levels", finding_->instances.levels, {{1, scratch, write}},
             [this](const ComputeShader& levels, VkCommandBuffer commands, const Input& input) {
                 levels.push(commands, push_of(input, no_stage));
                 levels.dispatch(commands, 1);
             });
}

void PairSearch::add(Versions& at, const char* name, const ComputeShader& shader,
                     std::uint32_t threads_of) {
    add(part_, name, shader,
        {{0, at.shapes},
         {1, at.scratch, write},
         {graph::unbound, at.arguments, Access::indirect_arguments}},
        threads_of, no_stage);
}

void PairSearch::add_counting(Versions& at, const char* name, const ComputeShader& shader,
                              std::uint32_t threads_of, std::uint32_t stage) {
    add(part_, name, shader,
        {{0, at.shapes}, {1, at.scratch, write}, {3, at.arguments, Access::written_arguments}},
        threads_of, stage);
}

void PairSearch::declare_found_pairs(Versions& at) {
    add(part_, "count pairs", finding_->counts,
        {{0, at.shapes}, {2, at.instances}, {1, at.scratch, write}}, no_stage, no_stage);
    add(part_, "list pairs", finding_->lists,
        {{2, at.instances}, {1, at.scratch, write}, {3, at.arguments, write}}, no_stage,
        shaders::pair_total);
    add(part_, "pair directions", finding_->directions,
        {{0, at.shapes},
         {2, at.instances},
         {1, at.scratch, write},
         {graph::unbound, at.arguments, Access::indirect_arguments}},
        shaders::pair_total, no_stage);
}

void PairSearch::declare_given_pairs(Versions& at) {
    add_pass(part_.graph, "given pairs", *given_,
             {{0, at.shapes}, {2, at.instances}, {1, at.scratch, write}, {3, at.arguments, write}},
             [this](const ComputeShader& given, VkCommandBuffer commands, const Input& input) {
                 given.dispatch_in_parts(commands, input.push.first_instance,
                                         input.push.end_instance,
                                         push_of(input, shaders::pair_total));
             });
}

/// The edges of the directions that are not far from the other shape.
void PairSearch::declare_edges(Versions& at) {
    add_counting(at, "pair items", shaders_->items, shaders::item_total, shaders::edge_total);
    add(at, "spread edges", shaders_->spread, shaders::item_total);
}

void PairSearch::declare_points(Versions& at, const device_input::PairSearchKind& kind) {
    const bool finds_contacts = kind.goal == device_input::PairGoal::contacts;
    if (finds_contacts) {
        add(at, "pair crossings", finding_->crossings, shaders::edge_total);
    }
    add_counting(at, "pair edges", shaders_->edges, shaders::edge_total, shaders::point_total);
    const bool has_records = kind.points != device_input::FoundPoints::compared;
    add_counting(at, "pair points", shaders_->points, shaders::point_total,
                 has_records ? shaders::record_total : no_stage);
    add_answers(at, "pair summaries", finds_contacts ? finding_->contacts : shaders_->summaries);
    if (kind.reads_points()) {
        add(part_, "pack points", shaders_->pack,
            {{1, at.scratch},
             {2, at.points, write},
             {graph::unbound, at.arguments, Access::indirect_arguments}},
            shaders::point_total, no_stage);
    }
}

/// The answers of the pairs, of which the rows are made.
void PairSearch::add_answers(Versions& at, const char* name, const ComputeShader& shader) {
    add(part_, name, shader,
        {{0, at.shapes},
         {1, at.scratch, write},
         {3, at.counts, write},
         {graph::unbound, at.arguments, Access::indirect_arguments}},
        shaders::pair_total, shaders::record_total);
}

void PairSearch::declare_rows(Versions& at) {
    add(part_, "pair rows", shaders_->rows,
        {{1, at.scratch, write},
         {2, at.rows, write},
         {3, at.counts, write},
         {graph::unbound, at.arguments, Access::indirect_arguments}},
        shaders::pair_total, shaders::row_total);
}

void PairSearch::add(Passes& passes, const char* name, const ComputeShader& shader,
                     std::initializer_list<graph::Bound> bound, std::uint32_t threads_of,
                     std::uint32_t stage) {
    add_pass(passes.graph, name, shader, bound,
             [this, threads_of, stage, arguments = passes.arguments](
                 const ComputeShader& of, const graph::PassCommands& commands, const Input& input) {
                 if (threads_of == no_stage) {
                     of.dispatch_in_parts(commands, 0, input.push.instances, push_of(input, stage));
                 } else {
                     of.push(commands, push_of(input, stage));
                     of.dispatch_indirect(commands, commands.part(arguments).buffer,
                                          search_argument_bytes * threads_of);
                 }
             });
}

shaders::SearchPush PairSearch::push_of(const Input& input, std::uint32_t stage) const {
    shaders::SearchPush push = input.push;
    push.flags = flags_;
    push.first = 0;
    push.stage = stage;
    push.capacity = stage < input.capacities.size() ? input.capacities[stage] : 0;
    push.second_capacity = input.capacities[shaders::item_total];
    return push;
}

}  // namespace nearfield::passes
