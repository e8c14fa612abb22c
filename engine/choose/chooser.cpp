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

/// Whether the shapes that a query needs are there.
bool are_known(const AnyQuery& query, const plan::QueryShapes& shapes) {
    return shapes.b != nullptr &&
           (shapes.a != nullptr || std::holds_alternative<DistanceFieldQuery>(query));
}

template <class Query>
bool is_open(const Query& query) {
    return query.technique == Technique::automatic;
}

}  // namespace

template <class Query>
double Chooser::most_saved(const AnyQuery& any, const Query& query,
                           const plan::QueryShapes& shapes) const {
    if (plan::unanswered(Technique::cpu, query) != nullptr) {
        return never;
    }
    if (!are_known(any, shapes)) {
        return 0.0;
    }
    const WorkBounds bounds = work_bounds(any, shapes.a, *shapes.b);
    double by_device = never;
    for (const std::uint32_t device : {raster, compute}) {
        if (plan::unanswered(by_position[device], query) == nullptr) {
            by_device = std::min(by_device, bounds.least.time(costs_[device]));
        }
    }
    return std::max(0.0, bounds.most.time(costs_[cpu]) - by_device);
}

Chooser::Outlook Chooser::look(std::span<const AnyQuery> queries,
                               std::span<const plan::QueryShapes> shapes) const {
    Outlook outlook;
    for (std::size_t index = 0; index < queries.size(); ++index) {
        std::visit(
            [&](const auto& query) {
                if (is_open(query)) {
                    outlook.open = true;
                    outlook.most_saved += most_saved(queries[index], query, shapes[index]);
                } else {
                    for (std::uint32_t i = 0; i < count; ++i) {
                        outlook.paid |= query.technique == by_position[i] ? 1U << i : 0U;
                    }
                }
            },
            queries[index]);
    }
    return outlook;
}

void Chooser::add_candidate(AnyQuery& query, const plan::QueryShapes& shapes) {
    const Work work = are_known(query, shapes) ? work_of(query, shapes.a, *shapes.b) : Work{};
    Candidate& candidate = candidates_.emplace_back();
    candidate.query = &query;
    for (std::uint32_t i = 0; i < count; ++i) {
        // Of numbers that are none, which a bad query may bring, no time comes.
        const double time = work.time(costs_[i]);
        const bool can = plan::answers(by_position[i], query);
        candidate.times[i] = can ? (time < never ? time : 0.0) : never;
    }
}

void Chooser::add_candidates(std::span<AnyQuery> queries,
                             std::span<const plan::QueryShapes> shapes) {
    candidates_.clear();
    for (std::size_t index = 0; index < queries.size(); ++index) {
        if (std::visit([](const auto& query) { return is_open(query); }, queries[index])) {
            add_candidate(queries[index], shapes[index]);
        }
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
    const Outlook outlook = look(queries, shapes);
    if (!outlook.open) {
        return;
    }
    // What no device can make up for its submission with needs no closer look, which would take as
    // long as the answers to small pairs.
    if (submission(cpu, outlook.paid) + outlook.most_saved <=
        std::min(submission(raster, outlook.paid), submission(compute, outlook.paid))) {
        for (AnyQuery& query : queries) {
            std::visit(
                [](auto& asked) {
                    asked.technique = is_open(asked) ? Technique::cpu : asked.technique;
                },
                query);
        }
        return;
    }
    add_candidates(queries, shapes);
    const Set best = best_set(outlook.paid);
    for (const Candidate& candidate : candidates_) {
        const Technique technique = by_position[fastest(candidate, best)];
        std::visit([&](auto& query) { query.technique = technique; }, *candidate.query);
    }
}

}  // namespace nearfield::choose
