#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/oracle/shape_oracle.hpp>
#include <tests/query/pair.hpp>

namespace nearfield::test {

/// Two shapes and where they move to.
struct MovingPair {
    Pair pair;
    Pose end_a;
    Pose end_b;
    double contact_distance = 0.0;
};

/// Where a shape is between its two poses.
Pose pose_at_time(const Pose& start, const Pose& end, double time);

MovingPair swapped(const MovingPair& moving);
MovingPair reversed(const MovingPair& moving);
/// The same motion seen from elsewhere.
MovingPair moved_together(const MovingPair& moving, const Pose& by);
/// Shapes of any family, apart by more or less, that cross each other's ways and turn.
MovingPair any_moving_pair(Random& random);
/// B stands still at the origin.
MovingPair falling(const Rings& a, const Rings& b, const Pose& start, const Pose& end,
                   double tolerance);

/// To come that close is to touch.
MovingPair keeping(MovingPair moving, double contact_distance);

/// What the oracle says of a time, by looking at the shapes then and at nothing else.
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

/// How far, at the most, a vertex of A and one of B move against each other between two times.
double relative_motion(const Moment& from, const Moment& to);

}  // namespace nearfield::test
