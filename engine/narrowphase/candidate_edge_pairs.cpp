#include <engine/narrowphase/candidate_edge_pairs.hpp>

namespace nearfield::narrowphase {
namespace {

/// This few edges are compared with all of the other shape, which is faster than to select those.
constexpr std::uint32_t few_edges = 4;

}  // namespace

bool CandidateEdgePairs::find_all(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                  std::vector<simd::EdgePair>& pairs) {
    pairs.clear();
    const auto add = [&](const simd::EdgePair& pair) {
        pairs.push_back(pair);
        return true;
    };
    if (is_small(a) && is_small(b)) {
        for_each(a, b, add);
        return true;
    }
    constexpr std::uint32_t many_visits = 16;
    const simd::AabbTree tree_a = a.tree();
    const simd::AabbTree tree_b = b.tree();
    simd::VisitsLeft left{1024 + many_visits * (tree_a.count(0) + tree_b.count(0))};
    simd::kernels::for_candidate_pairs(tree_a, tree_b, a.rounding + b.rounding, add, left);
    return left.count > 0;
}

bool CandidateEdgePairs::pick_near(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                   double grow) {
    const simd::Extent common =
        geometry::extent_of(geometry::grown(a.box.intersection(b.box), grow));
    of_a_.pick(a, common);
    of_b_.clear();
    if (of_a_.size() <= few_edges) {
        return !of_a_.empty();
    }
    of_b_.pick(b, common);
    return !of_b_.empty();
}

}  // namespace nearfield::narrowphase
