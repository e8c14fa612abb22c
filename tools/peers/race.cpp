#include <tools/benchmark/measuring.hpp>
#include <tools/common/add_shape.hpp>
#include <tools/common/library_error.hpp>
#include <tools/io/query_request.hpp>
#include <tools/peers/agreement.hpp>
#include <tools/peers/peer.hpp>
#include <tools/peers/race.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

namespace nearfield::peers {
namespace {

Answer answer_of(const PenetrationResult& result) {
    return {result.count, result.count > 0 ? result.deepest.depth : 0.0, {}};
}

Answer answer_of(const SeparationResult& result) {
    return {0, result.distance, {}};
}

Answer answer_of(const IntersectionResult& result) {
    return {0, result.area, {}};
}

Answer answer_of(const DistanceFieldResult& result) {
    return {0, 0.0, result.values};
}

/// No problem contains other queries.
Answer answer_of(const ResultSummary& /*result*/) {
    return {};
}

}  // namespace

NearfieldSide::NearfieldSide(const Problem& problem, Context& context)
    : runner_(problem.scene, problem.name, context) {}

double NearfieldSide::run_frame(tools::FrameInput input) {
    const double milliseconds = runner_.run_frame(input);
    runner_.require_results();
    return milliseconds;
}

std::vector<Answer> NearfieldSide::answers() const {
    std::vector<Answer> answers;
    for (const AnyResult* const result : results()) {
        answers.push_back(std::visit([](const auto& any) { return answer_of(any); }, *result));
    }
    return answers;
}

std::vector<const AnyResult*> NearfieldSide::results() const {
    std::vector<const AnyResult*> results;
    for (const tools::SceneAnswer& answer : runner_.answers()) {
        results.push_back(&answer.result);
    }
    return results;
}

namespace {

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

}  // namespace

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
    return benchmark::milliseconds_of_short([&] {
        if (const Status status = world_.update(table, {.a = a_, .b = b_}); !status.ok()) {
            tools::require(status, "bench_peers");
        }
    });
}

void KeptPairs::require_same(const std::vector<const AnyResult*>& results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
        bool is_same = false;
        if (const auto* const test = std::get_if<IntersectionTestResult>(results[i])) {
            is_same = test->intersects == tests_.rows()[i].intersects;
        } else if (const auto* const penetration = std::get_if<PenetrationResult>(results[i])) {
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

namespace {

using benchmark::milliseconds_of;
using benchmark::milliseconds_of_short;

/// A peer at work on a problem, in two copies: one rebuilt each frame and one kept.
struct Entry {
    Entry(const Problem& of, std::unique_ptr<Peer> anew, std::unique_ptr<Peer> once)
        : problem(of), built(std::move(anew)), kept(std::move(once)) {
        place(problem.scene, kept_shapes);
        kept->build(kept_shapes, problem.task);
    }

    double run_built() {
        return milliseconds_of([&] {
            place(problem.scene, built_shapes);
            built->build(built_shapes, problem.task);
            answer(*built, problem, built_shapes, built_answers);
        });
    }

    double run_kept() {
        return milliseconds_of_short([&] { answer(*kept, problem, kept_shapes, kept_answers); });
    }

    const Problem& problem;
    std::unique_ptr<Peer> built;
    std::unique_ptr<Peer> kept;
    std::vector<PlacedShape> built_shapes;
    std::vector<PlacedShape> kept_shapes;
    std::vector<Answer> built_answers;
    std::vector<Answer> kept_answers;
};

using MakePeer = std::unique_ptr<Peer> (*)();

constexpr MakePeer all_peers[] = {make_geos_peer, make_boost_peer,   make_boost_tree_peer,
                                  make_cgal_peer, make_clipper_peer, make_opencv_peer};

std::vector<std::unique_ptr<Entry>> entries_of(const Problem& problem) {
    std::vector<std::unique_ptr<Entry>> entries;
    for (const MakePeer make : all_peers) {
        if (!make()->how(problem.task).empty()) {
            entries.push_back(std::make_unique<Entry>(problem, make(), make()));
        }
    }
    return entries;
}

PeerTimes checked(Entry& entry, const NearfieldSide& ours) {
    PeerTimes times;
    times.name = entry.kept->name();
    times.how = entry.kept->how(entry.problem.task);
    times.exact = entry.kept->exact();
    times.has_sign = entry.problem.task != Task::field || entry.kept->signed_field();
    entry.run_built();
    entry.run_kept();
    if (!times.exact) {
        times.error_in_cells =
            largest_field_error(entry.problem, ours.answers(), entry.kept_answers);
        return times;
    }
    const std::vector<const AnyResult*> results = ours.results();
    for (const std::vector<Answer>* const answers : {&entry.built_answers, &entry.kept_answers}) {
        const Agreement agreement =
            compare(*entry.kept, entry.problem, entry.kept_shapes, results, *answers);
        if (!agreement.complaint.empty()) {
            throw std::runtime_error(entry.problem.name + ": nearfield and " + times.name +
                                     " differ: " + agreement.complaint);
        }
        times.largest_difference = agreement.largest_difference;
        times.allowed = agreement.allowed;
    }
    return times;
}

}  // namespace

std::optional<double> ProblemTimes::quickest(benchmark::Spread PeerTimes::*times) const {
    std::optional<double> least;
    for (const PeerTimes& peer : peers) {
        if (peer.exact && peer.has_sign) {
            const double median = (peer.*times).median;
            least = std::min(least.value_or(median), median);
        }
    }
    return least;
}

ProblemTimes race(const Problem& problem, Context& context) {
    ProblemTimes times;
    times.name = problem.name;
    times.queries = problem.scene.queries.size();
    NearfieldSide ours(problem, context);
    NearfieldSide kept(problem, context);
    ours.run_frame(tools::FrameInput::all);
    kept.run_frame(tools::FrameInput::all);
    std::optional<KeptPairs> pairs;
    if (KeptPairs::answers(problem.task)) {
        pairs.emplace(problem, context);
        pairs->run_frame();
        pairs->require_same(ours.results());
    }
    times.technique = ours.technique();
    const std::vector<std::unique_ptr<Entry>> entries = entries_of(problem);
    std::vector<benchmark::Contender> contenders;
    contenders.push_back({[&] { return ours.run_frame(tools::FrameInput::all); }, {}});
    contenders.push_back(
        {[&] { return pairs ? pairs->run_frame() : kept.run_frame(tools::FrameInput::nothing); },
         {}});
    for (const std::unique_ptr<Entry>& owner : entries) {
        Entry& entry = *owner;
        times.peers.push_back(checked(entry, ours));
        contenders.push_back({[&entry] { return entry.run_built(); }, {}});
        contenders.push_back({[&entry] { return entry.run_kept(); }, {}});
    }
    benchmark::measure(contenders, {});
    auto contender = contenders.begin();
    times.built_ms = benchmark::spread_of((contender++)->frames_ms);
    times.kept_ms = benchmark::spread_of((contender++)->frames_ms);
    for (PeerTimes& peer : times.peers) {
        peer.built_ms = benchmark::spread_of((contender++)->frames_ms);
        peer.kept_ms = benchmark::spread_of((contender++)->frames_ms);
    }
    return times;
}

}  // namespace nearfield::peers
