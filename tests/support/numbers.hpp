#pragma once

#include <nearfield/nearfield.hpp>

#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

/// \file
/// Answers as numbers: two of them are the same, bit for bit, if their numbers are.

namespace nearfield::test {

/// The numbers of answers, one after the other.
class Numbers {
public:
    /// A number that stands for an instance.
    using Name = std::function<double(InstanceHandle)>;

    Numbers() = default;
    explicit Numbers(Name name) : name_(std::move(name)) {}

    [[nodiscard]] const std::vector<double>& list() const { return list_; }
    [[nodiscard]] bool operator==(const Numbers& other) const { return list_ == other.list_; }
    /// Forgets all numbers, and keeps their memory.
    void clear() { list_.clear(); }

    template <class First, class Second, class... Rest>
    void add(const First& first, const Second& second, const Rest&... rest) {
        add(first);
        add(second);
        (add(rest), ...);
    }
    template <class Number>
    requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) void add(Number number) {
        list_.push_back(static_cast<double>(number));
    }
    template <class Element>
    void add(const std::vector<Element>& elements) {
        add(elements.size());
        add_each(std::span(elements));
    }
    template <class Element>
    void add_each(std::span<Element> elements) {
        for (const auto& element : elements) {
            add(element);
        }
    }

    void add(const Vector2& v) { add(v.x, v.y); }
    void add(const Rectangle& r) { add(r.min, r.max); }
    void add(const Feature& f) { add(f.kind, f.index); }
    void add(const Pose& p) { add(p.translation, p.angle); }
    void add(const Region& r) { add(r.min, r.max, r.width, r.height); }
    void add(InstanceHandle handle) {
        if (name_) {
            add(name_(handle));
        } else {
            add(handle.index, handle.generation);
        }
    }

    // Records.

    void add(const NoPoint& /*none*/) {}
    void add(const PenetratingPoint& r) {
        add(r.position, r.depth, r.direction, r.nearest, r.feature, r.unique);
    }
    void add(const IntersectionSample& s) { add(s.position, s.edge); }
    void add(const FieldPoint& p) {
        add(p.position, p.distance, p.error_bound, p.inside, p.gradient, p.feature, p.unique);
    }
    void add(const ContactPoint& r) {
        add(r.position, r.normal, r.distance, r.nearest, r.feature, r.on, r.inside, r.unique);
    }
    void add(const ContactCluster& c) { add(c.first, c.last, c.normal, c.extreme, c.count); }

    // What a result and a row have in common.

    void add(const IntersectionTestValues& /*none*/) {}
    void add(const PenetrationValues& v) {
        add(v.count);
        if (v.count > 0) {
            add(v.deepest);
        }
    }
    void add(const ContactValues& v) { add(v.count); }
    void add(const IntersectionValues& v) { add(v.kind, v.strategy, v.count, v.area, v.box); }
    void add(const ClosestPointValues& v) {
        add(v.point, v.nearest, v.distance, v.direction, v.feature_a, v.feature_b, v.unique,
            v.sampled_distance);
    }
    void add(const SeparationValues& v) {
        add(v.distance, v.point_a, v.point_b, v.direction, v.feature_a, v.feature_b, v.unique,
            v.sampled_distance);
    }
    void add(const TimeOfImpactValues& v) {
        add(v.state, v.time, v.time_error_bound, v.pose_a, v.pose_b, v.distance, v.min_distance,
            v.point_a, v.point_b, v.direction, v.feature_a, v.feature_b, v.steps);
    }
    void add(const SeparationVectorValues& v) { add(v.vector, v.length, v.lower_bound, v.work); }
    void add(const ContainmentValues& v) {
        add(v.inside, v.clearance, v.point_a, v.point_b, v.direction, v.feature_a, v.feature_b,
            v.unique);
    }

    // Answers of worlds.

    void add(const RayHit& h) {
        add(h.instance, h.parameter, h.error_bound, h.point, h.normal, h.edge);
    }
    void add(const NearestHit& h) {
        add(h.instance, h.distance, h.error_bound, h.nearest, h.feature);
    }
    void add(const ShapeEdgeHit& h) {
        add(h.instance, h.edge, h.distance, h.error_bound, h.point, h.nearest, h.direction);
    }
    void add(const Clearance& c) {
        add(c.distance, c.error_bound, c.instance, c.point, c.nearest, c.direction);
    }
    void add(const ShapeCastHit& h) {
        add(h.state, h.instance, h.time, h.time_error_bound, h.error_bound, h.point, h.nearest,
            h.direction);
    }
    void add(const InstanceLists& lists) { add_lists(lists.offsets, lists.instances); }
    void add(const RayHits& hits) { add_lists(hits.offsets, hits.hits); }

    /// A row, its records and its manifold.
    template <class Query>
    void add_row(PairTable<Query>& table, const PairRow<Query>& row) {
        add(row.a, row.b, row.status, row.intersects, row.error_bound, row.index, row.point_count);
        if (row.status == StatusCode::ok) {
            add_answer(table, row);
        }
    }
    /// What a row says as the result of its query does.
    template <class Query>
    void add_answer(PairTable<Query>& table, const PairRow<Query>& row) {
        add(row.intersects, row.error_bound);
        add(static_cast<const typename Query::Result::Values&>(row));
        add_each(table.points(row));
        if constexpr (std::is_same_v<Query, ContactQuery>) {
            add_each(table.manifold(row));
        }
    }
    template <class Result>
    void add_answer(const Result& result) {
        add(result.intersects, result.error_bound);
        add(static_cast<const typename Result::Values&>(result));
        if constexpr (requires { result.samples; }) {
            add_each(std::span(result.samples));
        } else if constexpr (requires { result.points; }) {
            add_each(std::span(result.points));
        }
        if constexpr (requires { result.manifold; }) {
            add_each(std::span(result.manifold));
        }
    }

private:
    /// List by list.
    template <class Element>
    void add_lists(const std::vector<std::uint32_t>& offsets,
                   const std::vector<Element>& elements) {
        for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
            add(offsets[i + 1] - offsets[i]);
            add_each(std::span(elements).subspan(offsets[i], offsets[i + 1] - offsets[i]));
        }
    }

    Name name_;
    std::vector<double> list_;
};

/// Those of any answers.
template <class... Answers>
[[nodiscard]] std::vector<double> numbers_of(const Answers&... answers) {
    Numbers numbers;
    (numbers.add(answers), ...);
    return numbers.list();
}

/// All that the rows of a table say.
template <class Query>
[[nodiscard]] std::vector<double> rows_of(PairTable<Query>& table) {
    Numbers numbers;
    for (const PairRow<Query>& row : table.rows()) {
        numbers.add_row(table, row);
    }
    return numbers.list();
}

}  // namespace nearfield::test
