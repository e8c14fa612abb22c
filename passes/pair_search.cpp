#include <passes/pair_search.hpp>

#include <shaders/pair_given_comp.hpp>

namespace nearfield::passes {

using graph::Access;

namespace {

/// The same commands may be submitted again, and a part follows another one, so what they write
/// waits for the search before.
constexpr graph::ExternalAccess after_writes{.before = Access::storage_write_in_compute};
constexpr graph::ExternalAccess after_dispatches{.before = Access::indirect_arguments};

/// What a part leaves for the host is its own. Commands of a batch are submitted once.
graph::ExternalAccess uses_of_found(const plan::PairSearchKind& kind) {
    return kind.are_given() ? graph::ExternalAccess{} : after_writes;
}

std::uint32_t flags_of(const plan::PairSearchKind& kind) {
    return (kind.points == plan::FoundPoints::packed ? plan::search_packs_all : 0U) |
           (kind.goal == plan::PairGoal::contacts ? plan::search_crosses : 0U);
}

}  // namespace

PairSearch::PairSearch(const gpu::Device& device, const ComputeLayout& layout,
                       const SearchShaders* shaders, const FoundPairShaders* finding,
                       const plan::PairSearchKind& kind)
    : shaders_(shaders),
      finding_(finding),
      flags_(flags_of(kind)),
      input_(graph_.import_buffer({"pair shapes", true, false})),
      instances_(graph_.import_buffer({"pair instances", true, false})),
      scratch_(graph_.import_buffer({"pair scratch"}, after_writes)),
      arguments_(graph_.import_buffer({"pair arguments"}, after_dispatches)),
      found_(uses_of_found(kind)),
      row_buffer_(graph_.import_buffer({"pair rows", false, true}, found_)),
      counts_(graph_.import_buffer({"pair counts", false, true}, after_writes)) {
    if (kind.are_given()) {
        given_.emplace(device, layout, shaders::pair_given_comp, "nearfield given pairs",
                       search_constants(device));
        declare_given_pairs();
    } else {
        declare_boxes();
        boxes_->graph.compile(device);
        declare_found_pairs();
    }
    declare_edges();
    if (kind.goal == plan::PairGoal::tests) {
        add("pair crossings", finding_->crossings, of_points, plan::edge_total);
        add_answers("pair verdicts", finding_->verdicts);
    } else {
        declare_points(kind);
    }
    declare_rows();
    graph_.compile(device);
}

void PairSearch::declare_boxes() {
    Boxes& boxes = boxes_.emplace();
    boxes.input = boxes.graph.import_buffer({"pair shapes", true, false});
    boxes.instances = boxes.graph.import_buffer({"pair instances", true, false});
    boxes.scratch = boxes.graph.import_buffer({"pair scratch"}, after_writes);
    boxes.graph.add_pass(
        "pair boxes", graph::PassKind::compute,
        [&boxes](graph::PassBuilder& pass) {
            pass.read(boxes.instances, Access::storage_read_in_compute);
            pass.read(boxes.input, Access::storage_read_in_compute);
            boxes.scratch = pass.write(boxes.scratch, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            finding_->instances.boxes.bind(commands, item.sets[of_instances]);
            dispatch(commands, item, finding_->instances.boxes, no_stage, no_stage);
        });
    boxes.scratch = boxes.graph.add_compute_pass(
        "pair levels", {}, boxes.scratch, [this](VkCommandBuffer commands, const Item& item) {
            finding_->instances.levels.bind(commands, item.sets[of_instances]);
            push(commands, item, finding_->instances.levels, 0, no_stage);
            finding_->instances.levels.dispatch(commands, 1);
        });
}

/// A pass that writes into the scratch memory; the set says what it reads.
void PairSearch::add(const char* name, const ComputeShader& shader, Set set,
                     std::uint32_t threads_of) {
    graph_.add_pass(
        name, graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            if (set == of_instances) {
                pass.read(instances_, Access::storage_read_in_compute);
            }
            pass.read(input_, Access::storage_read_in_compute);
            if (threads_of != no_stage) {
                pass.read(arguments_, Access::indirect_arguments);
            }
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
        },
        [this, &shader, set, threads_of](VkCommandBuffer commands, const Item& item) {
            shader.bind(commands, item.sets[set]);
            dispatch(commands, item, shader, threads_of, no_stage);
        });
}

/// A pass that turns the sums of the blocks of a stage into places.
void PairSearch::add_scan(const char* name, std::uint32_t stage) {
    graph_.add_pass(
        name, graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
            arguments_ = pass.write(arguments_, Access::storage_write_in_compute);
        },
        [this, stage](VkCommandBuffer commands, const Item& item) {
            const ComputeShader& scan = shaders_->scan;
            scan.bind(commands, item.sets[of_points]);
            push(commands, item, scan, 0, stage);
            const auto& room = item.capacities;
            scan.dispatch(commands, stage == plan::edge_total ? scan_groups(room[plan::item_total])
                                    : stage == plan::point_total
                                        ? scan_groups(room[plan::edge_total])
                                        : scan_groups_of_points(room[plan::point_total]));
        });
}

