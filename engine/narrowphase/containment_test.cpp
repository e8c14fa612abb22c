#include <engine/base/interruption.hpp>
#include <engine/narrowphase/containment_test.hpp>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

namespace nearfield::narrowphase {
namespace {

using geometry::Box;
using geometry::Polygon;
using geometry::Vector;
using simd::TransformedEdges;

// Widths in units of both shapes' rounding. What is farther from a boundary than one is on a known
// side of it; the rest of each width is for the rounding of positions along edges.
constexpr double touching_width = 2.0;
constexpr double side_width = 4.0;
/// Between the edges that coincide with an edge up to rounding, and the others.
constexpr double side_offset = 3.0;
/// Too short to border anything that containment_rounding() does not close.
constexpr double short_part = 8.0;

/// A place on a ring: a parameter below 1 along an edge. The end of the last edge is the start of
/// the one after it.
struct RingPlace {
    std::uint32_t edge = 0;
    double parameter = 0.0;

    RingPlace(std::uint32_t of_edge, double at)
        : edge(at < 1.0 ? of_edge : of_edge + 1), parameter(at < 1.0 ? at : 0.0) {}
};

bool operator<(const RingPlace& i, const RingPlace& j) {
    return std::tie(i.edge, i.parameter) < std::tie(j.edge, j.parameter);
}

/// A part of an edge, by its parameters.
struct EdgePart {
    std::uint32_t edge;
    double from;
    double to;
};

/// Narrows `part` to the parameters where a linear function, given at 0 and 1, is in [low, high];
/// false if none is left.
bool clip(double at_start, double at_end, double low, double high,
          std::pair<double, double>& part) {
    const double change = at_end - at_start;
    if (change == 0.0) {
        return at_start >= low && at_start <= high;
    }
    const double one = (low - at_start) / change;
    const double other = (high - at_start) / change;
    part.first = std::max(part.first, std::min(one, other));
    part.second = std::min(part.second, std::max(one, other));
    return part.first <= part.second;
}

/// The part of segment pq inside the rectangle that extends segment cd by `width` on all sides.
std::optional<std::pair<double, double>> part_near(const Vector& p, const Vector& q,
                                                   const Vector& c, const Vector& d, double width) {
    const double length = (d - c).norm();
    const Vector along = length > 0.0 ? Vector((d - c) / length) : Vector(1.0, 0.0);
    std::pair<double, double> part{0.0, 1.0};
    const bool meets =
        clip(along.dot(p - c), along.dot(q - c), -width, length + width, part) &&
        clip(geometry::cross(along, p - c), geometry::cross(along, q - c), -width, width, part);
    return meets ? std::optional(part) : std::nullopt;
}

/// True if a point is in the closed box and inside by the odd-even rule.
bool is_in(const TransformedEdges& edges, const Vector& point) {
    return edges.box.contains(point) && contains(edges, point);
}

/// Calls `use` with the parts of edges between two places of a ring until it returns false; returns
/// whether it never did.
template <class Use>
bool for_each_part(const RingPlace& from, const RingPlace& to, const Use& use) {
    for (std::uint32_t edge = from.edge; edge <= to.edge; ++edge) {
        const EdgePart part{edge, edge == from.edge ? from.parameter : 0.0,
                            edge == to.edge ? to.parameter : 1.0};
        if (part.from < part.to && !use(part)) {
            return false;
        }
    }
    return true;
}

/// A point between two places of a ring, in the middle of a long part of an edge.
Vector point_between(const TransformedEdges& edges, const RingPlace& from, const RingPlace& to) {
    constexpr std::uint32_t enough = 3;  // two whole edges may be cut at one end each
    Vector point = edges.start(from.edge);
    double longest = -1.0;
    std::uint32_t seen = 0;
    for_each_part(from, to, [&](const EdgePart& part) {
        const Vector along = edges.end(part.edge) - edges.start(part.edge);
        const double length = (part.to - part.from) * along.norm();
        if (length > longest) {
            longest = length;
            point = edges.start(part.edge) + 0.5 * (part.from + part.to) * along;
        }
        return ++seen < enough;
    });
    return point;
}

/// Calls `use` with the two ends of each stretch of a ring that has no touching part, until it
/// returns false; returns whether it never did.
template <class Parts, class Use>
bool for_each_free_stretch(std::uint32_t begin, std::uint32_t end, const Parts& touching,
                           const Use& use) {
    RingPlace at(begin, 0.0);
    SparseCheckpoint<64> checkpoint;
    for (const auto& part : touching) {
        checkpoint.step();
        const RingPlace from(part.edge, part.from);
        if (at < from && !use(at, from)) {
            return false;
        }
        at = std::max(at, RingPlace(part.edge, part.to));
    }
    const RingPlace last(end, 0.0);
    return !(at < last) || use(at, last);
}

/// Calls `use` with the first and the end vertex of each ring, and its touching parts, until it
/// returns false; returns whether it never did.
template <class Part, class Use>
bool for_each_ring(const TransformedEdges& edges, const std::vector<Part>& touching,
                   const Use& use) {
    const Polygon& polygon = edges.placed.polygon();
    auto first = touching.begin();
    SparseCheckpoint<64> checkpoint;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        checkpoint.step();
        const std::uint32_t end = polygon.ring_end(ring);
        const auto last = std::find_if(first, touching.end(),
                                       [end](const Part& part) { return part.edge >= end; });
        if (!use(polygon.ring_begin(ring), end, std::span<const Part>(first, last))) {
            return false;
        }
        first = last;
    }
    return true;
}

}  // namespace

