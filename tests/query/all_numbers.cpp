#include <tests/query/all_numbers.hpp>

#include <type_traits>
#include <utility>
#include <variant>

namespace nearfield::test {
namespace {

/// Collects the numbers of results in order.
class NumberList {
public:
    std::vector<double> numbers;

    template <class Number>
    requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) void add(Number number) {
        numbers.push_back(static_cast<double>(number));
    }
    void add(const Vector2& v) { add_all(v.x, v.y); }
    void add(const Rectangle& r) { add_all(r.min, r.max); }
    void add(const Feature& f) { add_all(f.kind, f.index); }
    void add(const Pose& p) { add_all(p.translation, p.angle); }
    void add(const Region& r) { add_all(r.min, r.max, r.width, r.height); }
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
    template <class Element>
    void add(const std::vector<Element>& elements) {
        add(elements.size());
        for (const Element& element : elements) {
            add(element);
        }
    }
    void add(const ResultSummary& s) {
        add_all(s.status.code(), s.tolerance, s.error_bound, s.intersects, s.cell, s.regions,
                s.localization.nodes_evaluated, s.localization.pairs_rejected,
                s.localization.edges_kept, s.technique);
    }

    void add_rest(const IntersectionTestResult&) {}
    void add_rest(const PenetrationResult& r) {
        add_all(r.count, r.points);
        if (r.count > 0) {
            add(r.deepest);
        }
    }
    void add_rest(const IntersectionResult& r) {
        add_all(r.kind, r.strategy, r.count, r.area, r.box, r.samples);
    }
    void add_rest(const DistanceFieldResult& r) {
        add_all(r.origin, r.width, r.height, r.values, r.features, r.gradients, r.unique, r.points,
                r.gradient_error_bound);
    }
    void add_rest(const ContactResult& r) { add_all(r.count, r.manifold, r.points); }
    void add_rest(const ClosestPointResult& r) {
        add_all(r.point, r.nearest, r.distance, r.direction, r.feature_a, r.feature_b, r.unique,
                r.sampled_distance);
    }
    void add_rest(const SeparationResult& r) {
        add_all(r.distance, r.point_a, r.point_b, r.direction, r.feature_a, r.feature_b, r.unique,
                r.sampled_distance);
    }

    void add_rest(const TimeOfImpactResult& r) {
        add_all(r.state, r.time, r.time_error_bound, r.pose_a, r.pose_b, r.distance, r.min_distance,
                r.point_a, r.point_b, r.direction, r.feature_a, r.feature_b, r.steps);
    }
    void add_rest(const SeparationVectorResult& r) {
        add_all(r.vector, r.length, r.lower_bound, r.work);
    }
    void add_rest(const ContainmentResult& r) {
        add_all(r.inside, r.clearance, r.point_a, r.point_b, r.direction, r.feature_a, r.feature_b,
                r.unique);
    }

private:
    template <class... Parts>
    void add_all(const Parts&... parts) {
        (add(parts), ...);
    }
};

}  // namespace

std::vector<double> all_numbers(const Results& results) {
    NumberList list;
    for (const AnyResult& any : results.results) {
        std::visit(
            [&](const auto& result) {
                list.add(static_cast<const ResultSummary&>(result));
                list.add_rest(result);
            },
            any);
    }
    return std::move(list.numbers);
}

}  // namespace nearfield::test
