#pragma once

#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace nearfield::queries {

inline void clear_cells(DistanceFieldResult& result) {
    result.values.clear();
    result.features.clear();
    result.gradients.clear();
    result.unique.clear();
}

/// Returns an empty result of the right kind that keeps the memory of the last one. `keeps_cells`:
/// a field's arrays of cells stay as they are, since filling them costs more than all planning.
template <class Result>
Result& make_empty(AnyResult& any, bool keeps_cells = false) {
    if (!std::holds_alternative<Result>(any)) {
        any.emplace<Result>();
    }
    auto& result = std::get<Result>(any);
    if (!result.status.ok()) {
        result.status = {};
    }
    result.error_bound = 0.0;
    result.intersects = false;
    result.regions.clear();
    result.localization = {};
    if constexpr (std::is_same_v<Result, PenetrationResult>) {
        result.count = 0;
        result.deepest = {};
        result.points.clear();
    } else if constexpr (std::is_same_v<Result, IntersectionResult>) {
        result.count = 0;
        result.area = 0.0;
        result.box = {};
        result.samples.clear();
    } else if constexpr (std::is_same_v<Result, DistanceFieldResult>) {
        result.origin = {};
        result.width = result.height = 0;
        if (!keeps_cells) {
            clear_cells(result);
        }
        result.points.clear();
        result.gradient_error_bound = 0.0;
        result.gradient_format = "";
    } else if constexpr (std::is_same_v<Result, ContactResult>) {
        result.count = 0;
        result.manifold.clear();
        result.points.clear();
    } else {
        std::vector<Region> regions = std::move(result.regions);
        result = {};
        result.regions = std::move(regions);
    }
    return result;
}

/// Returns an empty result of a query, which states what the query itself says, and nothing of what
/// it held before. `keeps_cells`: see make_empty().
template <class Query>
typename Query::Result& begin_result(const Query& query, AnyResult& any, bool keeps_cells = false) {
    auto& result = make_empty<typename Query::Result>(any, keeps_cells);
    result.tolerance = result.cell = 0.0;
    if constexpr (requires { query.tolerance; }) {
        result.tolerance = query.tolerance;
    }
    if constexpr (std::is_same_v<Query, IntersectionQuery>) {
        result.kind = query.kind;
        result.strategy = query.strategy;
    }
    result.technique = query.technique;
    return result;
}

/// Makes the result of a query empty, with a status.
inline void make_refused(const AnyQuery& any_query, const Status& status, AnyResult& any) {
    std::visit([&](const auto& query) { begin_result(query, any).status = status; }, any_query);
}

/// Gives a result that is not done a status, and takes from it what was found so far.
inline void cut_short(const Status& status, AnyResult& any) {
    std::visit(
        [&](auto& result) { make_empty<std::decay_t<decltype(result)>>(any).status = status; },
        any);
}

}  // namespace nearfield::queries
