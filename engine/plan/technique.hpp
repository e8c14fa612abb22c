#pragma once

#include <nearfield/query.hpp>

#include <type_traits>
#include <variant>

namespace nearfield::plan {

/// What of a query a technique has no answer for, in words for a message; null where it answers all
/// of it.
template <class Query>
[[nodiscard]] const char* unanswered(Technique technique, const Query& query) {
    if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
        const bool asks_gradients = query.gradients || !query.points.empty();
        if (technique == Technique::compute && asks_gradients &&
            query.gradient == GradientMethod::blended) {
            return "gradients by blending, which is a way of drawing";
        }
        if (technique == Technique::cpu) {
            return "distance fields";
        }
    }
    if constexpr (std::is_same_v<Query, IntersectionQuery>) {
        if (technique == Technique::cpu) {
            return "intersections";
        }
    }
    if constexpr (std::is_same_v<Query, IntersectionTestQuery>) {
        if (technique != Technique::cpu && technique != Technique::automatic) {
            return "intersection tests";
        }
    }
    if constexpr (std::is_same_v<Query, ContactQuery>) {
        if (technique == Technique::cpu && query.normals == ContactNormals::gradient) {
            return "contacts with normals by gradient";
        }
    }
    return nullptr;
}

[[nodiscard]] inline bool answers(Technique technique, const AnyQuery& query) {
    return std::visit([&](const auto& asked) { return unanswered(technique, asked) == nullptr; },
                      query);
}

}  // namespace nearfield::plan
