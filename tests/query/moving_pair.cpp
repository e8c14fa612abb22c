#include <tests/oracle/overlap.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/moving_pair.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

double part_of_way(double start, double end, double time) {
    return (1.0 - time) * start + time * end;
}

}  // namespace

Pose pose_at_time(const Pose& start, const Pose& end, double time) {
    return {{part_of_way(start.translation.x, end.translation.x, time),
             part_of_way(start.translation.y, end.translation.y, time)},
            part_of_way(start.angle, end.angle, time)};
}

MovingPair swapped(const MovingPair& moving) {
    const Pair& pair = moving.pair;
    return {{pair.b, pair.a, pair.pose_b, pair.pose_a, pair.tolerance},
            moving.end_b,
            moving.end_a,
            moving.contact_distance};
}

MovingPair reversed(const MovingPair& moving) {
    const Pair& pair = moving.pair;
    return {{pair.a, pair.b, moving.end_a, moving.end_b, pair.tolerance},
            pair.pose_a,
            pair.pose_b,
            moving.contact_distance};
}

MovingPair moved_together(const MovingPair& moving, const Pose& by) {
    const auto move = [&](const Pose& pose) {
        const double cosine = std::cos(by.angle);
        const double sine = std::sin(by.angle);
        const auto& [x, y] = pose.translation;
        return Pose{
            {cosine * x - sine * y + by.translation.x, sine * x + cosine * y + by.translation.y},
            pose.angle + by.angle};
    };
    MovingPair result = moving;
    for (Pose* pose : {&result.pair.pose_a, &result.pair.pose_b, &result.end_a, &result.end_b}) {
        *pose = move(*pose);
    }
    return result;
}

MovingPair any_moving_pair(Random& random) {
    MovingPair moving{any_pair(random), {}, {}};
    Pair& pair = moving.pair;
    const double size = pair.tolerance * 40.0;
    const auto step = [&](const Pose& from, double far) {
        const double turn =
            random.whole(0, 3) == 0 ? random.between(-40.0, 40.0) : random.between(-1.0, 1.0);
        return Pose{{from.translation.x + far * random.between(-size, size),
                     from.translation.y + far * random.between(-size, size)},
                    from.angle + turn};
    };
    const Pose met = pair.pose_a;
    pair.pose_a = step(met, 3.0);
    moving.end_a = step(met, 2.0);
    moving.end_b = random.whole(0, 1) == 0 ? pair.pose_b : step(pair.pose_b, 1.0);
    pair.tolerance *= random.scale(0.001, 1.0);
    return moving;
}

MovingPair falling(const Rings& a, const Rings& b, const Pose& start, const Pose& end,
                   double tolerance) {
    return {{{"A", a}, {"B", b}, start, {}, tolerance}, end, {}};
}

MovingPair keeping(MovingPair moving, double contact_distance) {
    moving.contact_distance = contact_distance;
    return moving;
}

Moment::Moment(const MovingPair& moving, double time)
    : a_(moving.pair.a.rings, pose_at_time(moving.pair.pose_a, moving.end_a, time)),
      b_(moving.pair.b.rings, pose_at_time(moving.pair.pose_b, moving.end_b, time)) {}

bool Moment::meets() const {
    return oracle::intersects(a_, b_);
}

double Moment::boundary_distance() const {
    return oracle::boundary_distance(a_, b_);
}

double relative_motion(const Moment& from, const Moment& to) {
    double most = 0.0;
    for (std::uint32_t i = 0; i < from.a().size(); ++i) {
        const Vector2 of_a = oracle::minus(to.a().vertex(i), from.a().vertex(i));
        for (std::uint32_t j = 0; j < from.b().size(); ++j) {
            const Vector2 of_b = oracle::minus(to.b().vertex(j), from.b().vertex(j));
            most = std::max(most, oracle::distance(of_a, of_b));
        }
    }
    return most;
}

}  // namespace nearfield::test
