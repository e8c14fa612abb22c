#include <passes/pair_search.hpp>

namespace nearfield::passes {

using graph::Access;

namespace {

/// The same commands may be submitted again, and a part follows another one, so what they write
/// waits for the search before.
constexpr graph::ExternalAccess after_writes{.before = Access::storage_write_in_compute};
constexpr graph::ExternalAccess after_dispatches{.before = Access::indirect_arguments};

}  // namespace

PairSearch::PairSearch(const gpu::Device& device, const PairShaders& shaders,
                       const plan::PairSearchKind& kind)
    : shaders_(&shaders),
      input_(graph_.import_buffer({"pair shapes", true, false})),
      instances_(graph_.import_buffer({"pair instances", true, false})),
      scratch_(graph_.import_buffer({"pair scratch"}, after_writes)),
      arguments_(graph_.import_buffer({"pair arguments"}, after_dispatches)),
      row_buffer_(graph_.import_buffer({"pair rows", false, true}, after_writes)),
      counts_(graph_.import_buffer({"pair counts", false, true}, after_writes)) {
    declare_boxes();
    declare_pairs();
    if (kind.goal == plan::PairGoal::tests) {
        declare_tests();
    } else {
        declare_points(kind);
    }
    declare_rows();
    boxes_.graph.compile(device);
    graph_.compile(device);
}

void PairSearch::declare_boxes() {
    auto& graph = boxes_.graph;
    boxes_.input = graph.import_buffer({"pair shapes", true, false});
    boxes_.instances = graph.import_buffer({"pair instances", true, false});
    boxes_.scratch = graph.import_buffer({"pair scratch"}, after_writes);
    graph.add_pass(
        "pair boxes", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(boxes_.instances, Access::storage_read_in_compute);
            pass.read(boxes_.input, Access::storage_read_in_compute);
            boxes_.scratch = pass.write(boxes_.scratch, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            shaders_->instances.boxes.bind(commands, item.sets[of_instances]);
            dispatch(commands, item, shaders_->instances.boxes, no_stage, no_stage);
        });
    boxes_.scratch = graph.add_compute_pass(
        "pair levels", {}, boxes_.scratch, [this](VkCommandBuffer commands, const Item& item) {
            shaders_->instances.levels.bind(commands, item.sets[of_instances]);
            push(commands, item, shaders_->instances.levels, 0, no_stage);
            shaders_->instances.levels.dispatch(commands, 1);
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
            const ComputeShader& scan = shaders_->search.scan;
            scan.bind(commands, item.sets[of_points]);
            push(commands, item, scan, 0, stage);
            const auto& room = item.capacities;
            scan.dispatch(commands, stage == plan::edge_total ? scan_groups(room[plan::item_total])
                                    : stage == plan::point_total
                                        ? scan_groups(room[plan::edge_total])
                                        : scan_groups_of_points(room[plan::point_total]));
        });
}

void PairSearch::declare_pairs() {
    add("count pairs", shaders_->counts, of_instances);
    graph_.add_pass(
        "list pairs", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(instances_, Access::storage_read_in_compute);
            scratch_ = pass.write(scratch_, Access::storage_write_in_compute);
            arguments_ = pass.write(arguments_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            shaders_->lists.bind(commands, item.sets[of_instances]);
            dispatch(commands, item, shaders_->lists, no_stage, plan::pair_total);
        });
    add("pair directions", shaders_->directions, of_instances, plan::pair_total);
}

void PairSearch::declare_points(const plan::PairSearchKind& kind) {
    const bool finds_contacts = kind.goal == plan::PairGoal::contacts;
    add("pair items", shaders_->search.items, of_points, plan::item_total);
    add_scan("count edges", plan::edge_total);
    add("spread edges", shaders_->search.spread, of_points, plan::item_total);
    if (finds_contacts) {
        add("pair crossings", shaders_->crossings, of_points, plan::edge_total);
    }
    add("pair edges", shaders_->search.edges, of_points, plan::edge_total);
    add_scan("count points", plan::point_total);
    add("pair points", shaders_->search.points, of_points, plan::point_total);
    if (kind.points != plan::FoundPoints::compared) {
        add_scan("count found points", plan::record_total);
    }
    if (kind.points == plan::FoundPoints::packed) {
        add_packing();
    }
    add_answers("pair summaries", finds_contacts ? shaders_->contacts : shaders_->summaries);
}

void PairSearch::add_packing() {
    records_ = graph_.import_buffer({"pair points", false, true}, after_writes);
    graph_.add_pass(
        "pack points", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(arguments_, Access::indirect_arguments);
            pass.read(scratch_, Access::storage_read_in_compute);
            records_ = pass.write(records_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands, const Item& item) {
            shaders_->search.pack.bind(commands, item.sets[of_points]);
            dispatch(commands, item, shaders_->search.pack, plan::point_total, no_stage);
        });
}

void PairSearch::declare_tests() {
    add("pair items", shaders_->search.items, of_points, plan::item_total);
    add_scan("count edges", plan::edge_total);
    add("spread edges", shaders_->search.spread, of_points, plan::item_total);
    add("pair crossings", shaders_->crossings, of_points, plan::edge_total);
    add_answers("pair verdicts", shaders_->verdicts);
}

/// The last pass before the rows.
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
    graph::Executor& executor = boxes_.graph.executor();
    executor.set_buffer(boxes_.input, item.shapes);
    executor.set_buffer(boxes_.instances, item.instances);
    executor.set_buffer(boxes_.scratch, item.scratch);
    boxes_.graph.execute(commands, timestamps, item);
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
                      std::uint32_t first, std::uint32_t stage) {
    plan::SearchPush push = item.push;
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
