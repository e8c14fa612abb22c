#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/oracle/shape_oracle.hpp>
#include <tests/support/polygons.hpp>

#include <string>

namespace nearfield::test {

/// Two shapes at their places and the tolerance to ask with.
struct Pair {
    NamedRings a;
    NamedRings b;
    Pose pose_a;
    Pose pose_b;
    double tolerance = 0.0;
};

/// What the oracle says about whether two shapes intersect.
enum class Truth { no, yes, too_close_to_call };

/// A pair known to a context for as long as this lives, and the oracle's view of it.
class PlacedPair {
public:
    /// The queries ask for the technique.
    PlacedPair(Context& context, Pair pair, Technique technique = Technique::raster);
    ~PlacedPair();
    PlacedPair(const PlacedPair&) = delete;
    PlacedPair& operator=(const PlacedPair&) = delete;

    [[nodiscard]] Instance instance_a() const { return {handle_a_, pair_.pose_a}; }
    [[nodiscard]] Instance instance_b() const { return {handle_b_, pair_.pose_b}; }
    [[nodiscard]] double tolerance() const { return pair_.tolerance; }
    [[nodiscard]] const oracle::ShapeOracle& a() const { return oracle_a_; }
    [[nodiscard]] const oracle::ShapeOracle& b() const { return oracle_b_; }
    [[nodiscard]] const Pair& pair() const { return pair_; }
    /// How far rounding in double precision may move a point of either.
    [[nodiscard]] double rounding() const { return oracle_a_.rounding() + oracle_b_.rounding(); }
    /// Whether the shapes intersect, where rounding cannot decide it.
    [[nodiscard]] Truth intersects() const;

    [[nodiscard]] PenetrationQuery penetration(
        PenetrationPoints points = PenetrationPoints::boundary) const;
    [[nodiscard]] IntersectionQuery intersection(IntersectionKind kind) const;
    [[nodiscard]] ContactQuery contacts(double contact_distance) const;
    [[nodiscard]] SeparationQuery separation() const;
    [[nodiscard]] ClosestPointQuery closest_point() const;

private:
    Context* context_;
    Technique technique_;
    Pair pair_;
    oracle::ShapeOracle oracle_a_;
    oracle::ShapeOracle oracle_b_;
    ShapeHandle handle_a_;
    ShapeHandle handle_b_;
};

/// Shapes of random families and sizes that overlap more often than not; some far from the origin
/// of the world, some far from the origin of their own coordinates.
Pair any_pair(Random& random);

/// Every family against another one, at sizes about 10, with a tolerance of 0.15.
std::vector<Pair> family_pairs(std::uint64_t seed);

/// The pose that brings the point `own` of a shape's own coordinates to `world`, turned by `angle`.
Pose pose_at(const Vector2& own, const Vector2& world, double angle);

/// Everything needed to make the pair again.
std::string describe(const Pair& pair);

}  // namespace nearfield::test
