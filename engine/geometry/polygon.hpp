#pragma once

#include <engine/geometry/edge_boxes.hpp>
#include <engine/geometry/vector.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::geometry {

/// The rings of a shape in one array of vertices. Coordinates are relative to the centre of the
/// shape's bounding box, in double precision, so that rotating a shape that lies far from its own
/// origin loses no precision.
///
/// Edge i goes from vertex i to vertex next(i). Vertex and edge indices run through all rings.
class Polygon {
public:
    /// Replaces all rings, or rejects them and leaves the polygon unchanged. The message names the
    /// ring and the vertex within it, both counted from 0. `deviation`: the largest distance of the
    /// rings from the shape they approximate. Reuses memory.
    Status assign(std::span<const Ring> rings, double deviation = 0.0);

    /// How often its rings have been replaced; whether what was made from them is still valid.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }

    /// The largest distance of the rings from the shape they approximate.
    [[nodiscard]] double deviation() const { return deviation_; }

    /// The centre of the bounding box, in the shape's own coordinates.
    [[nodiscard]] const Vector& centre() const { return centre_; }
    /// The sum of |dx| + |dy| over all edges: an upper bound on the boundary's length.
    [[nodiscard]] double length_along_axes() const { return length_along_axes_; }
    /// The largest distance of any vertex from centre(), up to rounding.
    [[nodiscard]] double radius() const { return radius_; }
    /// Vertices relative to centre().
    [[nodiscard]] std::span<const Vector> vertices() const { return vertices_; }
    [[nodiscard]] std::uint32_t size() const {
        return static_cast<std::uint32_t>(vertices_.size());
    }

    [[nodiscard]] std::uint32_t ring_count() const {
        return static_cast<std::uint32_t>(ring_ends_.size());
    }
    [[nodiscard]] std::uint32_t ring_begin(std::uint32_t ring) const {
        return ring == 0 ? 0 : ring_ends_[ring - 1];
    }
    [[nodiscard]] std::uint32_t ring_end(std::uint32_t ring) const { return ring_ends_[ring]; }

    /// Boxes over the edges where a search gains by them: KeptEdgeBoxes::find().
    [[nodiscard]] const EdgeBoxes* find_boxes(BoxSearch search) const {
        return boxes_.find(*this, search);
    }

    /// The ring of vertex (or edge) i.
    [[nodiscard]] std::uint32_t ring_of(std::uint32_t i) const;
    /// The vertex after vertex i on its ring.
    [[nodiscard]] std::uint32_t next(std::uint32_t i) const;
    /// The vertex before vertex i on its ring.
    [[nodiscard]] std::uint32_t previous(std::uint32_t i) const;

private:
    std::uint64_t revision_ = 0;
    Vector centre_ = Vector::Zero();
    double deviation_ = 0.0;
    double length_along_axes_ = 0.0;
    double radius_ = 0.0;
    std::vector<Vector> vertices_;
    std::vector<std::uint32_t> ring_ends_;
    KeptEdgeBoxes boxes_;
};

}  // namespace nearfield::geometry
