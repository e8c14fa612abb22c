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

// A device is used only where a batch takes less than this part of the time without it: the model
// is not as exact, and shapes that both use are prepared by either.
constexpr double worth_a_device = 0.97;

// How often the interval of prices is halved. Queries whose prices are closer together than a
// 4,096th move to the CPU in the order of the batch.
constexpr int price_steps = 12;

/// The sum of costs, of which the second ones count `weight`.
QueryCosts sum_of(const QueryCosts& first, const QueryCosts& second, double weight) {
    QueryCosts costs;
    for (WorkCost QueryCosts::*const kind : kinds_of_work) {
        for (double WorkCost::*const part :
             {&WorkCost::query, &WorkCost::edge, &WorkCost::sample, &WorkCost::search}) {
            costs.*kind.*part = first.*kind.*part + weight * (second.*kind.*part);
        }
    }
    return costs;
}

/// The part of a device's costs that the CPU's answers cannot hide.
QueryCosts not_hidden(const DeviceCosts& costs, double overlap) {
    return sum_of(sum_of(costs.plan, costs.read, 1.0), costs.device, 1.0 - overlap);
}

/// What the device's and the CPU's time count at a price of the device's, from 0 (the device's
/// work is hidden) to 1 (the CPU's is). A batch takes as long as its weighted time at 0 or at 1,
/// whichever is longer.
LoadWeights weights_at(double price, double overlap) {
    return {1.0 - (1.0 - price) * overlap, 1.0 - price * overlap};
}

Technique technique_of(const AnyQuery& query) {
    return std::visit([](const auto& asked) { return asked.technique; }, query);
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

bool TechniqueSelector::is_answered_by_any(const AnyQuery& query) const {
    return std::any_of(by_position.begin(), by_position.end(),
                       [&](Technique technique) { return can_answer(technique, query); });
}

void TechniqueSelector::count_uses(std::span<const AnyQuery> queries,
                                   std::span<const plan::QueryShapes> shapes) {
    const auto shares_shapes = [](const AnyQuery& query) {
        return technique_of(query) == Technique::automatic &&
               (std::holds_alternative<PenetrationQuery>(query) ||
                std::holds_alternative<ContactQuery>(query));
    };
    const auto count = std::count_if(queries.begin(), queries.end(), shares_shapes);
    if (count == 0) {
        return;
    }
    uses_.begin(2 * static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < queries.size(); ++i) {
        if (shares_shapes(queries[i]) && are_known(queries[i], shapes[i])) {
            uses_.add(*shapes[i].a);
            uses_.add(*shapes[i].b);
        }
    }
}

TechniqueSelector::Set TechniqueSelector::add_candidates(
    std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes) {
    candidates_.clear();
    if (available_.device) {
        count_uses(queries, shapes);
    }
    Set others = 0;
    SparseCheckpoint<256> checkpoint;
    for (std::size_t index = 0; index < queries.size(); ++index) {
        checkpoint.step();
        const Technique asked = technique_of(queries[index]);
        if (asked == Technique::automatic && is_answered_by_any(queries[index])) {
            add_candidate(queries[index], shapes[index]);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            others |= asked == by_position[i] ? 1U << i : 0U;
        }
    }
    return others;
}

double TechniqueSelector::shared_edges(const plan::QueryShapes& shapes) const {
    const auto shared = [this](const geometry::Polygon& shape) {
        return shape.size() * (1.0 - 1.0 / uses_.count(shape));
    };
    return shared(*shapes.a) + shared(*shapes.b);
}

void TechniqueSelector::add_candidate(AnyQuery& query, const plan::QueryShapes& shapes) {
    Candidate& candidate = candidates_.emplace_back();
    candidate.query = &query;
    candidate.shapes = shapes;
    if (!plan::answers(Technique::cpu, query)) {
        candidate.max_saved.fill(never);
    } else if (are_known(query, shapes)) {
        const WorkBounds bounds = work_bounds(query, shapes.a, *shapes.b);
        if (available_.device && bounds.most.kind == &QueryCosts::points) {
            candidate.shared_edges = shared_edges(shapes);
        }
        for (std::uint32_t device = 0; device < cpu; ++device) {
            candidate.max_saved[device] =
                bounds.max_saved(by_cpu_, not_hidden_[device]) +
                devices_[device].plan.points.edge * candidate.shared_edges;
        }
    }
    for (std::uint32_t device = 0; device < cpu; ++device) {
        if (!available_.has(by_position[device])) {
            candidate.max_saved[device] = 0.0;
        }
    }
}

Load TechniqueSelector::load_of(const Work& work, std::uint32_t technique) const {
    const Load load = technique == cpu ? work.load(cpu_) : work.load(devices_[technique]);
    // An invalid query may contain NaN, which gives no time.
    return load.time(0.0) < never ? load : Load{};
}

void TechniqueSelector::estimate(Candidate& candidate) const {
    const AnyQuery& query = *candidate.query;
    const plan::QueryShapes& shapes = candidate.shapes;
    Work work = rough_work(query, shapes);
    work.shared_edges = candidate.shared_edges;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool is_ruled_out = i == compute && can_answer(Technique::cpu, query) &&
                                  may_be_refused(query, shapes, largest_range_);
        candidate.loads[i] = can_answer(by_position[i], query) && !is_ruled_out
                                 ? load_of(work, i)
                                 : Load{.alone = never};
    }
}

