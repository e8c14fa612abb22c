#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/vector.hpp>
#include <engine/geometry/vertex_kernels.hpp>
#include <nearfield/portable_math.hpp>
#include <nearfield/shape.hpp>

#include <cstdint>
#include <span>

namespace nearfield::geometry {

/// A polygon at a pose: computes vertices in world coordinates on demand. Cheap to copy; the
/// polygon must outlive it.
class TransformedPolygon {
public:
    TransformedPolygon(const Polygon& polygon, const Pose& pose);
    /// The same, with the sine and cosine of the pose's angle.
    TransformedPolygon(const Polygon& polygon, const Pose& pose, const SineCosine& turn);

    [[nodiscard]] const Polygon& polygon() const { return *polygon_; }

    [[nodiscard]] const Eigen::Matrix2d& rotation() const { return rotation_; }
    /// The polygon's centre in world coordinates.
    [[nodiscard]] const Vector& translation() const { return translation_; }

    /// Vertex i in world coordinates.
    [[nodiscard]] Vector vertex(std::uint32_t i) const { return to_world(polygon_->vertices()[i]); }
    /// Transforms coordinates relative to the polygon's centre to world coordinates.
    [[nodiscard]] Vector to_world(const Vector& v) const {
        return rotation_.col(0) * v.x() + rotation_.col(1) * v.y() + translation_;
    }
    /// The same transform for the kernels.
    [[nodiscard]] Placement placement() const {
        return {{rotation_(0, 0), rotation_(1, 0)},
                {rotation_(0, 1), rotation_(1, 1)},
                {translation_.x(), translation_.y()}};
    }
    /// Transforms world coordinates to coordinates relative to the polygon's centre.
    [[nodiscard]] Vector to_local(const Vector& v) const {
        return rotation_.transpose() * (v - translation_);
    }

    /// Returns the bounding box of `count` edges of `ring` from `first` on: vertices first, first +
    /// 1, ..., first + count (count + 1 of them; the ring's first follows its last).
    [[nodiscard]] Box chain_box(std::uint32_t ring, std::uint32_t first, std::uint32_t count) const;
    /// The bounding box of the whole polygon.
    [[nodiscard]] Box box() const;

private:
    [[nodiscard]] Box box_of(std::span<const Vector> vertices) const;

    const Polygon* polygon_;
    Eigen::Matrix2d rotation_;
    Vector translation_;
};

/// True if the point is inside by the even-odd rule. The result is unspecified for points on the
/// boundary. Linear in the number of vertices.
[[nodiscard]] bool contains(const TransformedPolygon& placed, const Vector& point);

}  // namespace nearfield::geometry
