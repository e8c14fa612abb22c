#include <engine/narrowphase/candidate_edge_pairs.hpp>

namespace nearfield::narrowphase {

bool CandidateEdgePairs::pick_near(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                   double grow) {
    const simd::Extent common =
        geometry::extent_of(geometry::grown(a.box.intersection(b.box), grow));
    of_a_.pick(a, common);
    if (of_a_.empty()) {
        return false;
    }
    of_b_.pick(b, common);
    return !of_b_.empty();
}

}  // namespace nearfield::narrowphase
