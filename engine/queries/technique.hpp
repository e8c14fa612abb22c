#pragma once

#include <nearfield/query.hpp>

#include <type_traits>
#include <variant>

namespace nearfield::queries {

/// The techniques available in a context. The CPU's always is.
struct AvailableTechniques {
    bool device = true;      ///< false: neither of the two below is available
    bool draws = true;       ///< false: the device's queue family does not, so there is no raster
    bool has_raster = true;  ///< false: the library was built without it
    bool raster = true;
    bool compute = true;

    [[nodiscard]] bool has(Technique technique) const {
        switch (technique) {
            case Technique::raster:
                return raster;
            case Technique::compute:
                return compute;
            default:
                return true;
        }
    }
};

/// What messages call a kind of query that only the CPU answers; null for other kinds.
template <class Query>
inline constexpr const char* answered_by_cpu_alone = nullptr;
template <>
inline constexpr const char* answered_by_cpu_alone<IntersectionTestQuery> = "intersection tests";
template <>
inline constexpr const char* answered_by_cpu_alone<TimeOfImpactQuery> = "times of impact";
template <>
inline constexpr const char* answered_by_cpu_alone<SeparationVectorQuery> = "separation vectors";
template <>
inline constexpr const char* answered_by_cpu_alone<ContainmentQuery> = "containment";

/// Whether technique compute leaves a kind of query to the CPU, whose search for the closest pair
/// is exact and as quick with no bound from a device as with one.
template <class Query>
inline constexpr bool is_left_to_cpu_by_compute =
    std::is_same_v<Query, ClosestPointQuery> || std::is_same_v<Query, SeparationQuery>;

/// Describes, for a message, the part of a query that a technique does not answer; null if it
/// answers all of it.
template <class Query>
[[nodiscard]] const char* unanswered(Technique technique, const Query& query) {
    if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
        const bool asks_gradients = query.gradients || !query.points.empty();
        const bool draws = technique == Technique::raster || technique == Technique::automatic;
        const bool asks_blended = asks_gradients && query.gradient == GradientMethod::blended;
        if (asks_blended && query.on_device) {
            return "blended gradients of a field that is to stay on the device (on_device)";
        }
        if (!draws && asks_blended) {
            return "blended gradients, which are drawn";
        }
    }
    if constexpr (requires { query.on_device; }) {
        const bool keeps = technique == Technique::compute || technique == Technique::automatic;
        if (!keeps && query.on_device) {
            return "what is to stay on the device (on_device)";
        }
    }
    const bool may_be_cpu = technique == Technique::cpu || technique == Technique::automatic;
    return may_be_cpu ? nullptr : answered_by_cpu_alone<Query>;
}

/// Whether a technique is one to choose from for a query.
[[nodiscard]] inline bool is_candidate(Technique technique, const AnyQuery& query) {
    return std::visit(
        [&]<class Query>(const Query& asked) {
            const bool is_cpu_after_all =
                technique == Technique::compute && is_left_to_cpu_by_compute<Query>;
            return !is_cpu_after_all && unanswered(technique, asked) == nullptr;
        },
        query);
}

}  // namespace nearfield::queries
