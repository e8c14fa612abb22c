#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/oracle/shape_oracle.hpp>
#include <tests/support/polygons.hpp>
#include <tests/support/techniques.hpp>

#include <optional>
#include <string>

namespace nearfield::test {

/// Two shapes with poses and the tolerance for queries.
struct Pair {
    NamedRings a;
    NamedRings b;
    Pose pose_a;
    Pose pose_b;
    double tolerance = 0.0;
};

/// The oracle's answer to whether two shapes intersect.
enum class Truth { no, yes, too_close_to_call };

/// A pair in a context for the lifetime of this object, and its oracles.
class PlacedPair {
public:
    /// The queries request this technique.
    PlacedPair(Context& context, Pair pair, Technique technique = device_techniques.front());
    ~PlacedPair();
    PlacedPair(const PlacedPair&) = delete;
    PlacedPair& operator=(const PlacedPair&) = delete;

    [[nodiscard]] Instance instance_a() const { return {handle_a_, pair_.pose_a}; }
    [[nodiscard]] Instance instance_b() const { return {handle_b_, pair_.pose_b}; }
    [[nodiscard]] double tolerance() const { return pair_.tolerance; }
    [[nodiscard]] const oracle::ShapeOracle& a() const { return oracle_a_; }
    [[nodiscard]] const oracle::ShapeOracle& b() const { return oracle_b_; }
    [[nodiscard]] const Pair& pair() const { return pair_; }
    /// The maximum displacement of a point of either shape by rounding in double precision.
    [[nodiscard]] double rounding() const { return oracle_a_.rounding() + oracle_b_.rounding(); }
    /// Whether the shapes intersect, if rounding cannot affect it; found out once.
    [[nodiscard]] Truth intersects() const;
    /// Of the shapes' intersection; found out once.
    [[nodiscard]] double common_area() const;

    [[nodiscard]] PenetrationQuery penetration(
        PenetrationPoints points = PenetrationPoints::boundary) const;
    [[nodiscard]] IntersectionQuery intersection(IntersectionKind kind) const;
    [[nodiscard]] ContactQuery contacts(double contact_distance) const;
    [[nodiscard]] SeparationQuery separation() const;
    [[nodiscard]] ClosestPointQuery closest_point() const;

private:
    [[nodiscard]] Truth find_whether_they_intersect() const;

    Context* context_;
    Technique technique_;
    Pair pair_;
    oracle::ShapeOracle oracle_a_;
    oracle::ShapeOracle oracle_b_;
    ShapeHandle handle_a_;
    ShapeHandle handle_b_;
    mutable std::optional<Truth> intersects_;
    mutable std::optional<double> common_area_;
};

/// Shapes of random families and sizes that usually overlap; some far from the origin of the world,
/// some far from the origin of their own coordinates.
Pair any_pair(Random& random);

/// Every family against another one, at sizes of about 10, with a tolerance of 0.15.
std::vector<Pair> family_pairs(std::uint64_t seed);

/// The pose that rotates by `angle` and moves the point `own` in shape coordinates to `world`.
Pose pose_at(const Vector2& own, const Vector2& world, double angle);

/// Everything needed to reproduce the pair.
std::string describe(const Pair& pair);

}  // namespace nearfield::test
