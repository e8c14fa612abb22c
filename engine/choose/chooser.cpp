#include <engine/choose/chooser.hpp>
#include <engine/choose/work.hpp>
#include <engine/plan/technique.hpp>

#include <limits>

namespace nearfield::choose {
namespace {

constexpr std::array<Technique, 3> by_position{Technique::raster, Technique::compute,
                                               Technique::cpu};

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

void Chooser::add_candidate(std::uint32_t index, const AnyQuery& query,
                            const plan::FindShape& find_shape) {
    Candidate& candidate = candidates_.emplace_back();
    candidate.query = index;
    const auto [a, b] = std::visit(
        [&](const auto& asked) {
            return std::pair(find_shape(asked.a.shape), find_shape(asked.b.shape));
        },
        query);
    const bool known =
        b != nullptr && (a != nullptr || std::holds_alternative<DistanceFieldQuery>(query));
    const Work work = known ? work_of(query, a, *b) : Work{};
    for (std::uint32_t i = 0; i < count; ++i) {
        // Of numbers that are none, which a bad query may bring, no time comes.
        const double time = work.time(costs_[i]);
        const bool can = plan::answers(by_position[i], query);
        candidate.times[i] = can ? (time < never ? time : 0.0) : never;
    }
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

void Chooser::choose(std::span<AnyQuery> queries, const plan::FindShape& find_shape) {
    candidates_.clear();
    Set paid = 0;
    for (std::uint32_t index = 0; index < queries.size(); ++index) {
        const Technique asked =
            std::visit([](const auto& query) { return query.technique; }, queries[index]);
        if (asked == Technique::automatic) {
            add_candidate(index, queries[index], find_shape);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            paid |= asked == by_position[i] ? 1U << i : 0U;
        }
    }
    Set best = 1U << cpu;
    double least = time_by(best, paid);
    for (Set allowed = 1; allowed < every_set; ++allowed) {
        const double time = time_by(allowed, paid);
        if (time < least) {
            least = time;
            best = allowed;
        }
    }
    for (const Candidate& candidate : candidates_) {
        const Technique technique = by_position[fastest(candidate, best)];
        std::visit([&](auto& query) { query.technique = technique; }, queries[candidate.query]);
    }
}

}  // namespace nearfield::choose
