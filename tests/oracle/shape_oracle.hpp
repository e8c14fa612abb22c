#pragma once

#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <tests/oracle/edge_tree.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::oracle {

/// The nearest point of a boundary (or of a part of it).
struct Nearest {
    Vector2 point;
    double distance = 0.0;
    Feature feature;
};

/// A shape at a pose that answers queries about single points by testing every edge that can
/// matter. All points are in world coordinates.
///
/// Vertices are transformed in extended precision and stored relative to the centre of the shape,
/// so the answers are accurate to about 1e-16 of the shape's own size anywhere in the world.
class ShapeOracle {
public:
    explicit ShapeOracle(std::span<const Ring> rings, const Pose& pose = {});

    /// Odd-even rule. Exact up to the transformation of the vertices; on the boundary either
    /// answer.
    [[nodiscard]] bool contains(const Vector2& point) const;

    /// The nearest point of the boundary.
    [[nodiscard]] Nearest nearest(const Vector2& point) const;

    /// Distance to the boundary, negative inside.
    [[nodiscard]] double signed_distance(const Vector2& point) const;
    /// The depth of a point inside, negative outside.
    [[nodiscard]] double depth(const Vector2& point) const { return -signed_distance(point); }

    /// The point of edge `edge` nearest to `point`.
    [[nodiscard]] Nearest nearest_on_edge(std::uint32_t edge, const Vector2& point) const;

    /// For each edge that comes within `radius` of `point`, the edge's nearest point.
    [[nodiscard]] std::vector<Nearest> edges_within(const Vector2& point, double radius) const;

    /// The boundary points within `radius` from which the distance to `point` grows in both
    /// directions along the boundary.
    [[nodiscard]] std::vector<Nearest> local_minima_within(const Vector2& point,
                                                           double radius) const;

    /// Number of vertices, and of edges: edge i goes from vertex i to vertex next(i). A last vertex
    /// equal to its ring's first is not counted.
    [[nodiscard]] std::uint32_t size() const {
        return static_cast<std::uint32_t>(vertices_.size());
    }
    [[nodiscard]] Vector2 vertex(std::uint32_t i) const;
    [[nodiscard]] std::uint32_t next(std::uint32_t i) const { return next_[i]; }
    /// First vertex of each ring.
    [[nodiscard]] std::span<const std::uint32_t> ring_begins() const { return ring_begins_; }

    /// The box around the shape.
    [[nodiscard]] Rectangle box() const;
    /// Length of the boundary.
    [[nodiscard]] double perimeter() const;
    /// The maximum deviation of a double-precision computation of a point of this shape from its
    /// exact position.
    [[nodiscard]] double rounding() const { return rounding_; }

    /// The origin of local coordinates; world = local + origin.
    [[nodiscard]] const Vector2& origin() const { return origin_; }
    [[nodiscard]] std::span<const Vector2> local_vertices() const { return vertices_; }
    [[nodiscard]] const EdgeTree& local_edges() const { return tree_; }

private:
    [[nodiscard]] Nearest nearest_local(std::uint32_t edge, const Vector2& local) const;
    [[nodiscard]] bool has_length(std::uint32_t edge) const;

    Vector2 origin_;
    double rounding_ = 0.0;
    std::vector<Vector2> vertices_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_;
    std::vector<std::uint32_t> ring_begins_;
    EdgeTree tree_;
};

}  // namespace nearfield::oracle
