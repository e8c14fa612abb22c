#include <engine/geometry/simplify.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace nearfield::geometry {
namespace {

/// Edges of a run at most: what reads a run one edge after the other takes a bounded time. Some
/// drivers end the loops of a shader after 65,535 turns, without notice.
constexpr std::uint32_t max_run = 256;

// Why it suffices to measure the vertices. Let S be the straight segment from the first to the last
// vertex of a run, and every vertex of the run within e of S.
// - The distance to a convex set is a convex function, so along each edge of the run it is at most
//   its value at one of the edge's ends: no point of the run is farther than e from S.
// - The run is a connected line from one end of S to the other. Its projection onto the line
//   through S is continuous and starts and ends at the ends of S, so it takes every value between:
//   over each point s of S there is a point r of the run that projects onto s, and |rs| is the
//   distance of r to the line, at most its distance to S, at most e. This holds however the run
//   folds back.

/// The vertices of one ring from vertex `position` on; position `size` is the first vertex again.
struct RingView {
    std::span<const Vector> vertices;

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(vertices.size()); }
    [[nodiscard]] const Vector& at(std::uint32_t position) const {
        return vertices[position == size() ? 0 : position];
    }
};

/// The directions in which a ray from the anchor passes within `reach` of every vertex seen so far.
class Sector {
public:
    /// True if the ray towards v (relative to the anchor) lies in the sector.
    [[nodiscard]] bool holds(const Vector& v) const {
        return open_ || (cross(low_, v) >= 0.0 && cross(v, high_) >= 0.0 && faces(v));
    }

    /// Narrows the sector by a vertex farther than `reach`. Returns false if nothing is left.
    bool narrow(const Vector& v, double squared_distance, double reach) {
        if (reach < 0.0 || (!open_ && !faces(v))) {
            return false;
        }
        // The unit vectors at angles +- asin(reach / distance) from v.
        const double scale = 1.0 / squared_distance;
        const Vector ahead = v * (scale * std::sqrt(squared_distance - reach * reach));
        const Vector across = Vector(-v.y(), v.x()) * (scale * reach);
        const Vector low = ahead - across;
        const Vector high = ahead + across;
        // v is less than a right angle from the bisector and no sector is wider than two, so the
        // borders compared here are less than half a turn apart and the cross product orders them.
        const bool raise_low = open_ || cross(low_, low) > 0.0;
        const bool lower_high = open_ || cross(high_, high) < 0.0;
        low_ = raise_low ? low : low_;
        high_ = lower_high ? high : high_;
        open_ = false;
        return cross(low_, high_) >= 0.0;
    }

private:
    [[nodiscard]] bool faces(const Vector& v) const { return v.dot(low_ + high_) > 0.0; }

    bool open_ = true;  // every direction is left
    Vector low_ = Vector::Zero();
    Vector high_ = Vector::Zero();
};

/// The largest distance of any vertex of the run of `count` edges from `start` to its straight
/// segment.
double run_deviation(const RingView& ring, std::uint32_t start, std::uint32_t count) {
    const Vector a = ring.at(start);
    const Vector b = ring.at(start + count);
    const Vector along = b - a;
    const double squared_length = along.squaredNorm();
    double beyond_ends = 0.0;  // squared distance
    double beside = 0.0;       // distance times length
    for (const Vector& v : ring.vertices.subspan(start + 1, count - 1)) {
        const Vector from_a = v - a;
        const double along_of_v = along.dot(from_a);
        if (along_of_v <= 0.0) {
            beyond_ends = std::max(beyond_ends, from_a.squaredNorm());
        } else if (along_of_v >= squared_length) {
            beyond_ends = std::max(beyond_ends, (v - b).squaredNorm());
        } else {
            beside = std::max(beside, std::abs(cross(along, from_a)));
        }
    }
    const double distance_beside = beside > 0.0 ? beside / std::sqrt(squared_length) : 0.0;
    return std::max(std::sqrt(beyond_ends), distance_beside);
}

class RingSimplifier {
public:
    /// `magnitude`: an upper bound on all coordinates.
    RingSimplifier(const RingView& ring, double deviation, double longest_run, double magnitude)
        : ring_(ring),
          deviation_(deviation),
          squared_deviation_(deviation * deviation),
          squared_longest_run_(longest_run * longest_run),
          // The sector is slightly narrower than requested, so that rounding does not admit a run
          // that the exact measure would then reject.
          reach_(deviation - 16.0 * std::numeric_limits<double>::epsilon() * magnitude) {}

