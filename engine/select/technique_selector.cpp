#include <engine/base/interruption.hpp>
#include <engine/plan/search_shapes.hpp>
#include <engine/select/technique_selector.hpp>
#include <engine/select/work.hpp>

#include <shaders/fields.h>

#include <algorithm>
#include <limits>

namespace nearfield::select {
namespace {

constexpr std::array<Technique, 3> by_position{Technique::raster, Technique::compute,
                                               Technique::cpu};

constexpr double never = std::numeric_limits<double>::infinity();

/// Whether the shapes that a query needs are present.
bool are_known(const AnyQuery& query, const plan::QueryShapes& shapes) {
    return shapes.b != nullptr &&
           (shapes.a != nullptr || std::holds_alternative<DistanceFieldQuery>(query));
}

/// Whether the compute technique may refuse a query that others answer: the shapes may exceed a
/// storage buffer or, which it finds only while it answers, more edges may be equally near to a
/// cell of a field than it compares.
bool may_be_refused(const AnyQuery& query, const plan::QueryShapes& shapes,
                    std::uint64_t largest_range) {
    if (!are_known(query, shapes)) {
        return false;
    }
    if (std::holds_alternative<DistanceFieldQuery>(query)) {
        return shapes.b->size() > plan::max_certain_edges;
    }
    return std::holds_alternative<IntersectionQuery>(query) &&
           plan::max_shape_bytes(*shapes.a, *shapes.b) > largest_range;
}

}  // namespace

bool TechniqueSelector::is_answered_by_any(const AnyQuery& query) const {
    return std::any_of(by_position.begin(), by_position.end(),
                       [&](Technique technique) { return can_answer(technique, query); });
}

TechniqueSelector::Set TechniqueSelector::add_candidates(
    std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes) {
    candidates_.clear();
    Set others = 0;
    SparseCheckpoint<256> checkpoint;
    for (std::size_t index = 0; index < queries.size(); ++index) {
        checkpoint.step();
        const Technique asked =
            std::visit([](const auto& query) { return query.technique; }, queries[index]);
        if (asked == Technique::automatic && is_answered_by_any(queries[index])) {
            add_candidate(queries[index], shapes[index]);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            others |= asked == by_position[i] ? 1U << i : 0U;
        }
    }
    return others;
}

void TechniqueSelector::add_candidate(AnyQuery& query, const plan::QueryShapes& shapes) {
    Candidate& candidate = candidates_.emplace_back();
    candidate.query = &query;
    candidate.shapes = shapes;
    if (!plan::answers(Technique::cpu, query)) {
        candidate.max_saved.fill(never);
    } else if (are_known(query, shapes)) {
        const WorkBounds bounds = work_bounds(query, shapes.a, *shapes.b);
        for (std::uint32_t device = 0; device < cpu; ++device) {
            candidate.max_saved[device] = bounds.max_saved(costs_[cpu], costs_[device]);
        }
    }
    for (std::uint32_t device = 0; device < cpu; ++device) {
        if (!available_.has(by_position[device])) {
            candidate.max_saved[device] = 0.0;
        }
    }
}

void TechniqueSelector::estimate(Candidate& candidate) const {
    const AnyQuery& query = *candidate.query;
    const plan::QueryShapes& shapes = candidate.shapes;
    const Work work = are_known(query, shapes) ? work_of(query, shapes.a, *shapes.b) : Work{};
    for (std::uint32_t i = 0; i < count; ++i) {
        // An invalid query may contain NaN, which gives no time.
        const double time = work.time(costs_[i]);
        const bool is_ruled_out = i == compute && can_answer(Technique::cpu, query) &&
                                  may_be_refused(query, shapes, largest_range_);
        candidate.times[i] = can_answer(by_position[i], query) && !is_ruled_out
                                 ? (time < never ? time : 0.0)
                                 : never;
    }
}

bool TechniqueSelector::cpu_is_best(Set paid) {
    Savings saved{};
    for (const Candidate& candidate : candidates_) {
        for (std::uint32_t device = 0; device < cpu; ++device) {
            saved[device] += candidate.max_saved[device];
        }
    }
    // If no device can save the cost of its submission, nothing needs a closer look, which would
    // take as long as answering small pairs. Two devices save at most the sum of both savings.
    const auto no_device_pays = [&] {
        return submission(cpu, paid) + saved[raster] <= submission(raster, paid) &&
               submission(cpu, paid) + saved[compute] <= submission(compute, paid);
    };
    for (Candidate& candidate : candidates_) {
        if (no_device_pays()) {
            return true;
        }
        estimate(candidate);
        for (std::uint32_t device = 0; device < cpu; ++device) {
            saved[device] += std::max(0.0, candidate.times[cpu] - candidate.times[device]) -
                             candidate.max_saved[device];
        }
    }
    return no_device_pays();
}

std::uint32_t TechniqueSelector::fastest(const Candidate& candidate, Set allowed) {
    std::uint32_t best = count;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((allowed >> i & 1U) != 0 &&
            (best == count || candidate.times[i] < candidate.times[best])) {
            best = i;
        }
    }
    return best;
}

double TechniqueSelector::time_by(Set allowed, Set paid) const {
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

TechniqueSelector::Set TechniqueSelector::best_set(Set paid) const {
    Set best = 1U << cpu;
    double least = never;
    for (Set allowed = 1; allowed < every_set; ++allowed) {
        const double time = time_by(allowed, paid);
        if (time < least) {
            least = time;
            best = allowed;
        }
    }
    return best;
}

void TechniqueSelector::choose(std::span<AnyQuery> queries,
                               std::span<const plan::QueryShapes> shapes) {
    const Set others = add_candidates(queries, shapes);
    const Set best = cpu_is_best(others) ? 1U << cpu : best_set(others);
    for (const Candidate& candidate : candidates_) {
        const Technique technique =
            best == 1U << cpu ? Technique::cpu : by_position[fastest(candidate, best)];
        std::visit([&](auto& query) { query.technique = technique; }, *candidate.query);
    }
}

}  // namespace nearfield::select
