#pragma once

#include <engine/plan/query_shapes.hpp>
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

    /// Replaces Technique::automatic by what was picked; `shapes`: of each query. A query that will
    /// be refused gets a technique too.
    void choose(std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes);

private:
    /// Techniques as positions of costs_, and sets of them as bits.
    enum : std::uint32_t { raster, compute, cpu, count };
    using Set = std::uint32_t;
    static constexpr Set every_set = 1U << count;

    /// A query that leaves the technique open: what it takes by each that has an answer, infinite
    /// for the others.
    struct Candidate {
        AnyQuery* query = nullptr;
        std::array<double, count> times{};
    };

    /// What can be said of a batch without a look at a vertex.
    struct Outlook {
        bool open = false;  ///< some query leaves the technique open
        Set paid = 0;       ///< techniques that others ask for
        /// Microseconds that devices could take less than the CPU for what is open, submissions
        /// left out: no more than this.
        double most_saved = 0.0;
    };
    [[nodiscard]] Outlook look(std::span<const AnyQuery> queries,
                               std::span<const plan::QueryShapes> shapes) const;
    /// What a device could save of one query.
    template <class Query>
    [[nodiscard]] double most_saved(const AnyQuery& any, const Query& query,
                                    const plan::QueryShapes& shapes) const;

    /// Notes the queries that leave the technique open.
    void add_candidates(std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes);
    void add_candidate(AnyQuery& query, const plan::QueryShapes& shapes);
    /// The techniques that may be used for the batch to take the least time.
    [[nodiscard]] Set best_set(Set paid) const;
    /// Microseconds of a technique's submission, where it is not paid.
    [[nodiscard]] double submission(std::uint32_t technique, Set paid) const {
        return (paid >> technique & 1U) != 0 ? 0.0 : costs_[technique].submission;
    }
    [[nodiscard]] static std::uint32_t fastest(const Candidate& candidate, Set allowed);
    /// Microseconds that all candidates take where only these techniques may be used, and `paid`
    /// ones are used anyway.
    [[nodiscard]] double time_by(Set allowed, Set paid) const;

    std::array<TechniqueCost, count> costs_;
    std::vector<Candidate> candidates_;
};

}  // namespace nearfield::choose
