#include <tools/benchmark/interleave.hpp>
#include <tools/benchmark/milliseconds_of.hpp>
#include <tools/peers/agreement.hpp>
#include <tools/peers/nearfield_side.hpp>
#include <tools/peers/peer.hpp>
#include <tools/peers/race.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace nearfield::peers {
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
