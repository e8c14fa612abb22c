#include <tools/common/library.hpp>
#include <tools/peers/agreement.hpp>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <variant>

namespace nearfield::peers {
namespace {

using benchmark::milliseconds_of;
using benchmark::milliseconds_of_short;
using tools::FrameInput;
using tools::SceneRunner;

double run_frame(SceneRunner& runner, FrameInput input) {
    const double milliseconds = runner.run_frame(input);
    runner.require_results();
    return milliseconds;
}

/// That of all queries of a problem that the task of penetrations poses; otherwise any.
PenetrationQuery penetration_of(const Problem& problem) {
    if (problem.task != Task::vertex_penetration) {
        return {};
    }
    Batch batch;
    tools::add_query(batch, problem.scene.queries.front().request, {}, {});
    return std::get<PenetrationQuery>(batch.queries().front());
}

constexpr PairTableOptions listed{.listed = true, .technique = Technique::cpu};

/// nearfield on a list of pairs of shapes that stay where they are: a world.
class KeptPairs {
public:
    /// Both must outlive it. Throws if anything is rejected.
    KeptPairs(const Problem& problem, Context& context);

    /// Whether a world answers lists of pairs for such a task.
    [[nodiscard]] static bool answers(Task task) {
        return task == Task::intersection_test || task == Task::vertex_penetration;
    }

    /// Runs one frame; returns milliseconds.
    double run_frame();

    /// Throws unless the answers of the last frame are these results.
    void require_same(std::span<const tools::SceneAnswer> results);

private:
    const Problem& problem_;
    World world_;
    std::vector<InstanceHandle> a_;
    std::vector<InstanceHandle> b_;
    PairTable<IntersectionTestQuery> tests_;
    PairTable<PenetrationQuery> penetrations_;
};

KeptPairs::KeptPairs(const Problem& problem, Context& context)
    : problem_(problem),
      world_(tools::take(World::create(context))),
      tests_(IntersectionTestQuery{}, listed),
      penetrations_(penetration_of(problem), listed) {
    const tools::Scene& scene = problem.scene;
    std::vector<ShapeHandle> shapes;
    for (const tools::SceneShape& shape : scene.shapes) {
        shapes.push_back(tools::take(tools::add_shape(context, shape.rings, shape.deviation)));
    }
    std::vector<InstanceHandle> instances;
    for (const tools::SceneInstance& instance : scene.instances) {
        instances.push_back(
            tools::take(world_.add({.shape = shapes[instance.shape], .pose = instance.pose})));
    }
    for (const tools::SceneQuery& query : scene.queries) {
        a_.push_back(instances[query.a]);
        b_.push_back(instances[query.b]);
    }
}

double KeptPairs::run_frame() {
    PairTableBase& table = problem_.task == Task::vertex_penetration
                               ? static_cast<PairTableBase&>(penetrations_)
                               : static_cast<PairTableBase&>(tests_);
    return milliseconds_of_short([&] {
        if (const Status status = world_.update(table, {.a = a_, .b = b_}); !status.ok()) {
            tools::require(status, "bench_peers");
        }
    });
}

void KeptPairs::require_same(std::span<const tools::SceneAnswer> results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
        bool is_same = false;
        if (const auto* const test = std::get_if<IntersectionTestResult>(&results[i].result)) {
            is_same = test->intersects == tests_.rows()[i].intersects;
        } else if (const auto* const penetration =
                       std::get_if<PenetrationResult>(&results[i].result)) {
            const PairRow<PenetrationQuery>& row = penetrations_.rows()[i];
            is_same = row.status == StatusCode::ok && row.intersects == penetration->intersects &&
                      row.count == penetration->count &&
                      row.deepest.depth == penetration->deepest.depth;
        }
        if (!is_same) {
            throw std::runtime_error(problem_.name + ": a batch and a world differ in query " +
                                     std::to_string(i));
        }
    }
}

/// A peer at work on a problem, in two copies: one rebuilt each frame and one kept.
struct Entry {
    Entry(const Problem& of, std::unique_ptr<Peer> anew, std::unique_ptr<Peer> once)
        : problem(of), built(std::move(anew)), kept(std::move(once)) {
        place(problem.scene, kept_shapes);
        kept->build(problem, kept_shapes);
    }

