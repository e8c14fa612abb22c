#pragma once

#include <engine/plan/planner.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::choose {

/// Picks what answers each query of a batch: as the query says, or, for Technique::automatic, what
/// makes the batch take the least time by a cost model. A submission is paid once however many
/// queries use it, so what is best for one query depends on the others.
class Chooser {
public:
    explicit Chooser(const CostModel& costs) : costs_({costs.raster, costs.compute, costs.cpu}) {}

    /// Replaces Technique::automatic by what was picked. A query that will be refused gets a
    /// technique too.
    void choose(std::span<AnyQuery> queries, const plan::FindShape& find_shape);

private:
    /// Techniques as positions of costs_, and sets of them as bits.
    enum : std::uint32_t { raster, compute, cpu, count };
    using Set = std::uint32_t;
    static constexpr Set every_set = 1U << count;

    /// A query that leaves the technique open: what it takes by each that has an answer, infinite
    /// for the others.
    struct Candidate {
        std::uint32_t query = 0;
        std::array<double, count> times{};
    };

    void add_candidate(std::uint32_t index, const AnyQuery& query,
                       const plan::FindShape& find_shape);
    [[nodiscard]] static std::uint32_t fastest(const Candidate& candidate, Set allowed);
    /// Microseconds that all candidates take where only these techniques may be used, and `paid`
    /// ones are used anyway.
    [[nodiscard]] double time_by(Set allowed, Set paid) const;

    std::array<TechniqueCost, count> costs_;
    std::vector<Candidate> candidates_;
};

}  // namespace nearfield::choose