void ContainmentTest::find_touching_parts() {
    const double width = touching_width * rounding_;
    on_a_.clear();
    on_b_.clear();
    const auto add = [width](const TransformedEdges& edges, std::uint32_t edge,
                             const TransformedEdges& others, std::uint32_t other,
                             std::vector<TouchingPart>& parts) {
        const auto part = part_near(edges.start(edge), edges.end(edge), others.start(other),
                                    others.end(other), width);
        if (part) {
            parts.push_back({edge, part->first, part->second});
        }
    };
    pairs_.for_each(*a_, *b_, [&](const simd::EdgePair& pair) {
        add(*a_, pair.first, *b_, pair.second, on_a_);
        add(*b_, pair.second, *a_, pair.first, on_b_);
        return true;
    });
    for (std::vector<TouchingPart>* const parts : {&on_a_, &on_b_}) {
        std::sort(parts->begin(), parts->end(), [](const TouchingPart& i, const TouchingPart& j) {
            return std::tie(i.edge, i.from, i.to) < std::tie(j.edge, j.from, j.to);
        });
    }
}

bool ContainmentTest::boundary_is_inside() const {
    const auto is_inside_b = [this](const RingPlace& from, const RingPlace& to) {
        return is_in(*b_, point_between(*a_, from, to));
    };
    return for_each_ring(*a_, on_a_, [&](std::uint32_t begin, std::uint32_t end, auto touching) {
        return for_each_free_stretch(begin, end, touching, is_inside_b);
    });
}

/// True if a point shows that A is not inside B: inside A, outside B and on neither boundary.
bool ContainmentTest::is_proof(const Vector& point) const {
    const auto is_clear_of = [&](const TransformedEdges& edges) {
        return find_nearest(edges, point).squared > rounding_ * rounding_;
    };
    return is_in(*a_, point) && !is_in(*b_, point) && is_clear_of(*a_) && is_clear_of(*b_);
}

/// Writes to cuts_ the parameters of a part of an edge of B between which no other edge of either
/// shape begins or ceases to coincide with it.
void ContainmentTest::cut_where_edges_begin_and_end(std::uint32_t edge, double from, double to) {
    const double width = side_width * rounding_;
    const Vector start = b_->start(edge);
    const Vector end = b_->end(edge);
    Box box(start + from * (end - start));
    box.extend(start + to * (end - start));
    box = geometry::grown(box, 2.0 * width);
    checkpoint();
    cuts_.assign({from, to});
    for (const TransformedEdges* const edges : {a_, b_}) {
        for (const std::uint32_t other : find_edges_in(*edges, box, near_)) {
            if (edges == b_ && other == edge) {
                continue;
            }
            const auto part = part_near(start, end, edges->start(other), edges->end(other), width);
            if (part) {
                cuts_.push_back(std::clamp(part->first, from, to));
                cuts_.push_back(std::clamp(part->second, from, to));
            }
        }
    }
    std::sort(cuts_.begin(), cuts_.end());
}

bool ContainmentTest::borders_outside(std::uint32_t edge, double from, double to) {
    const Vector start = b_->start(edge);
    const Vector along = b_->end(edge) - start;
    const double length = along.norm();
    if ((to - from) * length <= short_part * rounding_) {
        return false;
    }
    cut_where_edges_begin_and_end(edge, from, to);
    const Vector aside = side_offset * rounding_ * Vector(-along.y() / length, along.x() / length);
    for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
        const Vector middle = start + 0.5 * (cuts_[i] + cuts_[i + 1]) * along;
        if (cuts_[i] < cuts_[i + 1] && (is_proof(middle + aside) || is_proof(middle - aside))) {
            return true;
        }
    }
    return false;
}

bool ContainmentTest::ring_borders_outside(std::uint32_t begin, std::uint32_t end,
                                           std::span<const TouchingPart> touching) {
    const bool is_free_outside_a = for_each_free_stretch(
        begin, end, touching, [&](const RingPlace& from, const RingPlace& to) {
            return !is_in(*a_, point_between(*b_, from, to)) ||
                   for_each_part(from, to, [&](const EdgePart& part) {
                       return !borders_outside(part.edge, part.from, part.to);
                   });
        });
    return !is_free_outside_a ||
           std::any_of(touching.begin(), touching.end(), [&](const TouchingPart& part) {
               return borders_outside(part.edge, part.from, part.to);
           });
}

bool ContainmentTest::contains_outside() {
    return !for_each_ring(*b_, on_b_, [&](std::uint32_t begin, std::uint32_t end, auto touching) {
        return !ring_borders_outside(begin, end, touching);
    });
}

bool ContainmentTest::is_inside(const TransformedEdges& a, const TransformedEdges& b) {
    a_ = &a;
    b_ = &b;
    rounding_ = a.rounding + b.rounding;
    if (!geometry::grown(b.box, rounding_).contains(a.box)) {
        return false;
    }
    find_touching_parts();
    // A's boundary does not leave B, so what is outside B lies in A as a whole or not at all.
    return boundary_is_inside() && !contains_outside();
}

}  // namespace nearfield::narrowphase