    double run_built() {
        return milliseconds_of([&] {
            place(problem.scene, built_shapes);
            built->build(problem, built_shapes);
            answer(*built, problem, built_shapes, built_answers);
        });
    }
    double run_kept() {
        return milliseconds_of_short([&] { answer(*kept, problem, kept_shapes, kept_answers); });
    }
    /// Runs both, and compares their answers with nearfield's.
    PeerTimes checked(std::span<const tools::SceneAnswer> results, Context& context) {
        PeerTimes times{kept->name(), kept->methods().at(problem.task), {}, {}};
        run_kept();
        if (problem.is_of_world()) {
            compare_world(*kept, problem, context, kept_answers.front().values, times);
            return times;
        }
        run_built();
        for (const std::vector<Answer>* const answers : {&built_answers, &kept_answers}) {
            compare(*kept, problem, kept_shapes, results, *answers, times);
        }
        return times;
    }

    const Problem& problem;
    std::unique_ptr<Peer> built;
    std::unique_ptr<Peer> kept;
    std::vector<PlacedShape> built_shapes;
    std::vector<PlacedShape> kept_shapes;
    std::vector<Answer> built_answers;
    std::vector<Answer> kept_answers;
};

std::vector<std::unique_ptr<Entry>> entries_of(const Problem& problem) {
    std::vector<std::unique_ptr<Entry>> entries;
    for (const auto make : {make_geos_peer, make_boost_peer, make_boost_tree_peer, make_cgal_peer,
                            make_clipper_peer, make_box2d_peer}) {
        if (make()->methods().contains(problem.task)) {
            entries.push_back(std::make_unique<Entry>(problem, make(), make()));
        }
    }
    return entries;
}

}  // namespace

std::optional<double> ProblemTimes::quickest(benchmark::Spread PeerTimes::*times) const {
    std::optional<double> least;
    for (const PeerTimes& peer : peers) {
        least = std::min(least.value_or((peer.*times).median), (peer.*times).median);
    }
    return least;
}

ProblemTimes race(const Problem& problem, Context& context) {
    ProblemTimes times;
    times.name = problem.name;
    times.task = tools::name_of(problem.task);
    times.queries = problem.scene.queries.size();
    SceneRunner ours(problem.scene, problem.name, context);
    SceneRunner kept(problem.scene, problem.name, context);
    run_frame(ours, FrameInput::all);
    run_frame(kept, FrameInput::all);
    const std::vector<tools::SceneAnswer> results = ours.answers();
    std::optional<KeptPairs> pairs;
    if (KeptPairs::answers(problem.task)) {
        pairs.emplace(problem, context);
        pairs->run_frame();
        pairs->require_same(results);
    }
    times.technique = ours.technique();
    // Of a world the index alone is of interest, which is built once.
    std::vector<benchmark::Contender> contenders;
    std::vector<benchmark::Spread*> spreads;
    const auto add = [&](benchmark::Spread& spread, std::function<double()> frame) {
        contenders.push_back({std::move(frame), {}});
        spreads.push_back(&spread);
    };
    add(times.kept_ms,
        [&] { return pairs ? pairs->run_frame() : run_frame(kept, FrameInput::nothing); });
    const std::vector<std::unique_ptr<Entry>> entries = entries_of(problem);
    times.peers.reserve(entries.size());
    for (const std::unique_ptr<Entry>& entry : entries) {
        PeerTimes& peer = times.peers.emplace_back(entry->checked(results, context));
        add(peer.kept_ms, [&entry] { return entry->run_kept(); });
        if (!problem.is_of_world()) {
            add(peer.built_ms, [&entry] { return entry->run_built(); });
        }
    }
    if (problem.is_of_world()) {
        benchmark::measure(contenders, {.milliseconds = 3000.0, .max_frames = 50});
    } else {
        add(times.built_ms, [&] { return run_frame(ours, FrameInput::all); });
        benchmark::measure(contenders, {});
    }
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        *spreads[i] = benchmark::spread_of(contenders[i].frames_ms);
    }
    return times;
}

}  // namespace nearfield::peers