void PairSearch::declare_found_pairs() {
    add("count pairs", finding_->counts, of_instances);
    graph_.add_pass(
        "list pairs", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(instances_, Access::storage_read_in_compute);
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
            arguments_ = pass.write(arguments_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            finding_->lists.bind(commands, item.sets[of_instances]);
            dispatch(commands, item, finding_->lists, no_stage, plan::pair_total);
        });
    add("pair directions", finding_->directions, of_instances, plan::pair_total);
}

void PairSearch::declare_given_pairs() {
    graph_.add_pass(
        "given pairs", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(instances_, Access::storage_read_in_compute);
            pass.read(input_, Access::storage_read_in_compute);
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
            arguments_ = pass.write(arguments_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            given_->bind(commands, item.sets[of_instances]);
            given_->dispatch_in_parts(commands, item.push.first_instance, item.push.end_instance,
                                      [&](std::uint32_t first) {
                                          push(commands, item, *given_, first, plan::pair_total);
                                      });
        });
}

/// The edges of the directions that are not far from the other shape.
void PairSearch::declare_edges() {
    add("pair items", shaders_->items, of_points, plan::item_total);
    add_scan("count edges", plan::edge_total);
    add("spread edges", shaders_->spread, of_points, plan::item_total);
}

void PairSearch::declare_points(const plan::PairSearchKind& kind) {
    const bool finds_contacts = kind.goal == plan::PairGoal::contacts;
    if (finds_contacts) {
        add("pair crossings", finding_->crossings, of_points, plan::edge_total);
    }
    add("pair edges", shaders_->edges, of_points, plan::edge_total);
    add_scan("count points", plan::point_total);
    add("pair points", shaders_->points, of_points, plan::point_total);
    if (kind.points != plan::FoundPoints::compared) {
        add_scan("count found points", plan::record_total);
    }
    add_answers("pair summaries", finds_contacts ? finding_->contacts : shaders_->summaries);
    if (kind.reads_points()) {
        add_packing();
    }
}

void PairSearch::add_packing() {
    records_ = graph_.import_buffer({"pair points", false, true}, found_);
    graph_.add_pass(
        "pack points", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(arguments_, Access::indirect_arguments);
            pass.read(scratch_, Access::storage_read_in_compute);
            records_ = pass.write(records_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            shaders_->pack.bind(commands, item.sets[of_points]);
            dispatch(commands, item, shaders_->pack, plan::point_total, no_stage);
        });
}

/// The answers of the pairs, of which the rows are made.
void PairSearch::add_answers(const char* name, const ComputeShader& shader) {
    graph_.add_pass(
        name, graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input_, Access::storage_read_in_compute);
            pass.read(arguments_, Access::indirect_arguments);
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
            counts_ = pass.write(counts_, Access::storage_write_in_compute);
        },
        [this, &shader](VkCommandBuffer commands, const Item& item) {
            shader.bind(commands, item.sets[of_rows]);
            dispatch(commands, item, shader, plan::pair_total, plan::record_total);
        });
}

void PairSearch::declare_rows() {
    graph_.add_pass(
        "pair rows", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(arguments_, Access::indirect_arguments);
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
            counts_ = pass.write(counts_, Access::storage_write_in_compute);
            static_cast<void>(pass.write(row_buffer_, Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands, const Item& item) {
            shaders_->rows.bind(commands, item.sets[of_rows]);
            dispatch(commands, item, shaders_->rows, plan::pair_total, plan::row_total);
        });
}

void PairSearch::record_boxes(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                              const Item& item) const {
    graph::Executor& executor = boxes_->graph.executor();
    executor.set_buffer(boxes_->input, item.shapes);
    executor.set_buffer(boxes_->instances, item.instances);
    executor.set_buffer(boxes_->scratch, item.scratch);
    boxes_->graph.execute(commands, timestamps, item);
}

void PairSearch::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                        const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(input_, item.shapes);
    executor.set_buffer(instances_, item.instances);
    executor.set_buffer(scratch_, item.scratch);
    executor.set_buffer(arguments_, item.arguments);
    if (records_ != graph::Handle{}) {
        executor.set_buffer(records_, item.records);
    }
    executor.set_buffer(row_buffer_, item.rows);
    executor.set_buffer(counts_, item.counts);
    graph_.execute(commands, timestamps, item);
}

void PairSearch::push(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                      std::uint32_t first, std::uint32_t stage) const {
    plan::SearchPush push = item.push;
    push.flags = flags_;
    push.first = first;
    push.stage = stage;
    push.capacity = stage < item.capacities.size() ? item.capacities[stage] : 0;
    push.second_capacity = item.capacities[plan::item_total];
    shader.push(commands, push);
}

void PairSearch::dispatch(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                          std::uint32_t threads_of, std::uint32_t stage) const {
    if (threads_of == no_stage) {
        shader.dispatch_in_parts(commands, 0, item.push.instances, [&](std::uint32_t first) {
            push(commands, item, shader, first, stage);
        });
        return;
    }
    push(commands, item, shader, 0, stage);
    shader.dispatch_indirect(commands, item.arguments, search_argument_bytes * threads_of);
}

}  // namespace nearfield::passes