double TechniqueSelector::saved(const Candidate& candidate, std::uint32_t device) const {
    const LoadWeights hidden = weights_at(0.0, overlap_);
    return std::max(
        0.0, candidate.loads[cpu].weighted(hidden) - candidate.loads[device].weighted(hidden));
}

TechniqueSelector::Set TechniqueSelector::worthwhile_devices(Set paid) {
    Savings saved_by{};
    for (const Candidate& candidate : candidates_) {
        for (std::uint32_t device = 0; device < cpu; ++device) {
            saved_by[device] += candidate.max_saved[device];
        }
    }
    // A device that cannot save the cost of its submission, even if the CPU's answers hide its
    // work, is left out. If all are, nothing needs a closer look, which would take as long as
    // answering small pairs.
    const auto worthwhile = [&] {
        Set devices = 0;
        for (std::uint32_t device = 0; device < cpu; ++device) {
            const double cost = submissions(1U << device, paid).weighted(weights_at(0.0, overlap_));
            // Without a number where only a device answers.
            devices |= saved_by[device] <= cost ? 0U : 1U << device;
        }
        return devices;
    };
    for (Candidate& candidate : candidates_) {
        if (worthwhile() == 0) {
            return 0;
        }
        estimate(candidate);
        for (std::uint32_t device = 0; device < cpu; ++device) {
            saved_by[device] += saved(candidate, device) - candidate.max_saved[device];
        }
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
                load += load_of(rough_work(queries[index], shapes[index]), i);
            }
        }
    }
    return load;
}

std::uint32_t TechniqueSelector::fastest(const Candidate& candidate, const LoadWeights& weights,
                                         Set devices) {
    std::uint32_t best = cpu;
    double least = never;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double time = candidate.loads[i].weighted(weights);
        if ((i == cpu || (devices >> i & 1U) != 0) && time < least) {
            least = time;
            best = i;
        }
    }
    return best;
}

Load TechniqueSelector::choose_by(const LoadWeights& weights, Set devices, const Load& fixed) {
    Load load = fixed;
    for (Candidate& candidate : candidates_) {
        candidate.chosen = fastest(candidate, weights, devices);
        load += candidate.loads[candidate.chosen];
    }
    return load;
}

Load TechniqueSelector::choose_with(Set devices, const Load& fixed) {
    // The dearer the device's time, the fewer queries go there. The batch takes least at the price
    // at which device and CPU have as much to do, or at an end of the interval.
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step < price_steps; ++step) {
        const double middle = 0.5 * (low + high);
        const Load load = choose_by(weights_at(middle, overlap_), devices, fixed);
        (load.device > load.cpu ? low : high) = middle;
    }
    const LoadWeights dearer = weights_at(high, overlap_);
    Load load = choose_by(weights_at(low, overlap_), devices, fixed);
    for (Candidate& candidate : candidates_) {
        const std::uint32_t other = fastest(candidate, dearer, devices);
        Load moved = load;
        moved -= candidate.loads[candidate.chosen];
        moved += candidate.loads[other];
        if (moved.time(overlap_) < load.time(overlap_)) {
            load = moved;
            candidate.chosen = other;
        }
    }
    return load;
}

void TechniqueSelector::choose_best(Set devices, Set paid, const Load& others) {
    double limit = worth_a_device * choose_by({}, 0, others).time(overlap_);
    for (Candidate& candidate : candidates_) {
        candidate.best = candidate.chosen;
    }
    for (Set used = 1; used <= devices; ++used) {
        if ((used & devices) != used) {
            continue;
        }
        Load fixed = others;
        fixed += submissions(used, paid);
        const double time = choose_with(used, fixed).time(overlap_);
        if (time < limit) {
            limit = time;
            for (Candidate& candidate : candidates_) {
                candidate.best = candidate.chosen;
            }
        }
    }
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
