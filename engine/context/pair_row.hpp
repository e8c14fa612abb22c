#pragma once

#include <nearfield/world_pairs.hpp>

namespace nearfield {

/// The row of a pair with this result; without the places of its records.
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

}  // namespace nearfield
