#pragma once

#include <engine/queries/error_budget.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <type_traits>

namespace nearfield::device_input {

/// What the device finds out about the pairs of a world's instances.
enum class PairGoal : std::uint8_t {
    penetrations,  ///< the points of A inside B, for ordered pairs
    contacts,      ///< the points of either shape near the other, for ordered pairs
    tests,         ///< whether the shapes intersect, or are near each other
};

/// What becomes of the points that are found, beyond the answers of the pairs.
enum class FoundPoints : std::uint8_t {
    compared,  ///< nothing
    numbered,  ///< they have numbers, for results that stay on the device
    packed,    ///< the host reads them, in the order of their numbers
    asked,     ///< likewise, but for those of which the pair's row tells all that is asked
};

/// What the passes of a search between pairs depend on.
struct PairSearchKind {
    PairGoal goal{};
    FoundPoints points{};

    /// Each pair that a batch gives says whether its points are asked for. The pairs of a world are
    /// found.
    [[nodiscard]] bool are_given() const { return points == FoundPoints::asked; }
    [[nodiscard]] bool reads_points() const {
        return points == FoundPoints::packed || points == FoundPoints::asked;
    }
    friend bool operator==(const PairSearchKind&, const PairSearchKind&) = default;
};
/// Of the pairs of a batch, whatever its queries ask about points.
inline constexpr PairSearchKind given_pairs{PairGoal::penetrations, FoundPoints::asked};
inline constexpr std::array<PairSearchKind, 6> pair_search_kinds{
    {{PairGoal::penetrations, FoundPoints::compared},
     {PairGoal::penetrations, FoundPoints::numbered},
     {PairGoal::penetrations, FoundPoints::packed},
     {PairGoal::contacts, FoundPoints::packed},
     {PairGoal::tests, FoundPoints::compared},
     given_pairs}};

/// What a query asks of the device about every pair of a world's instances. World units.
struct PairQuestion {
    PairGoal goal{};
    double tolerance = 0.0;  ///< of tests: 0, there is none
    double resolved = 0.0;   ///< that coordinates have to resolve; 0: any do
    double cell = 0.0;       ///< the side of a grid cell
    bool samples = false;    ///< along the edges, not only vertices
    bool records = false;    ///< the result lists points
    double reach = 0.0;      ///< the largest distance of a contact, or of shapes that are near
    bool is_once = false;    ///< each pair is asked about once, the others in both orders
    bool on_device = false;  ///< rows and points also stay on the device

    /// Whether the host reads the points that are found: the rows of contacts are made of them.
    [[nodiscard]] bool reads_points() const { return records || goal == PairGoal::contacts; }
    [[nodiscard]] PairSearchKind kind() const {
        return {goal, reads_points() ? FoundPoints::packed
                      : on_device    ? FoundPoints::numbered
                                     : FoundPoints::compared};
    }
};

/// Queries whose answer is the same with the shapes swapped are asked once of each pair of a world,
/// the others in both orders.
template <class Query>
inline constexpr bool is_symmetric =
    std::is_same_v<Query, SeparationQuery> || std::is_same_v<Query, IntersectionTestQuery> ||
    std::is_same_v<Query, TimeOfImpactQuery>;

/// Whether the device answers a query for all pairs of a world.
[[nodiscard]] bool is_for_all_pairs(const AnyQuery& query);
/// Precondition: is_for_all_pairs(query).
/// `reach`: of separations and closest points.
[[nodiscard]] PairQuestion pair_question(const AnyQuery& query, double reach);
/// How such a query, which has a tolerance, spends it on shapes with these deviations.
[[nodiscard]] queries::ErrorBudget pair_budget(const AnyQuery& query,
                                               const queries::Deviations& deviations);

}  // namespace nearfield::device_input
