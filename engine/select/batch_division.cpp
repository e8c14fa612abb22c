// How the queries of a batch are divided among techniques, once what each takes is estimated.

#include <engine/select/technique_selector.hpp>

#include <algorithm>
#include <bit>

namespace nearfield::select {
namespace {

// A device is used only where a batch takes less than this part of the time without it: the model
// is not as exact.
constexpr double worth_a_device = 0.97;
// And divided between device and CPU only where it takes less than this part: how far the two hide
// each other's work is known even less.
constexpr double worth_dividing = 0.9;

// How often the interval of prices is halved. Queries whose prices are closer together than a
// 4,096th move to the CPU in the order of the batch.
constexpr int price_steps = 12;

}  // namespace

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

Load TechniqueSelector::choose_alone(std::uint32_t device, const Load& fixed) {
    Load load = fixed;
    for (Candidate& candidate : candidates_) {
        candidate.chosen = candidate.loads[device].alone < never ? device : cpu;
        load += candidate.loads[candidate.chosen];
    }
    load += load_of_repeated_shapes();
    return load;
}

Load TechniqueSelector::load_of_shape(const ShapeUse& use, std::uint32_t technique,
                                      double edges) const {
    const auto time = [&](const QueryCosts& costs) { return (costs.*use.kind).shape * edges; };
    if (technique == cpu) {
        return {.alone = time(cpu_.plan), .cpu = time(cpu_.answer)};
    }
    const DeviceCosts& costs = devices_[technique];
    return {.alone = time(costs.plan) + time(costs.read), .device = time(costs.device)};
}

Load TechniqueSelector::load_of_repeated_shapes() {
    for (ShapeUse& use : uses_.all()) {
        use.chosen = {};
    }
    for (const Candidate& candidate : candidates_) {
        for (const std::optional<std::uint32_t>& index : candidate.uses) {
            if (index) {
                ++uses_[*index].chosen[candidate.chosen];
            }
        }
    }
    Load load;
    for (const ShapeUse& use : uses_.all()) {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (use.chosen[i] > 0 && use.chosen[i] < use.count) {
                const double others = 1.0 - static_cast<double>(use.chosen[i]) / use.count;
                load += load_of_shape(use, i, others * use.shape->size());
            }
        }
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
    load += load_of_repeated_shapes();
    return load;
}

void TechniqueSelector::choose_best(Set devices, Set paid, const Load& others) {
    const double by_cpu = choose_by({}, 0, others).time(overlap_);
    double limit = worth_a_device * by_cpu;
    for (Candidate& candidate : candidates_) {
        candidate.best = candidate.chosen;
    }
    const auto consider = [&](const Load& load, double worth) {
        const double time = load.time(overlap_);
        if (time < std::min(limit, worth * by_cpu)) {
            limit = time;
            for (Candidate& candidate : candidates_) {
                candidate.best = candidate.chosen;
            }
        }
    };
    for (Set used = 1; used <= devices; ++used) {
        if ((used & devices) != used) {
            continue;
        }
        Load fixed = others;
        fixed += submissions(used, paid);
        if (std::has_single_bit(used)) {
            const auto device = static_cast<std::uint32_t>(std::countr_zero(used));
            consider(choose_alone(device, fixed), worth_a_device);
        }
        consider(choose_with(used, fixed), worth_dividing);
    }
}

}  // namespace nearfield::select
