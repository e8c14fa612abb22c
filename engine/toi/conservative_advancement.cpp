#include <engine/base/interruption.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/toi/conservative_advancement.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::toi {
namespace {

using geometry::Vector;

constexpr double no_end = std::numeric_limits<double>::infinity();

// The fraction of a distance (in excess of the touching distance) that a step leaves between the
// shapes. That fraction, an eighth, is certified as kept throughout the step in the worst case; a
// step consumes the other seven eighths.
constexpr double kept_part = 1.0 / 8.0;

// Each step tests at most this many pairs, plus half the number of edges, individually: that takes
// about as long as finding the distance.
constexpr std::size_t max_pairs = 64;

// Distances below this many roundings count as zero.
constexpr double touching = 4.0;

/// The distance that a step leaves between the shapes, given their touching distance.
double kept_of(double distance, double touching_distance) {
    return touching_distance + kept_part * (distance - touching_distance);
}

/// The earliest time at which a length can reach zero, given its present derivative `slope` and a
/// bound on the magnitude of its second derivative.
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

/// A point and its motion.
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

void ConservativeAdvancement::place(double time, Impact& contact) {
    ++contact.steps;
    const Pose pose_a = a_->at(time);
    const Pose pose_b = b_->at(time);
    instances_.clear();
    index_a_ = instances_.place(a_->polygon(), pose_a);
    index_b_ = instances_.place(b_->polygon(), pose_b);
    instances_.prepare(index_a_);
    instances_.prepare(index_b_);
    state_a_ = MotionState(*a_, pose_a);
    state_b_ = MotionState(*b_, pose_b);
    motion_ = RelativeMotion(*a_, state_a_, *b_, state_b_);
}

bool ConservativeAdvancement::meet() {
    return overlap_test_.intersect(transformed_a(), transformed_b());
}

bool ConservativeAdvancement::touch_at(double time, double distance, double at_most,
                                       Impact& contact) {
    place(time, contact);
    if (meet()) {
        return true;
    }
    return distance > 0.0 && find_closest(at_most).squared_distance <= distance * distance;
}

bool ConservativeAdvancement::touch_soon(const ContactAim& aim, double ahead, Impact& contact) {
    const double time = std::min(contact.time + ahead, 1.0);
    const double farthest = std::sqrt(contact.closest.squared_distance) +
                            motion_.length(time - contact.time) + rounding_;
    if (!touch_at(time, aim.distance, farthest, contact)) {
        return false;
    }
    contact.kind = Impact::Kind::found;
    contact.latest = time;
    contact.touch_at_latest = true;
    return true;
}

narrowphase::ClosestPair ConservativeAdvancement::find_closest(double at_most) {
    return finder_.find(transformed_a(), transformed_b(), at_most, 0.0);
}

bool ConservativeAdvancement::find_near(double distance, std::size_t most) {
    const simd::TransformedEdges& a = transformed_a();
    const simd::TransformedEdges& b = transformed_b();
    // Covers the rounding of the kernels, the boxes and the transformed vertices.
    const double limit = distance * (1.0 + 1e-12) + a.rounding + b.rounding;
    near_.clear();
    return !simd::kernels::for_within(a.tree(), b.tree(), limit * limit,
                                      [&](const simd::VertexAndEdge& found) {
                                          near_.push_back(found);
                                          return near_.size() <= most;
                                      });
}

double ConservativeAdvancement::pair_step(const simd::VertexAndEdge& pair, double keep) const {
    const simd::TransformedEdges& vertices =
        pair.vertex_of_first ? transformed_a() : transformed_b();
    const simd::TransformedEdges& edges = pair.vertex_of_first ? transformed_b() : transformed_a();
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
    // Use the edge's own normal: sliding along the edge does not bring the point closer, and the
    // direction to a very near point is mostly rounding error. If the nearest point is an end of
    // the edge, a point that slides towards it stays behind the edge's line for longer than it
    // stays away from that end.
    const Vector along = end.at - start.at;
    const Vector normal = Vector(-along.y(), along.x()).normalized();
    const bool ahead = normal.dot(start.at - vertex.at) > 0.0;
    const double step = time_behind(vertex, start, end, ahead ? normal : -normal, keep);
    return nearest.parameter > 0.0 && nearest.parameter < 1.0
               ? step
               : std::max(step, time_behind(vertex, start, end, between / distance, keep));
}

double ConservativeAdvancement::safe_step(double distance, double keep, double left) {
    double step = motion_.time(distance - keep);
    if (step >= left) {
        return left;
    }
    const std::size_t most = max_pairs + (transformed_a().count + transformed_b().count) / 2;
    const double min_reach = 4.0 * distance;
    double reach = std::max(reach_, min_reach);
    bool may_grow = true;
    for (;;) {
        if (!find_near(reach, most)) {
            reach_ = reach / 2.0;
            if (reach == min_reach || !may_grow) {
                return step;
            }
            may_grow = false;
            reach = std::max(reach / 8.0, min_reach);
            continue;
        }
        const double of_others = std::min(motion_.time(reach - keep), left);
        double of_pairs = no_end;
        for (const simd::VertexAndEdge& pair : near_) {
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

bool ConservativeAdvancement::settle(const ContactAim& aim, const Look& look, Impact& contact) {
    const double distance = std::sqrt(look.closest.squared_distance);
    if (look.time == 0.0 && aim.distance > 0.0 && distance <= aim.distance) {
        contact.kind = Impact::Kind::at_start;
        contact.touch_at_latest = true;
    } else if (distance - aim.distance <= touching * rounding_) {
        contact.kind = Impact::Kind::found;
        contact.latest = look.time;
        // Nearly touching shapes have no direction, but the previous time step had one.
        if (look.moved <= aim.motion && look.time - contact.time <= aim.time) {
            return true;
        }
    }
    contact.time = look.time;
    contact.closest = look.closest;
    contact.min_distance = look.min_distance;
    if (contact.kind == Impact::Kind::none && look.time == 1.0) {
        contact.latest = 1.0;
        return true;
    }
    return contact.kind != Impact::Kind::none;
}

void ConservativeAdvancement::advance(const ContactAim& aim, Impact& contact) {
    double time = 0.0;
    double moved = no_end;      // upper bound on the motion since the previous time
    double path = no_end;       // upper bound on the length of its path
    double looked_until = 0.0;  // touch_soon() has searched up to this time
    for (;;) {
        checkpoint();
        const double before = std::sqrt(contact.closest.squared_distance);
        const narrowphase::ClosestPair closest = find_closest(before + moved + rounding_);
        const double distance = std::sqrt(closest.squared_distance);
        // Between two steps the shapes stay farther apart than half the sum of both distances less
        // the path.
        const double kept =
            time > 0.0 ? std::max(kept_of(before, aim.distance), 0.5 * (before + distance - path))
                       : no_end;
        const double least =
            std::max(std::min({contact.min_distance, kept - rounding_, distance - rounding_}), 0.0);
        if (settle(aim, {time, moved, least, closest}, contact)) {
            return;
        }
        const double left = 1.0 - time;
        const double step = safe_step(distance, kept_of(distance, aim.distance), left);
        moved = motion_.length(step);
        path = motion_.path(step);
        const double next = step < left ? time + step : 1.0;
        // The time interval that may remain open.
        const double open = std::min(aim.time, motion_.time(aim.motion));
        if (step < std::min(open, left)) {
            // If the shapes touch and separate again within that interval, they intersect soon
            // after the step. The whole interval is searched only once the previous search has been
            // passed.
            const bool looked = time < looked_until;
            if (touch_soon(aim, looked ? std::min(open, 2.0 * step) : open, contact)) {
                return;
            }
            if (!looked) {
                looked_until = std::min(time + open, 1.0);
            }
        }
        if (contact.steps >= aim.max_steps) {
            give_up(aim, contact);
            return;
        }
        time = next;
        place(time, contact);
    }
}

void ConservativeAdvancement::give_up(const ContactAim& aim, Impact& contact) {
    const InterruptionScope without_limits(nullptr);
    contact.kind = Impact::Kind::unknown;
    contact.latest = 1.0;
    contact.touch_at_latest = touch_at(1.0, aim.distance, no_end, contact);
}

Impact ConservativeAdvancement::find(const Motion& a, const Motion& b, const ContactAim& aim) {
    a_ = &a;
    b_ = &b;
    rounding_ = 16.0 * std::numeric_limits<double>::epsilon() * (a.magnitude() + b.magnitude());
    reach_ = 0.0;
    Impact contact;
    contact.rounding = touching * rounding_;
    place(0.0, contact);
    if (meet()) {
        contact.kind = Impact::Kind::at_start;
        contact.touch_at_latest = true;
        contact.share_a_point_at_start = true;
        contact.min_distance = 0.0;
    } else {
        try {
            advance(aim, contact);
        } catch (const Interrupted&) {
            if (contact.closest.squared_distance == no_end) {
                throw;  // nothing is known yet
            }
            give_up(aim, contact);
        }
    }
    return contact;
}

}  // namespace nearfield::toi
