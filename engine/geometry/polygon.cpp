#include <engine/geometry/number.hpp>
#include <engine/geometry/polygon.hpp>
#include <engine/geometry/ring_check.hpp>
#include <engine/geometry/vertex_kernels.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace nearfield::geometry {
namespace {

Status invalid(const std::string& message) {
    return {StatusCode::invalid_shape, message};
}

std::string ring_name(std::size_t ring) {
    return "ring " + std::to_string(ring);
}

/// The bounding box and size of a ring.
struct Range {
    Box box;
    bool finite;
    double length;

    explicit Range(const kernels::VertexRange& range)
        : box(box_of(range.box)), finite(range.finite), length(range.length) {}

    [[nodiscard]] bool usable() const { return finite && magnitude() <= largest_coordinate; }
    /// The largest absolute coordinate.
    [[nodiscard]] double magnitude() const {
        return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
    }
    /// The largest difference between any coordinate and that of a vertex.
    [[nodiscard]] double reach_from(const Vector& vertex) const {
        return (box.max() - vertex).cwiseMax(vertex - box.min()).maxCoeff();
    }
};

/// Returns an error that names the first unusable vertex of a ring. Precondition: there is one.
Status bad_coordinates(std::size_t ring, std::span<const Vector2> vertices) {
    const auto bad = std::find_if_not(vertices.begin(), vertices.end(), usable);
    return invalid(vertex_error(ring, static_cast<std::size_t>(bad - vertices.begin()), *bad));
}

/// True if three of the vertices alone show that the ring is not within `rounding`, as a fraction
/// of its extent, of one line: if it were, this cross product would be at most 6 * rounding.
bool clearly_spans_area(std::span<const Vector2> vertices, double extent, double rounding) {
    const Vector origin = to_vector(vertices.front());
    const Vector one = (to_vector(vertices[vertices.size() / 3]) - origin) / extent;
    const Vector other = (to_vector(vertices[2 * vertices.size() / 3]) - origin) / extent;
    return std::abs(cross(one, other)) > 8.0 * rounding;
}

/// True if no vertex is farther from one line than the rounding of its coordinates explains. The
/// line goes through the first vertex and the one farthest from it, so these are at least half the
/// ring's extent apart and their own rounding does not swing it by more. Area would not do as a
/// test: a bow tie has none. Precondition: at least two different vertices.
bool on_one_line(std::span<const Vector2> vertices, const Range& range) {
    const Vector2 origin = vertices.front();
    const auto from_origin = [origin](const Vector2& v) {
        return Vector2{v.x - origin.x, v.y - origin.y};
    };
    const double extent = range.reach_from(to_vector(origin));
    const double magnitude = range.magnitude();
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * (magnitude / extent);
    if (clearly_spans_area(vertices, extent, rounding)) {
        return false;
    }
    const auto farthest = std::find_if(vertices.begin(), vertices.end(), [&](const Vector2& v) {
        return largest_of(from_origin(v)) == extent;
    });
    Vector2 along = from_origin(*farthest);
    // Dividing by the extent first keeps the products of a tiny ring from underflowing.
    along = {along.x / extent, along.y / extent};
    return std::none_of(vertices.begin(), vertices.end(), [&](const Vector2& v) {
        const Vector2 d = from_origin(v);
        return std::abs(along.x * (d.y / extent) - along.y * (d.x / extent)) > rounding;
    });
}

/// Validates the rings, grows the box to contain them, and sums their lengths.
Status check(std::span<const Ring> rings, Box& box, double& length) {
    if (rings.empty()) {
        return invalid("the shape has no ring");
    }
    std::size_t total = 0;
    for (const Ring& ring : rings) {
        total += open_ring(ring).size();
    }
    if (total > max_vertices) {
        return invalid("the shape has " + std::to_string(total) + " vertices; the most are " +
                       std::to_string(max_vertices));
    }
    for (std::size_t r = 0; r < rings.size(); ++r) {
        const std::span<const Vector2> vertices = open_ring(rings[r]);
        if (vertices.empty()) {
            return invalid(ring_name(r) + " has fewer than three different vertices");
        }
        const Range range(kernels::find_range(vertices));
        if (!range.usable()) {
            return bad_coordinates(r, vertices);
        }
        box.extend(range.box);
        length += range.length;
        if (!has_three_different(vertices)) {
            return invalid(ring_name(r) + " has fewer than three different vertices");
        }
        if (on_one_line(vertices, range)) {
            return invalid(ring_name(r) + " lies on one line");
        }
    }
    if (const double extent = box.sizes().maxCoeff(); extent < smallest_extent) {
        return invalid("the shape spans " + number(extent) +
                       " along its longer side; the least is " + number(smallest_extent) +
                       ", since results that are smaller would underflow: use other units");
    }
    return {};
}

}  // namespace

Status Polygon::assign(std::span<const Ring> rings, double deviation) {
    Box box;
    double length = 0.0;
    if (Status status = check(rings, box, length); !status.ok()) {
        return status;
    }
    if (!(deviation >= 0.0 && deviation <= largest_coordinate)) {
        return invalid("the deviation is " + number(deviation) +
                       "; it must be a finite number of at least 0 and at most " +
                       number(largest_coordinate));
    }
    std::size_t total = 0;
    for (const Ring& ring : rings) {
        total += open_ring(ring).size();
    }
    // Allocate first: if memory runs out, the polygon is unchanged.
    vertices_.reserve(total);
    ring_ends_.reserve(rings.size());

    ++revision_;
    boxes_.forget();
    centre_ = 0.5 * (box.min() + box.max());
    deviation_ = deviation;
    length_along_axes_ = length;
    radius_ = 0.5 * box.diagonal().norm();
    vertices_.resize(total);
    ring_ends_.clear();
    std::size_t first = 0;
    for (const Ring& ring : rings) {
        const std::span<const Vector2> open = open_ring(ring);
        kernels::subtract(open, centre_, vertices_.data() + first);
        first += open.size();
        ring_ends_.push_back(static_cast<std::uint32_t>(first));
    }
    return {};
}

std::uint32_t Polygon::ring_of(std::uint32_t i) const {
    return static_cast<std::uint32_t>(std::upper_bound(ring_ends_.begin(), ring_ends_.end(), i) -
                                      ring_ends_.begin());
}

std::uint32_t Polygon::next(std::uint32_t i) const {
    const std::uint32_t ring = ring_of(i);
    return i + 1 == ring_end(ring) ? ring_begin(ring) : i + 1;
}

std::uint32_t Polygon::previous(std::uint32_t i) const {
    const std::uint32_t ring = ring_of(i);
    return i == ring_begin(ring) ? ring_end(ring) - 1 : i - 1;
}

}  // namespace nearfield::geometry
