#include <tests/oracle/fill_law.hpp>
#include <tests/oracle/filled_region.hpp>
#include <tests/oracle/shape_oracle.hpp>
#include <tests/query/query_test.hpp>
#include <tests/unit/support/tangled_rings.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace nearfield::test {
namespace {

using oracle::Edge;
using oracle::FilledRegion;
using oracle::FillLaw;
using oracle::Measured;
using oracle::ShapeOracle;

constexpr std::uint64_t filled_shapes_seed = 20'000;

double gap_between(const Edge& a, const Edge& b) {
    const ShapeOracle of_a(std::vector<Ring>{{a.from, a.to}});
    const ShapeOracle of_b(std::vector<Ring>{{b.from, b.to}});
    return std::min(std::min(of_b.nearest(a.from).distance, of_b.nearest(a.to).distance),
                    std::min(of_a.nearest(b.from).distance, of_a.nearest(b.to).distance));
}

/// A region whose rings cross, overlap, coincide and repeat, as a shape that was added by its fill
/// rule, and a triangle.
///
/// An answer agrees if it is that for the region, or one that the law of fills allows where parts
/// or gaps narrower than the deviation have vanished: the oracle of the law decides those.
struct FilledPair {
    FilledPair(Context& context, Random& random, std::uint64_t number)
        : tangled(number),
          rings(tangled.make(static_cast<int>(number % TangledRings::kinds))),
          rule(static_cast<FillRule>(number / TangledRings::kinds % 4)) {
        const Expected<ResolvedFill> fill = resolve_fill(rings, rule);
        if (!fill.has_value() || fill->rings.empty()) {
            return;
        }
        deviation = fill->deviation;
        region.emplace(rings, rule);
        law.emplace(rings, tangled.unit(), rule, *fill);
        box = ShapeOracle(fill->rings).box();
        size = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
        const double far = std::max(
            {std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
        tolerance = std::max({size / 40.0, 8.0 * deviation, 1e-12 * far});
        rounding = 1e-14 * far;
        slack = 8.0 * (deviation + region->resolution()) + rounding;
        const Expected<ShapeHandle> added = context.add_shape(rings, rule);
        EXPECT_TRUE(added.has_value()) << added.error().text();
        filled = {*added, {}};
        for (int i = 0; i < 3; ++i) {
            corners.push_back({box.min.x + size * random.between(-0.2, 1.0),
                               box.min.y + size * random.between(-0.2, 1.0)});
        }
        triangle = {*context.add_shape(std::vector<Ring>{corners}), {}};
        for (std::size_t i = 0; i < 3; ++i) {
            const Edge side{corners[i], corners[(i + 1) % 3]};
            for (const Edge& piece : region->boundary()) {
                gap = std::min(gap, gap_between(side, piece));
                crosses = crosses || cross(side, piece);
            }
        }
    }

    static bool cross(const Edge& a, const Edge& b) {
        const auto side = [](const Edge& of, const Vector2& p) {
            return (of.to.x - of.from.x) * (p.y - of.from.y) -
                       (of.to.y - of.from.y) * (p.x - of.from.x) >
                   0.0;
        };
        return side(a, b.from) != side(a, b.to) && side(b, a.from) != side(b, a.to);
    }

    /// Whether the signed distance of a point may be `answered`.
    bool has(const Vector2& point, double answered, double bound) {
        return agrees(std::abs(answered - region->signed_distance(point)) <= bound + slack,
                      [&] { return law->allows(point, answered, bound + rounding); });
    }

    /// Whether a point may be one of the boundary.
    bool has_on_boundary(const Vector2& point) {
        return agrees(region->distance(point) <= slack, [&] { return law->is_on_boundary(point); });
    }

    template <class Law>
    static bool agrees(bool strictly, const Law& by_law) {
        return strictly || by_law();
    }

    TangledRings tangled;
    std::vector<Ring> rings;
    FillRule rule;
    std::optional<FilledRegion> region;
    std::optional<FillLaw> law;
    Rectangle box;
    double size = 0.0;       ///< 0 if the region is empty
    double tolerance = 0.0;  ///< for queries
    double deviation = 0.0;
    double rounding = 0.0;
    double slack = 0.0;  ///< eight times the deviation, and rounding
    Instance filled;
    Ring corners;
    Instance triangle;
    double gap = INFINITY;  ///< between the ends of edges and the other boundary
    bool crosses = false;   ///< the boundaries
};

class FilledShapes : public QueryTest {
protected:
    /// Calls `check` for random pairs whose region is not empty.
    template <class Check>
    static void for_each_pair(int usual, const Check& check) {
        int checked = 0;
        std::uint64_t number = 0;
        for_each_case(filled_shapes_seed, usual, [&](Random& random) {
            const std::uint64_t from = static_cast<std::uint64_t>(first_case());
            FilledPair pair(context(), random, from + number++);
            if (pair.size == 0.0 || HasFailure()) {
                return;
            }
            check(pair);
            ++checked;
            EXPECT_TRUE(context().remove_shape(pair.filled.shape).ok());
            EXPECT_TRUE(context().remove_shape(pair.triangle.shape).ok());
        });
        EXPECT_GT(checked, random_cases(usual) / 2);
    }

    template <class Query>
    static typename Query::Result ask(Query query, Technique technique) {
        query.technique = technique;
        const auto result = run_alone(context(), query);
        EXPECT_TRUE(result.status.ok()) << to_string(technique) << ": " << result.status.text();
        return result;
    }
};

TEST_F(FilledShapes, FieldsHaveNoInnerEdges) {
    std::size_t inner = 0;
    for_each_pair(36, [&](FilledPair& pair) {
        inner += pair.region->inner_edges().size();
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            DistanceFieldQuery query;
            query.b = pair.filled;
            query.tolerance = pair.tolerance;
            query.rectangle = pair.box;
            const DistanceFieldResult field = ask(query, technique);
            for (std::size_t i = 0; i < field.values.size(); ++i) {
                const double column = static_cast<double>(i % field.width) + 0.5;
                const double row = static_cast<double>(i / field.width) + 0.5;
                const Vector2 at{field.origin.x + column * field.cell,
                                 field.origin.y + row * field.cell};
                ASSERT_TRUE(pair.has(at, static_cast<double>(field.values[i]),
                                     field.error_bound * (1 + 1e-6)))
                    << at.x << ", " << at.y << ": " << field.values[i] << " instead of "
                    << pair.region->signed_distance(at);
            }
        }
    });
    EXPECT_GT(inner, 100U);
}

TEST_F(FilledShapes, PointsAreAsDeepAsInTheRegion) {
    std::size_t records = 0;
    for_each_pair(72, [&](FilledPair& pair) {
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            // Of edges that are equally near to within d/1000 a device may name any.
            const double bound = technique == Technique::cpu ? 0.0 : pair.tolerance / 1000.0;
            const PenetrationResult found =
                ask(PenetrationQuery{pair.triangle, pair.filled, pair.tolerance}, technique);
            for (const PenetratingPoint& record : found.points) {
                ASSERT_TRUE(pair.has(record.position, -record.depth, bound))
                    << record.position.x << ", " << record.position.y << ": " << record.depth
                    << " instead of " << -pair.region->signed_distance(record.position);
            }
            records += found.points.size();
            // No point of an edge inside the region is a point of its boundary.
            const PenetrationResult own =
                ask(PenetrationQuery{pair.filled, pair.triangle, pair.tolerance}, technique);
            for (const PenetratingPoint& record : own.points) {
                ASSERT_TRUE(pair.has_on_boundary(record.position));
            }
            const ContactResult contacts =
                ask(ContactQuery{pair.triangle, pair.filled, pair.tolerance, pair.size / 20.0},
                    technique);
            for (const ContactPoint& contact : contacts.points) {
                const bool of_a = contact.on == Side::a;
                ASSERT_TRUE(pair.has_on_boundary(of_a ? contact.nearest : contact.position));
                if (of_a) {
                    ASSERT_TRUE(pair.has(contact.position, contact.distance, bound) ||
                                pair.has(contact.position, -contact.distance, bound))
                        << contact.position.x << ", " << contact.position.y << ": "
                        << contact.distance << " instead of "
                        << pair.region->signed_distance(contact.position);
                }
            }
        }
    });
    EXPECT_GT(records, 1000U);
}

TEST_F(FilledShapes, PairsAreAsFarApartAsTheRegionIs) {
    int inside = 0;
    int apart = 0;
    for_each_pair(600, [&](FilledPair& pair) {
        const double bound = 2.0 * pair.slack;
        const ShapeOracle triangle(std::vector<Ring>{pair.corners});
        const Measured measured{
            pair.corners, [&](const Vector2& point) { return triangle.signed_distance(point); }};
        const bool within = !pair.crosses && pair.region->contains(pair.corners[0]);
        // A ring of the region inside the triangle is a part of it, or one of its holes.
        bool around = false;
        for (const Edge& piece : pair.region->boundary()) {
            around = around || (!pair.crosses && triangle.contains(piece.from));
        }
        const bool touch = !pair.crosses && pair.gap <= bound;
        const bool meet = pair.crosses || within || around;
        const SeparationResult separation =
            ask(SeparationQuery{pair.triangle, pair.filled, pair.tolerance}, Technique::automatic);
        const double own_bound = separation.error_bound + pair.rounding;
        EXPECT_LE(separation.error_bound, bound);
        EXPECT_TRUE(pair.agrees(
            std::abs(separation.distance - (meet ? 0.0 : pair.gap)) <= bound,
            [&] { return pair.law->allows(measured, separation.distance, own_bound, 1); }))
            << separation.distance << " instead of " << (meet ? 0.0 : pair.gap);
        const bool answered =
            ask(IntersectionTestQuery{pair.triangle, pair.filled}, Technique::cpu).intersects;
        EXPECT_TRUE(pair.agrees(answered == meet || touch,
                                [&] {
                                    return answered ? pair.law->is_near(measured, own_bound, 1)
                                                    : !pair.law->is_clearly_near(measured,
                                                                                 -own_bound, 1);
                                }))
            << "intersects: " << answered;
        const ContainmentResult containment =
            ask(ContainmentQuery{pair.triangle, pair.filled}, Technique::cpu);
        const bool held = within && !around;
        EXPECT_TRUE(pair.agrees(containment.inside == held || touch,
                                [&] {
                                    return containment.inside
                                               ? !pair.law->is_clearly_near(measured, -own_bound, 0)
                                               : pair.law->is_near(measured, own_bound, 0);
                                }))
            << "inside: " << containment.inside;
        if (containment.inside) {
            EXPECT_TRUE(pair.agrees(
                held && std::abs(containment.clearance - pair.gap) <= bound,
                [&] { return pair.law->allows(measured, containment.clearance, own_bound, 0); }))
                << containment.clearance << " instead of " << pair.gap;
        }
        inside += containment.inside ? 1 : 0;
        apart += meet ? 0 : 1;
    });
    EXPECT_GT(inside, 5);
    EXPECT_GT(apart, 5);
}

TEST_F(FilledShapes, AreUpdatedByTheirRule) {
    const std::vector<Ring> overlapping{{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                                        {{2, 2}, {6, 2}, {6, 6}, {2, 6}}};
    const std::vector<Ring> clockwise{{{0, 0}, {0, 4}, {4, 4}, {4, 0}}};
    const ShapeHandle shape = *context().add_shape(overlapping, FillRule::nonzero);
    const Instance dot{*context().add_shape(std::vector<Ring>{{{2.9, 2.9}, {3, 2.9}, {3, 3}}}), {}};
    const auto depth = [&] {
        PenetrationQuery query{dot, {shape, {}}, 0.01, PenetrationPoints::vertices};
        const PenetrationResult found = ask(query, Technique::cpu);
        return found.count == 0 ? 0.0 : found.deepest.depth;
    };
    EXPECT_NEAR(depth(), std::hypot(1.1, 0.9), 1e-9);
    EXPECT_TRUE(context().update_shape(shape, overlapping, FillRule::odd_even).ok());
    EXPECT_EQ(depth(), 0.0);
    EXPECT_TRUE(context().update_shape(shape, overlapping, FillRule::positive, 1e-3).ok());
    PenetrationQuery query{dot, {shape, {}}, 0.01, PenetrationPoints::vertices};
    EXPECT_GE(ask(query, Technique::cpu).error_bound, 1e-3);
    // What is refused leaves the shape as it was.
    const Status empty = context().update_shape(shape, clockwise, FillRule::positive);
    EXPECT_EQ(empty.code(), StatusCode::invalid_shape);
    EXPECT_NE(empty.message().find("enclose nothing"), std::string::npos) << empty.message();
    EXPECT_EQ(context().add_shape(clockwise, FillRule::positive).error().code(),
              StatusCode::invalid_shape);
    EXPECT_EQ(context().add_shape(overlapping, FillRule::nonzero, -1e-20).error().code(),
              StatusCode::invalid_shape);
    EXPECT_EQ(context().update_shape(shape, {}, FillRule::nonzero).code(),
              StatusCode::invalid_shape);
    EXPECT_EQ(context().update_shape({}, overlapping, FillRule::nonzero).code(),
              StatusCode::unknown_shape);
    EXPECT_NEAR(depth(), std::hypot(1.1, 0.9), 1e-9);
}

}  // namespace
}  // namespace nearfield::test