    /// Returns the number of edges of the run that starts at position `start`, at most `most`.
    [[nodiscard]] std::uint32_t longest_from(std::uint32_t start, std::uint32_t most) const {
        // The least look-ahead for a better end than the last one found. The bound keeps the time
        // linear where there is none.
        constexpr std::uint32_t min_look_ahead = 8;
        const Vector anchor = ring_.at(start);
        Sector sector;
        // All distances are squared and measured from the anchor.
        double farthest = 0.0;  // among the vertices outside the anchor's own neighbourhood
        std::uint32_t best = 1;
        Vector before = anchor;
        for (std::uint32_t count = 1; count <= most; ++count) {
            const Vector vertex = ring_.at(start + count);
            const Vector v = vertex - anchor;
            const double distance = v.squaredNorm();
            if (distance > squared_longest_run_ ||
                (vertex - before).squaredNorm() > squared_longest_run_) {
                break;
            }
            before = vertex;
            // As an end, v must lie in the sector of the vertices before it and be no nearer than
            // any of them: then all of them project onto the segment, not beyond it.
            if (distance >= farthest && sector.holds(v)) {
                best = count;
            } else if (count - best > best + min_look_ahead) {
                break;
            }
            if (distance > squared_deviation_) {  // a nearer one is near any segment from there
                farthest = std::max(farthest, distance);
                if (!sector.narrow(v, distance, reach_)) {
                    break;
                }
            }
        }
        return best;
    }

    /// Shortens the run until its deviation is allowed, and returns that deviation.
    [[nodiscard]] double measure(std::uint32_t start, std::uint32_t& count) const {
        double deviation = run_deviation(ring_, start, count);
        while (deviation > deviation_ && count > 1) {
            count /= 2;
            deviation = run_deviation(ring_, start, count);
        }
        return deviation;
    }

private:
    RingView ring_;
    double deviation_;
    double squared_deviation_;
    double squared_longest_run_;
    double reach_;
};

/// Simplifies the rings of a polygon one after another.
class PolygonSimplifier {
public:
    PolygonSimplifier(const Polygon& polygon, double deviation, double longest_run,
                      std::vector<SimplifiedEdge>& edges)
        : polygon_(polygon), deviation_(deviation), longest_run_(longest_run), edges_(edges) {}

    /// Calls `simplify_ring(ring, size)` for each ring, after making it the current one.
    template <class SimplifyRing>
    void for_rings(const SimplifyRing& simplify_ring) {
        for (std::uint32_t ring = 0; ring < polygon_.ring_count(); ++ring) {
            begin_ = polygon_.ring_begin(ring);
            view_.vertices = polygon_.vertices().subspan(begin_, polygon_.ring_end(ring) - begin_);
            simplify_ring(ring, view_.size());
        }
    }

    /// Appends the runs of edges first, ..., end - 1 of the current ring.
    void append_runs(std::uint32_t first, std::uint32_t end) const {
        const RingSimplifier simplifier(view_, deviation_, longest_run_, polygon_.radius());
        for (std::uint32_t start = first; start < end;) {
            // No run takes all edges: a ring keeps two.
            const std::uint32_t most = std::min({end - start, view_.size() - 1, max_run});
            std::uint32_t count = simplifier.longest_from(start, most);
            const double measured = simplifier.measure(start, count);
            append(start, start + count, measured);
            start += count;
        }
    }

    /// Appends one edge for edges first, ..., end - 1.
    void append(std::uint32_t first, std::uint32_t end, double deviation) const {
        edges_.push_back(
            {begin_ + first, end == view_.size() ? begin_ : begin_ + end, end - first, deviation});
    }

private:
    const Polygon& polygon_;
    double deviation_;
    double longest_run_;
    std::vector<SimplifiedEdge>& edges_;
    RingView view_;  // of the current ring
    std::uint32_t begin_ = 0;
};

}  // namespace

void simplify(const Polygon& polygon, double deviation, double longest_run,
              std::vector<SimplifiedEdge>& edges) {
    PolygonSimplifier simplifier(polygon, deviation, longest_run, edges);
    simplifier.for_rings(
        [&](std::uint32_t, std::uint32_t size) { simplifier.append_runs(0, size); });
}

void simplify_near(const TransformedPolygon& placed, const Box& window, double deviation,
                   double longest_run, std::vector<SimplifiedEdge>& edges) {
    const Polygon& polygon = placed.polygon();
    PolygonSimplifier simplifier(polygon, deviation, longest_run, edges);
    simplifier.for_rings([&](std::uint32_t ring, std::uint32_t size) {
        for (std::uint32_t first = 0; first < size; first += edges_of_a_block) {
            const std::uint32_t end = std::min(first + edges_of_a_block, size);
            const std::uint32_t edge = polygon.ring_begin(ring) + first;
            if (window.intersects(placed.chain_box(ring, edge, end - first))) {
                simplifier.append_runs(first, end);
            } else {
                simplifier.append(first, end, std::numeric_limits<double>::infinity());
            }
        }
    });
}

}  // namespace nearfield::geometry
