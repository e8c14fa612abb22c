#pragma once

#include <engine/narrowphase/overlap_test.hpp>
#include <engine/simd/transformed_edges.hpp>

namespace nearfield::solvers {

/// Finds a point of two complete shapes that are known to share one, up to rounding. Reuses its
/// memory between pairs.
class CommonPoint {
public:
    [[nodiscard]] geometry::Vector find(const simd::TransformedEdges& a,
                                        const simd::TransformedEdges& b);

private:
    narrowphase::OverlapTest overlap_test_;
};

}  // namespace nearfield::solvers
