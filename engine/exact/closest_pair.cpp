#include <engine/exact/closest_pair.hpp>
#include <engine/geometry/segment.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace nearfield::exact {
namespace {

using geometry::NearestOnSegment;
using geometry::Vector;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of walls that run in parallel very many pairs are as close up to a margin. More than so many are
/// not kept.
constexpr std::size_t most_kept = 4096;

/// The square of a length that is longer by so much.
double square_longer(double squared, double by) {
    const double longer = std::sqrt(squared) + by;
    return longer * longer;
}

}  // namespace

double ClosestPairFinder::squared_bound() const {
    // From a vertex near the other's box to the other and back, which soon comes close.
    const PlacedEdges* from = a_;
    const PlacedEdges* to = b_;
    std::uint32_t vertex = kernels::find_point_nearest_to(a_->starts(), extent_of(b_->box));
    double least = infinity;
    for (int turn = 0; turn < 4; ++turn) {
        const NearEdge nearest = kernels::find_nearer(to->tree(), from->start_x[vertex],
                                                      from->start_y[vertex], {0, infinity});
        if (nearest.squared >= least) {
            break;
        }
        least = nearest.squared;
        vertex = nearest.edge;
        std::swap(from, to);
    }
    return least;
}

ClosestPair ClosestPairFinder::find(const PlacedEdges& a, const PlacedEdges& b, double at_most,
                                    double margin) {
    a_ = &a;
    b_ = &b;
    // More than what the kernels, or placing the vertices, may have rounded.
    const double rounding = a.rounding + b.rounding;
    double least = std::min(at_most * at_most, squared_bound());
    least = keep_near(least, 2.0 * rounding + margin, most_kept);
    keeps_all_ = near_.size() <= most_kept;
    if (!keeps_all_) {
        margin = 0.0;
        least = keep_near(least, 2.0 * rounding, std::numeric_limits<std::size_t>::max());
    }
    const double loose = square_longer(least, 2.0 * rounding + margin);
    std::erase_if(near_, [loose](const VertexAndEdge& found) { return found.squared > loose; });
    // In what order they came depends on how many the machine looks at together.
    std::sort(near_.begin(), near_.end(), [](const VertexAndEdge& i, const VertexAndEdge& j) {
        return std::tie(i.vertex_of_first, i.vertex, i.edge) <
               std::tie(j.vertex_of_first, j.vertex, j.edge);
    });
    // Of all that may be the closest, which the kernels cannot tell apart, the closest.
    const double close = square_longer(least, rounding);
    ClosestPair best;
    for (const VertexAndEdge& found : near_) {
        if (found.squared <= close) {
            const ClosestPair pair = pair_of(found);
            if (pair.squared_distance < best.squared_distance) {
                best = pair;
            }
        }
    }
    return best;
}

double ClosestPairFinder::keep_near(double most, double margin, std::size_t most_pairs) {
    struct Kept {
        std::vector<VertexAndEdge>& near;
        std::size_t most;
    } kept{near_, most_pairs};
    const auto keep = [](void* user, const VertexAndEdge& found) {
        Kept& to = *static_cast<Kept*>(user);
        to.near.push_back(found);
        return to.near.size() <= to.most;
    };
    near_.clear();
    return kernels::for_closest(a_->tree(), b_->tree(), most, margin, {keep, &kept});
}

ClosestPair ClosestPairFinder::pair_of(const VertexAndEdge& found) const {
    const PlacedEdges& vertices = found.vertex_of_first ? *a_ : *b_;
    const PlacedEdges& edges = found.vertex_of_first ? *b_ : *a_;
    const Vector vertex = vertices.start(found.vertex);
    const NearestOnSegment nearest =
        geometry::nearest_on_segment(vertex, edges.start(found.edge), edges.end(found.edge));
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
    // Where more than one pair is closest, a vertex is in another: the distance of two straight
    // edges is least at an end of one of them, and where not only there they run in parallel.
    auto is_rival = [&](const VertexAndEdge& found) {
        const ClosestPair other = pair_of(found);
        const bool elsewhere = (other.point_a - closest.point_a).squaredNorm() > squared_apart ||
                               (side == Side::either &&
                                (other.point_b - closest.point_b).squaredNorm() > squared_apart);
        return other.squared_distance <= limit && elsewhere;
    };
    if (keeps_all_) {
        return std::none_of(near_.begin(), near_.end(), is_rival);
    }
    const auto go_on = [](void* user, const VertexAndEdge& found) {
        return !(*static_cast<decltype(is_rival)*>(user))(found);
    };
    return !kernels::for_within(a_->tree(), b_->tree(),
                                square_longer(limit, 2.0 * (a_->rounding + b_->rounding)),
                                {go_on, &is_rival});
}

}  // namespace nearfield::exact
