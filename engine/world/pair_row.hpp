#pragma once

#include <nearfield/world_pairs.hpp>

#include <type_traits>

namespace nearfield {

/// The row of a pair with this result; without its place and the number of its records.
template <class Query>
PairRow<Query> row_of(InstanceHandle a, InstanceHandle b, const typename Query::Result& result) {
    PairRow<Query> row;
    static_cast<typename Query::Result::Values&>(row) = result;
    row.a = a;
    row.b = b;
    row.status = result.status.code();
    row.intersects = result.intersects;
    row.error_bound = result.error_bound;
    return row;
}

/// Whether an answer, a result or a row whose status is good, makes a hit of its pair
/// (PairTableOptions::hits_only).
template <class Answer>
bool is_hit(const Answer& answer, double reach) {
    if constexpr (std::is_base_of_v<PenetrationValues, Answer>) {
        return answer.count > 0;
    } else if constexpr (std::is_base_of_v<TimeOfImpactValues, Answer>) {
        return answer.state != ImpactState::separated;
    } else if constexpr (std::is_base_of_v<ContainmentValues, Answer>) {
        return answer.inside;
    } else if constexpr (requires { answer.distance; }) {
        return answer.intersects || answer.distance <= reach;
    } else if constexpr (requires { answer.count; }) {
        return answer.intersects || answer.count > 0;
    } else {
        return answer.intersects;
    }
}

}  // namespace nearfield
