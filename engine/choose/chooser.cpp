#include <engine/choose/chooser.hpp>
#include <engine/plan/technique.hpp>

#include <algorithm>
#include <limits>

namespace nearfield::choose {
namespace {

constexpr std::array<Technique, 3> by_position{Technique::raster, Technique::compute,
                                               Technique::cpu};

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

Chooser::Set Chooser::add_candidates(std::span<AnyQuery> queries,
                                     std::span<const plan::QueryShapes> shapes) {
    candidates_.clear();
    Set others = 0;
    for (std::size_t index = 0; index < queries.size(); ++index) {
        AnyQuery& query = queries[index];
        const Technique asked = std::visit([](const auto& any) { return any.technique; }, query);
        if (asked == Technique::automatic) {
            const auto [a, b] = shapes[index];
            const bool known =
                b != nullptr && (a != nullptr || std::holds_alternative<DistanceFieldQuery>(query));
            candidates_.push_back({&query, known ? work_of(query, a, *b) : Work{}, {}});
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            others |= asked == by_position[i] ? 1U << i : 0U;
        }
    }
    return others;
}

double Chooser::find_times(std::uint32_t technique) {
    double sum = 0.0;
    for (Candidate& candidate : candidates_) {
        // Of numbers that are none, which a bad query may bring, no time comes.
        const double time = candidate.work.time(costs_[technique]);
        const bool can = plan::answers(by_position[technique], *candidate.query);
        candidate.times[technique] = can ? (time < never ? time : 0.0) : never;
        sum += candidate.times[technique];
    }
    return sum;
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
        time += (used & ~paid) >> i & 1U ? costs_[i].submission : 0.0;
    }
    return time;
}

Chooser::Set Chooser::best_set(Set paid) {
    const auto submission = [&](std::uint32_t technique) {
        return (paid >> technique & 1U) != 0 ? 0.0 : costs_[technique].submission;
    };
    Set best = 1U << cpu;
    double least = submission(cpu) + find_times(cpu);
    // Nothing of the device takes less than its submission: a batch of little work, where being
    // quick counts, needs no closer look.
    if (least <= std::min(submission(raster), submission(compute))) {
        return best;
    }
    find_times(raster);
    find_times(compute);
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
