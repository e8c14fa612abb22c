#include <engine/base/status_exception.hpp>
#include <engine/render/pair_counts.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::render {
namespace {

/// Sums end at 2^30 (shaders/sums.glsl), and a thread has a number of 32 bits.
constexpr std::uint32_t max_counted = 1U << 29U;

constexpr PairCounts first_of_points{16384, 16384, 4096, 4096, 1024, 1024};
constexpr PairCounts first_of_tests{16384, 0, 0, 4096, 4096, 1024};

}  // namespace

PairCounts first_capacities(const plan::PairSearchKind& kind) {
    PairCounts counts = kind.goal == plan::PairGoal::tests ? first_of_tests : first_of_points;
    if (kind.points == plan::FoundPoints::compared) {
        counts[plan::record_total] = 0;
    }
    return counts;
}

bool is_countable(const PairCounts& counts) {
    return counts[plan::pair_total] < plan::max_pairs &&
           std::all_of(counts.begin(), counts.end(),
                       [](std::uint32_t count) { return count <= max_counted; });
}

void require_searchable(const PairCounts& counts) {
    if (counts[plan::pair_total] == plan::too_many_pairs) {
        throw StatusException(
            {StatusCode::too_large,
             "the world has an instance whose box overlaps with those of some 50,000 others, or "
             "whose pairs have 2^27 edges"});
    }
}

PairCounts grown(const PairCounts& counts, const PairCounts& capacities) {
    PairCounts larger = capacities;
    double growth = 1.0;
    for (const auto stage : {plan::pair_total, plan::item_total, plan::edge_total,
                             plan::point_total, plan::record_total, plan::row_total}) {
        const double expected = growth * counts[stage];
        const double most = stage == plan::row_total ? counts[plan::pair_total] : max_counted;
        if (expected > capacities[stage]) {
            larger[stage] = std::max(capacities[stage],
                                     static_cast<std::uint32_t>(std::min(1.25 * expected, most)));
        }
        if (stage != plan::pair_total) {
            growth *= std::max(1.0, 1.0 * counts[stage] / std::max(capacities[stage], 1U));
        }
    }
    return larger;
}

Status overflow(const PairCounts& counts, const PairCounts& capacities) {
    constexpr std::array<const char*, plan::stages_of_pairs> names{
        "edges", "points", "points near or inside", "pairs", "groups of edges", "rows"};
    std::vector<std::string> reasons;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > capacities[i]) {
            reasons.push_back(std::to_string(counts[i]) + ' ' + names[i] + ", and room for " +
                              std::to_string(capacities[i]));
        }
    }
    return {StatusCode::overflow,
            "the recorded commands found more than there was room for; the next ones will have "
            "room for as many, if they are recorded anew",
            std::move(reasons)};
}

}  // namespace nearfield::render
