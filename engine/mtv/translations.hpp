#pragma once

#include <engine/mtv/work_budget.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace nearfield::mtv {

/// An interval of translation lengths along a direction for which two boundaries do not intersect.
struct TranslationGap {
    double from = 0.0;
    double to = std::numeric_limits<double>::infinity();
    simd::EdgePair begins_at;  ///< the edges that separate there; unset for a gap that begins at 0
    simd::EdgePair ends_at;    ///< the edges that touch there; unset for an unbounded gap
};

/// Finds where A's boundary intersects B's as A moves along a direction: an edge of A intersects an
/// edge of B over one interval of lengths, and the gaps lie between these intervals. Reuses its
/// memory between pairs.
class TranslationFinder {
public:
    /// Prepares for a pair whose translations are no longer than `longest`.
    void begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b, double longest);

    /// Returns the gaps from 0 up to `most`, in ascending order, up to rounding; none if that would
    /// exceed the work budget. `direction` is a unit vector. A is that of begin(), translated.
    [[nodiscard]] const std::vector<TranslationGap>& find(const simd::TransformedEdges& a,
                                                          const simd::TransformedEdges& b,
                                                          const geometry::Vector& direction,
                                                          double most, WorkBudget& work);

    /// Returns the first gap, or one that begins beyond `most` if there is none.
    [[nodiscard]] TranslationGap find_first(const simd::TransformedEdges& a,
                                            const simd::TransformedEdges& b,
                                            const geometry::Vector& direction, double most,
                                            WorkBudget& work);

private:
    /// An edge in coordinates along and across the direction, from the end that is lower across it.
    struct Level {
        double low = 0.0;
        double high = 0.0;
        double along_low = 0.0;
        double along_high = 0.0;
        std::uint32_t edge = 0;
    };
    struct Interval {
        double from = 0.0;
        double to = 0.0;
        simd::EdgePair edges;
    };

    /// Leaves out edges that neither come to `other` nor are reached by it on a way of `way` along
    /// the direction, which is negative for B.
    static void project(const simd::TransformedEdges& edges,
                        const std::vector<std::uint32_t>& in_reach, const geometry::Box& other,
                        const geometry::Vector& direction, double way, double rounding,
                        std::vector<Level>& levels);
    [[nodiscard]] static std::pair<double, double> range_at(const Level& edge, double low,
                                                            double high, double rounding);
    /// The ways along the direction after which two edges overlap.
    [[nodiscard]] static Interval interval_between(const Level& a, const Level& b, double rounding);
    /// Returns false if the work budget is too small.
    [[nodiscard]] bool add_intervals(double most, double rounding, WorkBudget& work);

    std::vector<std::uint32_t> in_reach_of_b_;  // edges of A
    std::vector<std::uint32_t> in_reach_of_a_;
    std::vector<Level> of_a_;
    std::vector<Level> of_b_;
    std::vector<Interval> intervals_;
    std::vector<TranslationGap> gaps_;
};

}  // namespace nearfield::mtv
