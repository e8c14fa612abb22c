#include <tools/io/arc_chain.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace nearfield::tools {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// The ends of open chains: end 2 i is the first point of chain i, end 2 i + 1 its last one.
class ChainEnds {
public:
    ChainEnds(const std::vector<ArcChain>& chains, double gap)
        : chains_(chains), gap_(gap), partners_(2 * chains.size(), none) {
        double magnitude = 0.0;
        for (std::size_t end = 0; end < partners_.size(); ++end) {
            magnitude = std::max({magnitude, std::abs(at(end).x), std::abs(at(end).y)});
        }
        side_ = std::max(gap, 0x1p-50 * magnitude);
    }

    /// Joins each end with the nearest one that is left.
    void join() {
        for (std::size_t end = 0; end < partners_.size(); ++end) {
            if (!chains_[end / 2].closed) {
                ends_in_[cell_of(at(end))].push_back(end);
            }
        }
        for (std::size_t end = 0; end < partners_.size(); ++end) {
            if (!chains_[end / 2].closed && partners_[end] == none) {
                take(end);
                join_with_nearest(end);
            }
        }
    }

    [[nodiscard]] Vector2 at(std::size_t end) const {
        const std::vector<ArcChain::Point>& points = chains_[end / 2].points;
        return end % 2 == 0 ? points.front().at : points.back().at;
    }
    [[nodiscard]] std::size_t partner(std::size_t end) const { return partners_[end]; }

private:
    using Cell = std::pair<std::int64_t, std::int64_t>;

    /// A square whose side is the gap, or more if its number would be too large.
    [[nodiscard]] Cell cell_of(const Vector2& point) const {
        if (side_ == 0.0) {
            return {};
        }
        return {static_cast<std::int64_t>(std::floor(point.x / side_)),
                static_cast<std::int64_t>(std::floor(point.y / side_))};
    }

    /// Removes an end from those that are left.
    void take(std::size_t end) { std::erase(ends_in_[cell_of(at(end))], end); }

    void join_with_nearest(std::size_t end) {
        const Vector2 here = at(end);
        const Cell cell = cell_of(here);
        std::size_t nearest = none;
        double least = gap_;
        for (std::int64_t i = 0; i < 9; ++i) {
            const auto found = ends_in_.find({cell.first + i / 3 - 1, cell.second + i % 3 - 1});
            if (found == ends_in_.end()) {
                continue;
            }
            for (const std::size_t other : found->second) {
                const Vector2 there = at(other);
                const double apart =
                    std::max(std::abs(there.x - here.x), std::abs(there.y - here.y));
                if (nearest == none ? apart <= least : apart < least) {
                    nearest = other;
                    least = apart;
                }
            }
        }
        if (nearest != none) {
            take(nearest);
            partners_[end] = nearest;
            partners_[nearest] = end;
        }
    }

    const std::vector<ArcChain>& chains_;
    double gap_;
    double side_ = 0.0;  ///< of a cell
    std::vector<std::size_t> partners_;
    std::map<Cell, std::vector<std::size_t>> ends_in_;  ///< those that are left
};

/// Gives a point the segment of another one, the other way round.
void reverse_segment(const ArcChain::Point& segment, ArcChain::Point& to) {
    to.bulge = -segment.bulge;
    if (segment.controls) {
        to.controls = {(*segment.controls)[1], (*segment.controls)[0]};
    }
    if (segment.ellipse) {
        to.ellipse = segment.ellipse;
        to.ellipse->counter_clockwise = !segment.ellipse->counter_clockwise;
    }
}

/// Appends an open chain to another one, from its first point on or from its last one.
void append_points(const ArcChain& chain, bool is_reversed, ArcChain& to) {
    const std::size_t count = chain.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_reversed) {
            to.points.push_back(chain.points[i]);
        } else {
            const std::size_t from = count - 1 - i;
            to.points.push_back({chain.points[from].at});
            if (from > 0) {
                reverse_segment(chain.points[from - 1], to.points.back());
            }
        }
    }
    to.points.back().bulge = 0.0;  // a straight line over the gap
}

