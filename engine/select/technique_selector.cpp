#include <engine/base/interruption.hpp>
#include <engine/plan/search_shapes.hpp>
#include <engine/select/technique_selector.hpp>
#include <engine/select/work.hpp>

#include <shaders/fields.h>

#include <algorithm>

namespace nearfield::select {
namespace {

constexpr std::array<Technique, 3> by_position{Technique::raster, Technique::compute,
                                               Technique::cpu};

// Of more queries than these ...
constexpr std::size_t fewest_to_sample = 512;
// ... about so many are looked at first; what they say of the others is right but for this factor.
constexpr std::size_t looked_at_first = 128;
constexpr double sample_error = 2.0;
// What a closer look at a query takes, about, in microseconds.
constexpr double close_look = 0.3;

/// The sum of costs, of which the second ones count `weight`.
QueryCosts sum_of(const QueryCosts& first, const QueryCosts& second, double weight) {
    QueryCosts costs;
    for (WorkCost QueryCosts::*const kind : kinds_of_work) {
        for (double WorkCost::*const part : {&WorkCost::query, &WorkCost::edge, &WorkCost::sample,
                                             &WorkCost::search, &WorkCost::shape}) {
            costs.*kind.*part = first.*kind.*part + weight * (second.*kind.*part);
        }
    }
    return costs;
}

/// The part of a device's costs that the CPU's answers cannot hide.
QueryCosts not_hidden(const DeviceCosts& costs, double overlap) {
    return sum_of(sum_of(costs.plan, costs.read, 1.0), costs.device, 1.0 - overlap);
}

/// The technique that a query asks for, or the CPU's if that one leaves it to the CPU.
Technique technique_of(const AnyQuery& query) {
    return std::visit(
        []<class Query>(const Query& asked) {
            const bool is_left =
                asked.technique == Technique::compute && plan::is_left_to_cpu_by_compute<Query>;
            return is_left ? Technique::cpu : asked.technique;
        },
        query);
}

/// Whether the shapes that a query needs are present.
bool are_known(const AnyQuery& query, const plan::QueryShapes& shapes) {
    return shapes.b != nullptr &&
           (shapes.a != nullptr || std::holds_alternative<DistanceFieldQuery>(query));
}

/// Nothing if shapes are missing, for a query that will be rejected.
Work rough_work(const AnyQuery& query, const plan::QueryShapes& shapes) {
    return are_known(query, shapes) ? work_of(query, shapes.a, *shapes.b) : Work{};
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

TechniqueSelector::TechniqueSelector(const CostModel& costs,
                                     const plan::AvailableTechniques& available,
                                     std::uint64_t largest_range)
    : devices_({costs.raster, costs.compute}),
      cpu_(costs.cpu),
      overlap_(costs.overlap),
      by_cpu_(sum_of(cpu_.plan, cpu_.answer, 1.0)),
      not_hidden_({not_hidden(costs.raster, overlap_), not_hidden(costs.compute, overlap_)}),
      available_(available),
      largest_range_(largest_range) {}

TechniqueSelector::Set TechniqueSelector::techniques_for(const AnyQuery& query) const {
    Set techniques = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool is_one =
            available_.has(by_position[i]) && plan::is_candidate(by_position[i], query);
        techniques |= is_one ? 1U << i : 0U;
    }
    return techniques;
}

TechniqueSelector::Set TechniqueSelector::add_candidates(
    std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes) {
    candidates_.clear();
    Set others = 0;
    SparseCheckpoint<256> checkpoint;
    for (std::size_t index = 0; index < queries.size(); ++index) {
        checkpoint.step();
        const Technique asked = technique_of(queries[index]);
        if (asked == Technique::automatic) {
            add_candidate(queries[index], shapes[index]);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            others |= asked == by_position[i] ? 1U << i : 0U;
        }
    }
    return others;
}

void TechniqueSelector::add_candidate(AnyQuery& query, const plan::QueryShapes& shapes) {
    const Set techniques = techniques_for(query);
    if (techniques == 0) {
        return;
    }
    Candidate& candidate = candidates_.emplace_back();
    candidate.query = &query;
    candidate.shapes = shapes;
    candidate.techniques = techniques;
    Savings max_saved{};
    if (!candidate.can_use(cpu)) {
        max_saved.fill(never);
    } else if (techniques != 1U << cpu && are_known(query, shapes)) {
        WorkBounds bounds = work_bounds(query, shapes.a, *shapes.b);
        bounds.most.shape_edges = bounds.most.edges;  // if no other query has its shapes
        for (std::uint32_t device = 0; device < cpu; ++device) {
            max_saved[device] = bounds.max_saved(by_cpu_, not_hidden_[device]);
        }
    }
    for (std::uint32_t device = 0; device < cpu; ++device) {
        candidate.max_saved[device] = candidate.can_use(device) ? max_saved[device] : 0.0;
    }
}

void TechniqueSelector::count_shapes() {
    uses_.begin(2 * candidates_.size());
    for (Candidate& candidate : candidates_) {
        const AnyQuery& query = *candidate.query;
        const plan::QueryShapes& shapes = candidate.shapes;
        if (!are_known(query, shapes)) {
            continue;
        }
        WorkCost QueryCosts::*const kind = kind_of(query);
        candidate.uses[0] = uses_.add(*shapes.b, kind);
        if (!std::holds_alternative<DistanceFieldQuery>(query)) {
            candidate.uses[1] = uses_.add(*shapes.a, kind);  // of which a field needs the box alone
        }
    }
}

double TechniqueSelector::shape_edges(const Candidate& candidate) const {
    double edges = 0.0;
    for (const std::optional<std::uint32_t>& index : candidate.uses) {
        if (index) {
            const ShapeUse& use = uses_[*index];
            edges += static_cast<double>(use.shape->size()) / use.count;
        }
    }
    return edges;
}

Load TechniqueSelector::load_of(const Work& work, std::uint32_t technique) const {
    const Load load = technique == cpu ? work.load(cpu_) : work.load(devices_[technique]);
    // An invalid query may contain NaN, which gives no time.
    return load.time(0.0) < never ? load : Load{};
}

void TechniqueSelector::estimate(Candidate& candidate) const {
    candidate.is_estimated = true;
    const AnyQuery& query = *candidate.query;
    const plan::QueryShapes& shapes = candidate.shapes;
    Work work = rough_work(query, shapes);
    work.shape_edges = shape_edges(candidate);
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool is_ruled_out =
            i == compute && candidate.can_use(cpu) && may_be_refused(query, shapes, largest_range_);
        candidate.loads[i] =
            candidate.can_use(i) && !is_ruled_out ? load_of(work, i) : Load{.alone = never};
    }
}

double TechniqueSelector::saved(const Candidate& candidate, std::uint32_t device) const {
    const LoadWeights hidden = weights_at(0.0, overlap_);
    return std::max(
        0.0, candidate.loads[cpu].weighted(hidden) - candidate.loads[device].weighted(hidden));
}

TechniqueSelector::Savings TechniqueSelector::least_savings(Set paid) const {
    Savings least{};
    for (std::uint32_t device = 0; device < cpu; ++device) {
        least[device] = submissions(1U << device, paid).weighted(weights_at(0.0, overlap_));
    }
    return least;
}

bool TechniqueSelector::is_a_close_look_worthwhile(const Savings& least) {
    const std::size_t stride = candidates_.size() / looked_at_first;
    Savings expected{};
    Savings small_at_most{};
    Savings sampled{};
    Savings sampled_at_most{};
    std::size_t small = 0;
    for (Candidate& candidate : candidates_) {
        const bool is_large = candidate.max_saved[raster] > least[raster] ||
                              candidate.max_saved[compute] > least[compute];
        const bool is_sampled = !is_large && small++ % stride == 0;
        if (is_large || is_sampled) {
            estimate(candidate);
        }
        for (std::uint32_t device = 0; device < cpu; ++device) {
            const double at_most = candidate.max_saved[device];
            expected[device] += is_large ? saved(candidate, device) : 0.0;
            small_at_most[device] += is_large ? 0.0 : at_most;
            sampled[device] += is_sampled ? saved(candidate, device) : 0.0;
            sampled_at_most[device] += is_sampled ? at_most : 0.0;
        }
    }
    bool is_worthwhile = false;
    for (std::uint32_t device = 0; device < cpu; ++device) {
        if (sampled_at_most[device] > 0.0) {
            expected[device] += small_at_most[device] * sampled[device] / sampled_at_most[device];
        }
        const double cost = least[device] + close_look * static_cast<double>(small);
        is_worthwhile = is_worthwhile || sample_error * expected[device] > cost;
    }
    return is_worthwhile;
}

TechniqueSelector::Set TechniqueSelector::worthwhile_devices(Set paid) {
    const Savings least = least_savings(paid);
    // A device that cannot save the cost of its submission, even if the CPU's answers hide its
    // work, is left out. If all are, nothing needs a closer look, which would take as long as
    // answering small pairs.
    Savings saved_by{};
    const auto worthwhile = [&] {
        Set devices = 0;
        for (std::uint32_t device = 0; device < cpu; ++device) {
            // Without a number where only a device answers.
            devices |= saved_by[device] <= least[device] ? 0U : 1U << device;
        }
        return devices;
    };
    const auto add = [&](const Savings& savings, double sign) {
        for (std::uint32_t device = 0; device < cpu; ++device) {
            saved_by[device] += sign * savings[device];
        }
    };
    for (const Candidate& candidate : candidates_) {
        add(candidate.max_saved, 1.0);
    }
    if (worthwhile() == 0) {
        return 0;
    }
    count_shapes();
    if (candidates_.size() >= fewest_to_sample && !is_a_close_look_worthwhile(least)) {
        return 0;
    }
    for (Candidate& candidate : candidates_) {
        if (worthwhile() == 0) {
            return 0;
        }
        if (!candidate.is_estimated) {
            estimate(candidate);
        }
        add(candidate.max_saved, -1.0);
        add({saved(candidate, raster), saved(candidate, compute)}, 1.0);
    }
    return worthwhile();
}

Load TechniqueSelector::submissions(Set devices, Set paid) const {
    Load load;
    for (std::uint32_t device = 0; device < cpu; ++device) {
        if ((devices >> device & 1U) != 0 && (paid >> device & 1U) == 0) {
            load += {.alone = devices_[device].submission, .device = devices_[device].latency};
        }
    }
    return load;
}

Load TechniqueSelector::load_of_others(std::span<const AnyQuery> queries,
                                       std::span<const plan::QueryShapes> shapes,
                                       Set others) const {
    Load load = submissions(others, 0);
    for (std::size_t index = 0; others != 0 && index < queries.size(); ++index) {
        const Technique asked = technique_of(queries[index]);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (asked == by_position[i]) {
                Work work = rough_work(queries[index], shapes[index]);
                work.shape_edges = work.edges;
                load += load_of(work, i);
            }
        }
    }
    return load;
}

void TechniqueSelector::choose(std::span<AnyQuery> queries,
                               std::span<const plan::QueryShapes> shapes) {
    const Set others = add_candidates(queries, shapes);
    const Set devices = worthwhile_devices(others);
    if (devices != 0) {
        choose_best(devices, others, load_of_others(queries, shapes, others));
    }
    for (const Candidate& candidate : candidates_) {
        const Technique technique = by_position[candidate.best];
        std::visit([&](auto& query) { query.technique = technique; }, *candidate.query);
    }
}

}  // namespace nearfield::select
