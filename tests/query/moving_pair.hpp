#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/oracle/shape_oracle.hpp>
#include <tests/query/pair.hpp>

namespace nearfield::test {

/// Two shapes and their end poses.
struct MovingPair {
    Pair pair;
    Pose end_a;
    Pose end_b;
    double contact_distance = 0.0;
};

/// The pose of a shape between its two poses.
Pose pose_at_time(const Pose& start, const Pose& end, double time);

MovingPair swapped(const MovingPair& moving);
MovingPair reversed(const MovingPair& moving);
/// The same motion with both shapes moved by `by`.
MovingPair moved_together(const MovingPair& moving, const Pose& by);
/// Shapes of any family at various distances that rotate and cross each other's paths.
MovingPair any_moving_pair(Random& random);
/// B is fixed at the origin.
MovingPair falling(const Rings& a, const Rings& b, const Pose& start, const Pose& end,
                   double tolerance);

/// Sets the distance at which the shapes count as touching.
MovingPair keeping(MovingPair moving, double contact_distance);

/// The oracle's view of one time, from the shapes at that time only.
class Moment {
public:
    Moment(const MovingPair& moving, double time);

    [[nodiscard]] const oracle::ShapeOracle& a() const { return a_; }
    [[nodiscard]] const oracle::ShapeOracle& b() const { return b_; }
    [[nodiscard]] bool meets() const;
    [[nodiscard]] double boundary_distance() const;

private:
    oracle::ShapeOracle a_;
    oracle::ShapeOracle b_;
};

/// An upper bound on the relative motion of a vertex of A and one of B between two times.
double relative_motion(const Moment& from, const Moment& to);

}  // namespace nearfield::test