void append_arc(const ArcChain::Point& from, const Vector2& to, CurvePath& path) {
    const Vector2 way{to.x - from.at.x, to.y - from.at.y};
    const double bulge = std::abs(from.bulge);
    constexpr double nearly_straight = 1e-8;
    if (bulge < nearly_straight) {
        // The parabola has the tangents of the arc, and differs from it by less than rounding.
        path.quadratic_to({from.at.x + 0.5 * way.x + from.bulge * way.y,
                           from.at.y + 0.5 * way.y - from.bulge * way.x},
                          to);
        return;
    }
    const double radius = 0.25 * std::hypot(way.x, way.y) * (1.0 / bulge + bulge);
    path.arc_to({.radius_x = radius,
                 .radius_y = radius,
                 .large = bulge > 1.0,
                 .counter_clockwise = from.bulge > 0.0},
                to);
}

void append_segment(const ArcChain::Point& from, const Vector2& to, CurvePath& path) {
    if (from.controls) {
        path.cubic_to((*from.controls)[0], (*from.controls)[1], to);
    } else if (from.at == to) {
        return;
    } else if (from.ellipse) {
        path.arc_to(*from.ellipse, to);
    } else if (from.bulge == 0.0) {
        path.line_to(to);
    } else {
        append_arc(from, to, path);
    }
}

}  // namespace

std::optional<LooseEnd> close_chains(std::vector<ArcChain>& chains, double gap) {
    ChainEnds ends(chains, gap);
    ends.join();
    for (std::size_t end = 0; end < 2 * chains.size(); ++end) {
        if (!chains[end / 2].closed && ends.partner(end) == none) {
            return LooseEnd{ends.at(end), chains[end / 2].offset};
        }
    }
    std::vector<ArcChain> closed;
    std::vector<bool> is_used(chains.size());
    for (std::size_t first = 0; first < chains.size(); ++first) {
        if (chains[first].closed) {
            closed.push_back(std::move(chains[first]));
            continue;
        }
        if (is_used[first]) {
            continue;
        }
        ArcChain loop{.points = {}, .closed = true, .offset = chains[first].offset};
        std::size_t entered = 2 * first;
        do {
            is_used[entered / 2] = true;
            append_points(chains[entered / 2], entered % 2 == 1, loop);
            entered = ends.partner(entered ^ 1U);
        } while (entered != 2 * first);
        closed.push_back(std::move(loop));
    }
    chains = std::move(closed);
    return std::nullopt;
}

double extent_of(const std::vector<ArcChain>& chains) {
    Vector2 low{largest_coordinate, largest_coordinate};
    Vector2 high{-largest_coordinate, -largest_coordinate};
    for (const ArcChain& chain : chains) {
        for (const ArcChain::Point& point : chain.points) {
            low = {std::min(low.x, point.at.x), std::min(low.y, point.at.y)};
            high = {std::max(high.x, point.at.x), std::max(high.y, point.at.y)};
        }
    }
    return std::max(high.x - low.x, high.y - low.y);
}

std::size_t remove_repeated(std::vector<ArcChain>& chains) {
    using Segment = std::tuple<double, double, double, double, double>;
    std::set<Segment> seen;
    return std::erase_if(chains, [&](const ArcChain& chain) {
        if (chain.closed || chain.points.size() != 2 || chain.points[0].has_curve()) {
            return false;
        }
        const Vector2& from = chain.points[0].at;
        const double bulge = chain.points[0].bulge;
        const Vector2& to = chain.points[1].at;
        const bool is_forwards = std::pair(from.x, from.y) < std::pair(to.x, to.y);
        return !seen.insert(is_forwards ? Segment(from.x, from.y, to.x, to.y, bulge)
                                        : Segment(to.x, to.y, from.x, from.y, -bulge))
                    .second;
    });
}

void append_chain(const ArcChain& chain, CurvePath& path) {
    path.move_to(chain.points.front().at);
    for (std::size_t i = 0; i < chain.points.size(); ++i) {
        append_segment(chain.points[i], chain.points[(i + 1) % chain.points.size()].at, path);
    }
    path.close();
}

}  // namespace nearfield::tools
