#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/closest_pair.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace nearfield::narrowphase {
namespace {

using geometry::NearestOnSegment;
using geometry::Vector;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Maximum number of pairs kept: parallel walls have very many that are equally close up to a
/// margin.
constexpr std::size_t max_kept = 4096;

/// The square of a length increased by `by`.
double square_longer(double squared, double by) {
    const double longer = std::sqrt(squared) + by;
    return longer * longer;
}

/// Pairs in any fixed order.
auto order_of(const simd::VertexAndEdge& pair) {
    return std::tie(pair.vertex_of_first, pair.vertex, pair.edge);
}

}  // namespace

double ClosestPairFinder::squared_bound(double known) const {
    // From a vertex near the other's box to the other boundary and back: this quickly gets close.
    const simd::TransformedEdges* from = a_;
    const simd::TransformedEdges* other = b_;
    const simd::AabbTree* tree = &*tree_b_;
    const simd::AabbTree* other_tree = &*tree_a_;
    const Vector centre = b_->box.center();
    std::uint32_t vertex =
        simd::kernels::find_nearer(*tree_a_, centre.x(), centre.y(), {0, infinity}).edge;
    double least = known;
    for (int turn = 0; turn < 4; ++turn) {
        const simd::NearEdge nearest = simd::kernels::find_nearer(
            *tree, from->start_x[vertex], from->start_y[vertex], {0, least});
        if (nearest.squared >= least) {
            break;
        }
        least = nearest.squared;
        vertex = nearest.edge;
        std::swap(from, other);
        std::swap(tree, other_tree);
    }
    return least;
}

ClosestPair ClosestPairFinder::find(const simd::TransformedEdges& a,
                                    const simd::TransformedEdges& b, double at_most,
                                    double margin) {
    a_ = &a;
    b_ = &b;
    tree_a_.emplace(a.tree());
    tree_b_.emplace(b.tree());
    // Covers the rounding of the kernels and of transforming the vertices.
    const double rounding = a.rounding + b.rounding;
    double least = squared_bound(at_most * at_most);
    least = keep_near(least, 2.0 * rounding + margin, max_kept);
    keeps_all_ = near_.size() <= max_kept;
    if (!keeps_all_) {
        margin = 0.0;
        least = keep_near(least, 2.0 * rounding, std::numeric_limits<std::size_t>::max());
    }
    const double loose = square_longer(least, 2.0 * rounding + margin);
    std::erase_if(near_,
                  [loose](const simd::VertexAndEdge& found) { return found.squared > loose; });
    return pick(least);
}

ClosestPair ClosestPairFinder::find_of_few(const simd::TransformedEdges& a,
                                           const simd::TransformedEdges& b,
                                           const simd::AabbTree& tree_b, double at_most,
                                           const Vector& direction) {
    a_ = &a;
    b_ = &b;
    near_few_.clear();
    const simd::FewEdges few{a, geometry::extent_of(a.box), {direction.x(), direction.y()}};
    const double least = simd::kernels::for_closest_to_few(
        few, tree_b, at_most * at_most, 2.0 * (a.rounding + b.rounding),
        [this](const simd::NearPair& found) { near_few_.push_back(found); });
    // As pick().
    const double close = square_longer(least, a.rounding + b.rounding);
    const simd::NearPair* best = nullptr;
    for (const simd::NearPair& found : near_few_) {
        if (found.squared <= close &&
            (best == nullptr || found.exact < best->exact ||
             (found.exact == best->exact && order_of(found) < order_of(*best)))) {
            best = &found;
        }
    }
    return best == nullptr ? ClosestPair() : pair_of(*best, nearest_of(*best));
}

ClosestPair ClosestPairFinder::pick(double least) const {
    // The closest of the candidates that the kernels cannot distinguish.
    const double close = square_longer(least, a_->rounding + b_->rounding);
    const simd::VertexAndEdge* best = nullptr;
    NearestOnSegment nearest;
    nearest.squared_distance = infinity;
    for (const simd::VertexAndEdge& found : near_) {
        if (found.squared > close) {
            continue;
        }
        const NearestOnSegment other = nearest_of(found);
        // The order in which pairs arrive depends on the vector width.
        if (other.squared_distance < nearest.squared_distance ||
            (best != nullptr && other.squared_distance == nearest.squared_distance &&
             order_of(found) < order_of(*best))) {
            best = &found;
            nearest = other;
        }
    }
    return best == nullptr ? ClosestPair() : pair_of(*best, nearest);
}

double ClosestPairFinder::keep_near(double most, double margin, std::size_t max_pairs) {
    const auto keep = [&](const simd::VertexAndEdge& found) {
        near_.push_back(found);
        return near_.size() <= max_pairs;
    };
    near_.clear();
    return simd::kernels::for_closest(*tree_a_, *tree_b_, most, margin, keep);
}

NearestOnSegment ClosestPairFinder::nearest_of(const simd::VertexAndEdge& found) const {
    const simd::TransformedEdges& vertices = found.vertex_of_first ? *a_ : *b_;
    const simd::TransformedEdges& edges = found.vertex_of_first ? *b_ : *a_;
    return geometry::nearest_on_segment(vertices.start(found.vertex), edges.start(found.edge),
                                        edges.end(found.edge));
}

ClosestPair ClosestPairFinder::pair_of(const simd::VertexAndEdge& found,
                                       const NearestOnSegment& nearest) const {
    const Vector vertex = (found.vertex_of_first ? *a_ : *b_).start(found.vertex);
    if (found.vertex_of_first) {
        return {found.vertex,
                found.edge,
                vertex,
                nearest.point,
                0.0,
                nearest.parameter,
                nearest.squared_distance};
    }
    return {found.edge,        found.vertex, nearest.point,           vertex,
            nearest.parameter, 0.0,          nearest.squared_distance};
}

bool ClosestPairFinder::is_unique(const ClosestPair& closest, Side side, double margin,
                                  double apart) const {
    const double limit = square_longer(closest.squared_distance, margin);
    const double squared_apart = apart * apart;
    // If more than one pair is closest, another one contains a vertex: the distance of two straight
    // edges is least at an end of one of them, and if not only there, they are parallel.
    const auto is_rival = [&](const simd::VertexAndEdge& found) {
        const ClosestPair other = pair_of(found, nearest_of(found));
        const bool elsewhere = (other.point_a - closest.point_a).squaredNorm() > squared_apart ||
                               (side == Side::either &&
                                (other.point_b - closest.point_b).squaredNorm() > squared_apart);
        return other.squared_distance <= limit && elsewhere;
    };
    if (keeps_all_) {
        return std::none_of(near_.begin(), near_.end(), is_rival);
    }
    return !simd::kernels::for_within(
        *tree_a_, *tree_b_, square_longer(limit, 2.0 * (a_->rounding + b_->rounding)),
        [&](const simd::VertexAndEdge& found) { return !is_rival(found); });
}

}  // namespace nearfield::narrowphase
