#include <engine/choose/chooser.hpp>
#include <engine/choose/work.hpp>
#include <engine/plan/technique.hpp>

#include <algorithm>
#include <limits>

namespace nearfield::choose {
namespace {

constexpr std::array<Technique, 3> by_position{Technique::raster, Technique::compute,
                                               Technique::cpu};

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

void Chooser::add_candidate(AnyQuery& query, const plan::QueryShapes& shapes) {
    const auto [a, b] = shapes;
    const bool known =
        b != nullptr && (a != nullptr || std::holds_alternative<DistanceFieldQuery>(query));
    const Work work = known ? work_of(query, a, *b) : Work{};
    Candidate& candidate = candidates_.emplace_back();
    candidate.query = &query;
    for (std::uint32_t i = 0; i < count; ++i) {
        // Of numbers that are none, which a bad query may bring, no time comes.
        const double time = work.time(costs_[i]);
        const bool can = plan::answers(by_position[i], query);
        candidate.times[i] = can ? (time < never ? time : 0.0) : never;
    }
}

Chooser::Set Chooser::add_candidates(std::span<AnyQuery> queries,
                                     std::span<const plan::QueryShapes> shapes) {
    candidates_.clear();
    Set others = 0;
    for (std::size_t index = 0; index < queries.size(); ++index) {
        const Technique asked =
            std::visit([](const auto& query) { return query.technique; }, queries[index]);
        if (asked == Technique::automatic) {
            add_candidate(queries[index], shapes[index]);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            others |= asked == by_position[i] ? 1U << i : 0U;
        }
    }
    return others;
}

std::uint32_t Chooser::fastest(const Candidate& candidate, Set allowed) {
    std::uint32_t best = count;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((allowed >> i & 1U) != 0 &&
            (best == count || candidate.times[i] < candidate.times[best])) {
            best = i;
        }
    }
    return best;
}

double Chooser::time_by(Set allowed, Set paid) const {
    double time = 0.0;
    Set used = 0;
    for (const Candidate& candidate : candidates_) {
        const std::uint32_t best = fastest(candidate, allowed);
        time += candidate.times[best];
        used |= 1U << best;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        time += (used >> i & 1U) != 0 ? submission(i, paid) : 0.0;
    }
    return time;
}

Chooser::Set Chooser::best_set(Set paid) const {
    double by_cpu = submission(cpu, paid);
    double at_best = std::min(submission(raster, paid), submission(compute, paid));
    for (const Candidate& candidate : candidates_) {
        by_cpu += candidate.times[cpu];
        at_best += *std::min_element(candidate.times.begin(), candidate.times.end());
    }
    Set best = 1U << cpu;
    // With a device in it nothing takes less than each query at its best and a submission. Mostly
    // that settles it where there is little work, and picking is a part of it that counts.
    if (by_cpu <= at_best) {
        return best;
    }
    double least = by_cpu;
    for (Set allowed = 1; allowed < every_set; ++allowed) {
        const double time = time_by(allowed, paid);
        if (time < least) {
            least = time;
            best = allowed;
        }
    }
    return best;
}

void Chooser::choose(std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes) {
    const Set others = add_candidates(queries, shapes);
    if (candidates_.empty()) {
        return;
    }
    const Set best = best_set(others);
    for (const Candidate& candidate : candidates_) {
        const Technique technique = by_position[fastest(candidate, best)];
        std::visit([&](auto& query) { query.technique = technique; }, *candidate.query);
    }
}

}  // namespace nearfield::choose
