#pragma once

#include <nearfield/nearfield.hpp>

#include <span>
#include <vector>

namespace nearfield::hash {

/// What answers state, number by number, in order. A class that derives from it, and is `Sink`, has
/// `add(number)`, and `add(InstanceHandle)`.
template <class Sink>
class AnswerFields {
public:
    void add(const Vector2& v) { add_all(v.x, v.y); }
    void add(const Pose& p) { add_all(p.translation, p.angle); }
    void add(const Rectangle& r) { add_all(r.min, r.max); }
    void add(const Feature& f) { add_all(f.kind, f.index); }
    void add(const Region& r) { add_all(r.min, r.max, r.width, r.height); }
    template <class Element>
    void add(const std::vector<Element>& elements) {
        add(std::span<const Element>(elements));
    }
    template <class Element>
    void add(std::span<const Element> elements) {
        add_all(elements.size());
        for (const Element& element : elements) {
            add_all(element);
        }
    }

    // What the answers list.
    void add(const NoPoint&) {}
    void add(const PenetratingPoint& r) {
        add_all(r.position, r.depth, r.direction, r.nearest, r.feature, r.unique);
    }
    void add(const IntersectionSample& s) { add_all(s.position, s.edge); }
    void add(const FieldPoint& p) {
        add_all(p.position, p.distance, p.error_bound, p.inside, p.gradient, p.feature, p.unique);
    }
    void add(const ContactPoint& r) {
        add_all(r.position, r.normal, r.distance, r.nearest, r.feature, r.on, r.inside, r.unique);
    }
    void add(const ContactCluster& c) { add_all(c.first, c.last, c.normal, c.extreme, c.count); }

    // What a result and a row of a pair table have in common.
    void add(const IntersectionTestValues&) {}
    void add(const PenetrationValues& v) {
        add_all(v.count);
        if (v.count > 0) {
            add(v.deepest);
        }
    }
    void add(const IntersectionValues& v) { add_all(v.kind, v.strategy, v.count, v.area, v.box); }
    void add(const ContactValues& v) { add_all(v.count); }
    void add(const ClosestPointValues& v) {
        add_all(v.point, v.nearest, v.distance, v.direction, v.feature_a, v.feature_b, v.unique,
                v.sampled_distance);
    }
    void add(const SeparationValues& v) {
        add_all(v.distance, v.point_a, v.point_b, v.direction, v.feature_a, v.feature_b, v.unique,
                v.sampled_distance);
    }
    void add(const TimeOfImpactValues& v) {
        add_all(v.state, v.time, v.time_error_bound, v.pose_a, v.pose_b, v.distance, v.min_distance,
                v.point_a, v.point_b, v.direction, v.feature_a, v.feature_b, v.steps);
    }
    void add(const SeparationVectorValues& v) {
        add_all(v.vector, v.length, v.lower_bound, v.work);
    }
    void add(const ContainmentValues& v) {
        add_all(v.inside, v.clearance, v.point_a, v.point_b, v.direction, v.feature_a, v.feature_b,
                v.unique);
    }

    /// A field, besides its summary.
    void add_field(const DistanceFieldResult& r) {
        add_all(r.origin, r.width, r.height, r.values, r.features, r.gradients, r.unique, r.points,
                r.gradient_error_bound);
    }

    // The answers of a world.
    void add(const ShapeEdgeHit& h) {
        add_all(h.instance, h.edge, h.distance, h.error_bound, h.point, h.nearest, h.direction);
    }
    void add(const Clearance& c) {
        add_all(c.distance, c.error_bound, c.instance, c.point, c.nearest, c.direction);
    }
    void add(const NearestHit& h) {
        add_all(h.instance, h.distance, h.error_bound, h.nearest, h.feature);
    }
    void add(const RayHit& h) {
        add_all(h.instance, h.parameter, h.error_bound, h.point, h.normal, h.edge);
    }
    void add(const ShapeCastHit& h) {
        add_all(h.state, h.instance, h.time, h.time_error_bound, h.error_bound, h.point, h.nearest,
                h.direction);
    }

    template <class... Parts>
    void add_all(const Parts&... parts) {
        (static_cast<Sink&>(*this).add(parts), ...);
    }
};

}  // namespace nearfield::hash
