#pragma once

#include <engine/select/work.hpp>
#include <nearfield/cost.hpp>

#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace nearfield::select {

/// Zero, or a random cost on a logarithmic scale.
inline double random_cost(test::Random& random) {
    return random.whole(0, 3) == 0 ? 0.0 : random.scale(1e-3, 10.0);
}

inline QueryCosts random_costs(test::Random& random) {
    QueryCosts costs;
    for (WorkCost QueryCosts::*const kind : kinds_of_work) {
        costs.*kind = {random_cost(random), random_cost(random), random_cost(random),
                       random_cost(random), random_cost(random)};
    }
    return costs;
}

inline CostModel random_model(test::Random& random) {
    CostModel costs;
    for (DeviceCosts* const technique : {&costs.raster, &costs.compute}) {
        technique->submission = random.scale(1.0, 1e4);
        technique->latency = random.scale(1.0, 1e5);
        for (QueryCosts* const stage : {&technique->plan, &technique->device, &technique->read}) {
            *stage = random_costs(random);
        }
    }
    costs.cpu = {random_costs(random), random_costs(random)};
    costs.overlap = random.whole(0, 2) == 0 ? 1.0 : random.between(0.0, 1.0);
    return costs;
}

/// A query, and the numbers of its shapes, which it shares with others. Those that name a technique
/// do not: their work includes their shapes.
struct TimedQuery {
    Work work;
    std::vector<std::size_t> shapes;
};

/// A batch and the model's time of it, with a technique named for each query.
class TimedBatch {
public:
    TimedBatch(const CostModel& costs, std::vector<TimedQuery> queries,
               std::vector<double> shape_edges = {})
        : costs_(&costs), queries_(std::move(queries)), shape_edges_(std::move(shape_edges)) {}

    [[nodiscard]] double time(const std::vector<Technique>& techniques) const {
        double alone = 0.0;
        double device = 0.0;
        double cpu = 0.0;
        for (const auto& [technique, costs] : {std::pair(Technique::raster, costs_->raster),
                                               std::pair(Technique::compute, costs_->compute)}) {
            if (std::count(techniques.begin(), techniques.end(), technique) > 0) {
                alone += costs.submission;
                device += costs.latency;
            }
        }
        std::set<std::tuple<std::size_t, const WorkCost*, Technique>> prepared;
        for (std::size_t i = 0; i < queries_.size(); ++i) {
            Work work = queries_[i].work;
            for (const std::size_t shape : queries_[i].shapes) {
                const WorkCost& kind = costs_->cpu.plan.*work.kind;
                const bool is_new = prepared.insert({shape, &kind, techniques[i]}).second;
                work.shape_edges += is_new ? shape_edges_[shape] : 0.0;
            }
            if (techniques[i] == Technique::cpu) {
                alone += work.time(costs_->cpu.plan);
                cpu += work.time(costs_->cpu.answer);
            } else {
                const DeviceCosts& costs =
                    techniques[i] == Technique::raster ? costs_->raster : costs_->compute;
                alone += work.time(costs.plan) + work.time(costs.read);
                device += work.time(costs.device);
            }
        }
        return alone + device + cpu - costs_->overlap * std::min(device, cpu);
    }

    /// The most that the choice for one query of the batch makes, its shapes included.
    [[nodiscard]] double largest() const {
        double largest = 0.0;
        for (const TimedQuery& query : queries_) {
            Work work = query.work;
            for (const std::size_t shape : query.shapes) {
                work.shape_edges += shape_edges_[shape];
            }
            for (const DeviceCosts& costs : {costs_->raster, costs_->compute}) {
                largest =
                    std::max(largest, work.time(costs.plan) + work.time(costs.device) +
                                          work.time(costs.read) + work.time(costs_->cpu.plan) +
                                          work.time(costs_->cpu.answer));
            }
        }
        return largest;
    }

    /// By all ways to choose for the queries that leave it open.
    [[nodiscard]] double least(std::vector<Technique> techniques, std::size_t first = 0) const {
        while (first < techniques.size() && techniques[first] != Technique::automatic) {
            ++first;
        }
        if (first == techniques.size()) {
            return time(techniques);
        }
        double least = std::numeric_limits<double>::infinity();
        for (const Technique technique : {Technique::raster, Technique::compute, Technique::cpu}) {
            techniques[first] = technique;
            least = std::min(least, this->least(techniques, first + 1));
        }
        return least;
    }

private:
    const CostModel* costs_;
    std::vector<TimedQuery> queries_;
    std::vector<double> shape_edges_;
};

}  // namespace nearfield::select
