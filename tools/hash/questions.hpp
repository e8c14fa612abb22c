#pragma once

#include <nearfield/query.hpp>

#include <span>

namespace nearfield::hash {

/// Two shapes of a context at their poses.
struct PlacedPair {
    Instance a;
    Instance b;
    double tolerance = 0.0;
};

/// Appends every kind of query that Technique::cpu answers, with every option that makes a
/// difference to it. `points`: where fields are asked at points; they must outlive the batch.
/// `max_work`: of separation vectors.
void ask_everything(const PlacedPair& pair, std::span<const Vector2> points, std::uint64_t max_work,
                    Batch& batch);

}  // namespace nearfield::hash
