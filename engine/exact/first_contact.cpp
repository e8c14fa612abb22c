#include <engine/exact/first_contact.hpp>
#include <engine/geometry/segment.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::exact {
namespace {

using geometry::Vector;

constexpr double no_end = std::numeric_limits<double>::infinity();

// Of the distance at a time that is more than that of touching, what a step leaves between the
// shapes. The rest can be certified as kept all along, and is an eighth in the worst case; a step
// takes the other seven.
constexpr double kept_part = 1.0 / 8.0;

// So many pairs, and half as many as there are edges, are looked at one by one in a step: that
// takes about as long as to find the distance.
constexpr std::size_t most_pairs = 64;

// Distances of less than so many roundings are none.
constexpr double touching = 4.0;

/// What a step leaves of a distance, where shapes touch at another.
double kept_of(double distance, double touching_distance) {
    return touching_distance + kept_part * (distance - touching_distance);
}

/// When a length that shrinks from `length` at a rate that is `-slope` now and grows by at most
/// `acceleration` reaches zero at the earliest.
double shrinking_time(double length, double slope, double acceleration) {
    if (!(length > 0.0)) {
        return 0.0;
    }
    const double root = std::sqrt(slope * slope + 2.0 * acceleration * length);
    if (slope < 0.0) {
        return 2.0 * length / (root - slope);
    }
    return acceleration > 0.0 ? (slope + root) / acceleration : no_end;
}

/// A point and how it moves.
struct MovingPoint {
    Vector at;
    Vector velocity;
    double acceleration;

    MovingPoint(const MotionState& state, const Vector& point)
        : at(point),
          velocity(state.velocity_at(point)),
          acceleration(state.acceleration_at(point)) {}
};

/// How long a point stays behind both ends of an edge along a direction, by more than `keep`.
double time_behind(const MovingPoint& point, const MovingPoint& start, const MovingPoint& end,
                   const Vector& direction, double keep) {
    const auto behind = [&](const MovingPoint& other) {
        return shrinking_time(direction.dot(other.at - point.at) - keep,
                              direction.dot(other.velocity - point.velocity),
                              other.acceleration + point.acceleration);
    };
    return std::min(behind(start), behind(end));
}

}  // namespace

void FirstContactFinder::place(double time, FirstContact& contact) {
    ++contact.steps;
    const Pose pose_a = a_->at(time);
    const Pose pose_b = b_->at(time);
    instances_.clear();
    index_a_ = instances_.place(a_->polygon(), pose_a);
    index_b_ = instances_.place(b_->polygon(), pose_b);
    instances_.complete(index_a_);
    instances_.complete(index_b_);
    state_a_ = MotionState(*a_, pose_a);
    state_b_ = MotionState(*b_, pose_b);
    motion_ = RelativeMotion(*a_, state_a_, *b_, state_b_);
}

bool FirstContactFinder::meet() {
    return meeting_.intersect(placed_a(), placed_b());
}

bool FirstContactFinder::touch_at(double time, double distance, double at_most,
                                  FirstContact& contact) {
    place(time, contact);
    if (meet()) {
        return true;
    }
    return distance > 0.0 && find_closest(at_most).squared_distance <= distance * distance;
}

bool FirstContactFinder::touch_soon(const ContactAim& aim, double ahead, FirstContact& contact) {
    const double time = std::min(contact.time + ahead, 1.0);
    const double farthest = std::sqrt(contact.closest.squared_distance) +
                            motion_.length(time - contact.time) + rounding_;
    if (!touch_at(time, aim.distance, farthest, contact)) {
        return false;
    }
    contact.kind = FirstContact::Kind::found;
    contact.latest = time;
    contact.touch_at_latest = true;
    return true;
}

ClosestPair FirstContactFinder::find_closest(double at_most) {
    return finder_.find(placed_a(), placed_b(), at_most, 0.0);
}

double FirstContactFinder::pair_step(const VertexAndEdge& pair, double keep) const {
    const PlacedEdges& vertices = pair.vertex_of_first ? placed_a() : placed_b();
    const PlacedEdges& edges = pair.vertex_of_first ? placed_b() : placed_a();
    const MotionState& of_vertex = pair.vertex_of_first ? state_a_ : state_b_;
    const MotionState& of_edge = pair.vertex_of_first ? state_b_ : state_a_;
    const MovingPoint vertex(of_vertex, vertices.start(pair.vertex));
    const MovingPoint start(of_edge, edges.start(pair.edge));
    const MovingPoint end(of_edge, edges.end(pair.edge));

    const auto nearest = geometry::nearest_on_segment(vertex.at, start.at, end.at);
    const Vector between = nearest.point - vertex.at;
    const double distance = between.norm();
    if (!(distance > keep)) {
        return 0.0;
    }
    // The edge's own normal: what slides along the edge does not come closer at all, and in the way
    // to a point that is very near there is mostly rounding. Where the nearest point is an end of
    // the edge, what slides towards it stays behind the edge's line for longer than away from the
    // end.
    const Vector along = end.at - start.at;
    const Vector normal = Vector(-along.y(), along.x()).normalized();
    const bool ahead = normal.dot(start.at - vertex.at) > 0.0;
    const double step = time_behind(vertex, start, end, ahead ? normal : -normal, keep);
    return nearest.parameter > 0.0 && nearest.parameter < 1.0
               ? step
               : std::max(step, time_behind(vertex, start, end, between / distance, keep));
}

