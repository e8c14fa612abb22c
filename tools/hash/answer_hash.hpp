#pragma once

#include <nearfield/nearfield.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

namespace nearfield::hash {

/// A 64-bit hash of numbers in order. It differs if any bit of any number does.
class AnswerHash {
public:
    [[nodiscard]] std::uint64_t value() const { return value_; }

    void add(double number) { mix(std::bit_cast<std::uint64_t>(number)); }
    void add(float number) { mix(std::bit_cast<std::uint32_t>(number)); }
    template <class Number>
    requires(std::integral<Number> || std::is_enum_v<Number>) void add(Number number) {
        mix(static_cast<std::uint64_t>(number));
    }
    void add(const Vector2& v) { add_all(v.x, v.y); }
    void add(const Pose& p) { add_all(p.translation, p.angle); }
    void add(const Rectangle& r) { add_all(r.min, r.max); }
    void add(const Feature& f) { add_all(f.kind, f.index); }
    void add(const Region& r) { add_all(r.min, r.max, r.width, r.height); }
    void add(const InstanceHandle& h) { add_all(h.index, h.generation); }
    template <class Element>
    void add(const std::vector<Element>& elements) {
        add(std::span<const Element>(elements));
    }
    template <class Element>
    void add(std::span<const Element> elements) {
        add(elements.size());
        for (const Element& element : elements) {
            add(element);
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

    // What a row of a pair table has too.
    void add(const PenetrationValues& v) {
        add(v.count);
        if (v.count > 0) {
            add(v.deepest);
        }
    }
    void add(const IntersectionValues& v) { add_all(v.kind, v.strategy, v.count, v.area, v.box); }
    void add(const ContactValues& v) { add(v.count); }
    void add(const ClosestPointValues& v) {
        add_all(v.point, v.nearest, v.distance, v.direction, v.feature_a, v.feature_b, v.unique,
                v.sampled_distance);
    }
    void add(const SeparationValues& v) {
        add_all(v.distance, v.point_a, v.point_b, v.direction, v.feature_a, v.feature_b, v.unique,
                v.sampled_distance);
    }
    void add(const IntersectionTestValues&) {}
    void add(const SeparationVectorValues& v) {
        add_all(v.vector, v.length, v.lower_bound, v.work);
    }

    /// Everything that an answer states, except how it was found and how long that took.
    void add(const AnyResult& any) {
        std::visit(
            [this](const auto& result) {
                const ResultSummary& summary = result;
                add_all(summary.status.code(), summary.tolerance, summary.error_bound,
                        summary.intersects, summary.cell, summary.regions, summary.technique);
                if (summary.status.ok()) {
                    add_rest(result);
                }
            },
            any);
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
    void add(const InstanceLists& lists) { add_all(lists.offsets, lists.instances); }
    void add(const ShapeCastHit& h) {
        add_all(h.state, h.instance, h.time, h.time_error_bound, h.error_bound, h.point, h.nearest,
                h.direction);
    }
    template <class Query>
    void add(PairTable<Query>& table) {
        for (const PairRow<Query>& row : table.rows()) {
            const typename Query::Result::Values& values = row;
            add_all(row.a, row.b, row.status, row.intersects, row.error_bound, values,
                    table.points(row));
        }
    }

private:
    template <class... Parts>
    void add_all(const Parts&... parts) {
        (add(parts), ...);
    }

    template <class Result>
    void add_rest(const Result& result) {
        const typename Result::Values& values = result;
        add(values);
        if constexpr (requires { result.manifold; }) {
            add(result.manifold);
        }
        if constexpr (requires { result.points; }) {
            add(result.points);
        }
        if constexpr (requires { result.samples; }) {
            add(result.samples);
        }
    }
    void add_rest(const DistanceFieldResult& r) {
        add_all(r.origin, r.width, r.height, r.values, r.features, r.gradients, r.unique, r.points,
                r.gradient_error_bound);
    }
    void add_rest(const TimeOfImpactResult& r) {
        add_all(r.state, r.time, r.time_error_bound, r.pose_a, r.pose_b, r.distance, r.min_distance,
                r.point_a, r.point_b, r.direction, r.feature_a, r.feature_b, r.steps);
    }
    void add_rest(const ContainmentResult& r) {
        add_all(r.inside, r.clearance, r.point_a, r.point_b, r.direction, r.feature_a, r.feature_b,
                r.unique);
    }

    void mix(std::uint64_t word) {
        value_ = std::rotl((value_ ^ word) * 0x9E3779B97F4A7C15, 29) * 0xBF58476D1CE4E5B9;
    }

    std::uint64_t value_ = 0x6E6561726669656C;
};

}  // namespace nearfield::hash
