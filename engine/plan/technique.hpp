#pragma once

#include <nearfield/query.hpp>

#include <type_traits>

namespace nearfield::plan {

/// True where Technique::cpu has an answer for a query.
template <class Query>
[[nodiscard]] bool cpu_answers(const Query& query) {
    if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
        return query.gradient != GradientMethod::blended;
    }
    return true;
}

/// True where Technique::automatic stands for the CPU.
template <class Query>
[[nodiscard]] bool cpu_is_preferred(const Query& query) {
    if constexpr (std::is_same_v<Query, ContactQuery>) {
        return query.normals == ContactNormals::analytic;
    }
    return !std::is_same_v<Query, DistanceFieldQuery> && !std::is_same_v<Query, IntersectionQuery>;
}

/// What answers a query: as it asks, or what Technique::automatic stands for.
template <class Query>
[[nodiscard]] Technique technique_of(const Query& query) {
    if (query.technique != Technique::automatic) {
        return query.technique;
    }
    return cpu_is_preferred(query) ? Technique::cpu : Technique::raster;
}

}  // namespace nearfield::plan