double FirstContactFinder::safe_step(double distance, double keep, double left) {
    double step = motion_.time(distance - keep);
    if (step >= left) {
        return left;
    }
    near_.begin(placed_a(), placed_b());
    const std::size_t most = most_pairs + (placed_a().count + placed_b().count) / 2;
    const double least_reach = 4.0 * distance;
    double reach = std::max(reach_, least_reach);
    bool may_grow = true;
    for (;;) {
        if (!near_.find(reach, most)) {
            reach_ = reach / 2.0;
            if (reach == least_reach || !may_grow) {
                return step;
            }
            may_grow = false;
            reach = std::max(reach / 8.0, least_reach);
            continue;
        }
        const double of_others = std::min(motion_.time(reach - keep), left);
        double of_pairs = no_end;
        for (const VertexAndEdge& pair : near_.found()) {
            of_pairs = std::min(of_pairs, pair_step(pair, keep));
        }
        step = std::max(step, std::min(of_pairs, of_others));
        if (of_pairs < of_others || of_others >= left || !may_grow) {
            reach_ = 4.0 * of_pairs < of_others ? reach / 2.0 : reach;
            return step;
        }
        reach *= 4.0;
    }
}

bool FirstContactFinder::settle(const ContactAim& aim, const Look& look, FirstContact& contact) {
    const double distance = std::sqrt(look.closest.squared_distance);
    if (look.time == 0.0 && aim.distance > 0.0 && distance <= aim.distance) {
        contact.kind = FirstContact::Kind::at_start;
        contact.touch_at_latest = true;
    } else if (distance - aim.distance <= touching * rounding_) {
        contact.kind = FirstContact::Kind::found;
        contact.latest = look.time;
        // Of shapes that all but touch there is no direction; before, there was one.
        if (look.moved <= aim.motion && look.time - contact.time <= aim.time) {
            return true;
        }
    }
    contact.time = look.time;
    contact.closest = look.closest;
    contact.least_distance = look.least_distance;
    if (contact.kind == FirstContact::Kind::none && look.time == 1.0) {
        contact.latest = 1.0;
        return true;
    }
    return contact.kind != FirstContact::Kind::none;
}

void FirstContactFinder::advance(const ContactAim& aim, FirstContact& contact) {
    double time = 0.0;
    double moved = no_end;      // how far at the most since the time before
    double path = no_end;       // and how long the way was
    double looked_until = 0.0;  // up to where shapes that met have been looked for
    for (;;) {
        const double before = std::sqrt(contact.closest.squared_distance);
        const ClosestPair closest = find_closest(before + moved + rounding_);
        const double distance = std::sqrt(closest.squared_distance);
        // On the way away from the one and to the other they came no closer than half way.
        const double kept =
            time > 0.0 ? std::max(kept_of(before, aim.distance), 0.5 * (before + distance - path))
                       : no_end;
        const double least = std::max(
            std::min({contact.least_distance, kept - rounding_, distance - rounding_}), 0.0);
        if (settle(aim, {time, moved, least, closest}, contact)) {
            return;
        }
        const double left = 1.0 - time;
        const double step = safe_step(distance, kept_of(distance, aim.distance), left);
        moved = motion_.length(step);
        path = motion_.path(step);
        const double next = step < left ? time + step : 1.0;
        // What may be left open.
        const double open = std::min(aim.time, motion_.time(aim.motion));
        if (step < std::min(open, left)) {
            // Where they touch and part again before that, they meet soon after the step.
            // All of it is looked ahead once that has passed by, not before.
            const bool looked = time < looked_until;
            if (touch_soon(aim, looked ? std::min(open, 2.0 * step) : open, contact)) {
                return;
            }
            if (!looked) {
                looked_until = std::min(time + open, 1.0);
            }
        }
        if (contact.steps >= aim.most_steps) {
            contact.kind = FirstContact::Kind::unknown;
            contact.latest = 1.0;
            contact.touch_at_latest = touch_at(1.0, aim.distance, no_end, contact);
            return;
        }
        time = next;
        place(time, contact);
    }
}

FirstContact FirstContactFinder::find(const Motion& a, const Motion& b, const ContactAim& aim) {
    a_ = &a;
    b_ = &b;
    rounding_ = 16.0 * std::numeric_limits<double>::epsilon() * (a.magnitude() + b.magnitude());
    reach_ = 0.0;
    FirstContact contact;
    contact.rounding = touching * rounding_;
    place(0.0, contact);
    if (meet()) {
        contact.kind = FirstContact::Kind::at_start;
        contact.touch_at_latest = true;
        contact.share_a_point_at_start = true;
        contact.least_distance = 0.0;
    } else {
        advance(aim, contact);
    }
    return contact;
}

}  // namespace nearfield::exact
