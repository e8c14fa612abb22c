#include <tests/oracle/filled_region.hpp>
#include <tests/oracle/shape_oracle.hpp>
#include <tests/query/query_test.hpp>
#include <tests/unit/support/tangled_rings.hpp>

#include <algorithm>
#include <array>
#include <numbers>

namespace nearfield::test {
namespace {

using oracle::Edge;
using oracle::FilledRegion;
using oracle::ShapeOracle;

constexpr std::uint64_t seed = 20'000;
constexpr Technique techniques[] = {Technique::raster, Technique::compute, Technique::cpu};

double gap_between(const Edge& a, const Edge& b) {
    const ShapeOracle of_a(std::vector<Ring>{{a.from, a.to}});
    const ShapeOracle of_b(std::vector<Ring>{{b.from, b.to}});
    return std::min(std::min(of_b.nearest(a.from).distance, of_b.nearest(a.to).distance),
                    std::min(of_a.nearest(b.from).distance, of_a.nearest(b.to).distance));
}

/// True at the tip of a part, or of a gap, so narrow that a deviation takes away more than eight
/// times its length of it.
bool is_narrow(const FilledRegion& region, const Vector2& tip, double deviation) {
    double deepest = 0.0;
    double farthest = 0.0;
    for (int i = 0; i < 64; ++i) {
        const double angle = 0.05 + 2.0 * std::numbers::pi * i / 64.0;
        const double distance = region.signed_distance(
            {tip.x + 8.0 * deviation * std::cos(angle), tip.y + 8.0 * deviation * std::sin(angle)});
        deepest = std::max(deepest, -distance);
        farthest = std::max(farthest, distance);
    }
    return std::min(deepest, farthest) < deviation;
}

/// A region whose rings cross, overlap, coincide and repeat, as a shape that was added by its fill
/// rule, and a triangle. Left out are kinds of rings with slivers as narrow as the rule's
/// deviation, which may vanish, and regions with such tips, which may become shorter.
struct FilledPair {
    FilledPair(Context& context, Random& random, std::uint64_t number)
        : rings(make_rings(number)), rule(static_cast<FillRule>(number % 4)), region(rings, rule) {
        const std::vector<Edge> boundary = region.boundary();
        if (boundary.empty()) {
            return;
        }
        box = {boundary.front().from, boundary.front().from};
        for (const Edge& piece : boundary) {
            box.min = {std::min(box.min.x, piece.from.x), std::min(box.min.y, piece.from.y)};
            box.max = {std::max(box.max.x, piece.from.x), std::max(box.max.y, piece.from.y)};
        }
        size = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
        const Expected<ResolvedFill> fill = resolve_fill(rings, rule);
        EXPECT_TRUE(fill.has_value());
        deviation = fill.has_value() ? fill->deviation : 0.0;
        const double far = std::max(
            {std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
        slack = 8.0 * (deviation + region.resolution()) + 1e-14 * far;
        narrow = std::any_of(boundary.begin(), boundary.end(), [&](const Edge& piece) {
            return is_narrow(region, piece.from, deviation + region.resolution());
        });
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
            for (const Edge& piece : boundary) {
                gap = std::min(gap, gap_between(side, piece));
                crosses = crosses || cross(side, piece);
            }
        }
    }

    static std::vector<Ring> make_rings(std::uint64_t number) {
        constexpr std::array kinds{0, 1, 2, 3, 7, 9};
        return TangledRings(number).make(kinds[number % kinds.size()]);
    }

    static bool cross(const Edge& a, const Edge& b) {
        const auto side = [](const Edge& of, const Vector2& p) {
            return (of.to.x - of.from.x) * (p.y - of.from.y) -
                       (of.to.y - of.from.y) * (p.x - of.from.x) >
                   0.0;
        };
        return side(a, b.from) != side(a, b.to) && side(b, a.from) != side(b, a.to);
    }

    std::vector<Ring> rings;
    FillRule rule;
    FilledRegion region;
    Rectangle box;
    double size = 0.0;
    double deviation = 0.0;
    double slack = 0.0;  ///< eight times the deviation, and rounding
    Instance filled;
    Ring corners;
    Instance triangle;
    double gap = INFINITY;  ///< between the ends of edges and the other boundary
    bool crosses = false;   ///< the boundaries
    bool narrow = false;    ///< the region has a narrow tip
};

class FilledShapes : public QueryTest {
protected:
    /// Calls `check` for random pairs whose region is not empty. Always the same ones: among
    /// thousands some have tips that the deviation shortens by more than the slack.
    template <class Check>
    static void for_each_pair(int count, const Check& check) {
        int checked = 0;
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
            SCOPED_TRACE("case " + std::to_string(i));
            Random random(seed + i);
            const FilledPair pair(context(), random, i);
            if (pair.size == 0.0) {
                continue;
            }
            if (!pair.narrow) {
                check(pair);
                ++checked;
            }
            EXPECT_TRUE(context().remove_shape(pair.filled.shape).ok());
            EXPECT_TRUE(context().remove_shape(pair.triangle.shape).ok());
            if (HasFailure()) {
                return;
            }
        }
        EXPECT_GT(checked, count / 4);
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
    for_each_pair(60, [&](const FilledPair& pair) {
        inner += pair.region.inner_edges().size();
        for (const Technique technique : techniques) {
            SCOPED_TRACE(to_string(technique));
            DistanceFieldQuery query;
            query.b = pair.filled;
            query.tolerance = pair.size / 40.0;
            query.rectangle = pair.box;
            const DistanceFieldResult field = ask(query, technique);
            for (std::size_t i = 0; i < field.values.size(); ++i) {
                const double column = static_cast<double>(i % field.width) + 0.5;
                const double row = static_cast<double>(i / field.width) + 0.5;
                const Vector2 at{field.origin.x + column * field.cell,
                                 field.origin.y + row * field.cell};
                ASSERT_NEAR(static_cast<double>(field.values[i]), pair.region.signed_distance(at),
                            field.error_bound * (1 + 1e-6) + pair.slack)
                    << at.x << ", " << at.y;
            }
        }
    });
    EXPECT_GT(inner, 100U);
}

TEST_F(FilledShapes, PointsAreAsDeepAsInTheRegion) {
    std::size_t records = 0;
    for_each_pair(120, [&](const FilledPair& pair) {
        for (const Technique technique : techniques) {
            SCOPED_TRACE(to_string(technique));
            const PenetrationResult found =
                ask(PenetrationQuery{pair.triangle, pair.filled, pair.size / 40.0}, technique);
            for (const PenetrationRecord& record : found.records) {
                ASSERT_NEAR(record.depth, -pair.region.signed_distance(record.point), pair.slack);
            }
            records += found.records.size();
            // No point of an edge inside the region is a point of its boundary.
            const PenetrationResult own =
                ask(PenetrationQuery{pair.filled, pair.triangle, pair.size / 40.0}, technique);
            for (const PenetrationRecord& record : own.records) {
                ASSERT_LE(pair.region.distance(record.point), pair.slack);
            }
            const ContactResult contacts =
                ask(ContactQuery{pair.triangle, pair.filled, pair.size / 40.0, pair.size / 20.0},
                    technique);
            for (const ContactRecord& contact : contacts.records) {
                const Vector2& on_filled = contact.on == Side::a ? contact.nearest : contact.point;
                ASSERT_LE(pair.region.distance(on_filled), pair.slack);
                if (contact.on == Side::a) {
                    ASSERT_NEAR(contact.distance, pair.region.distance(contact.point), pair.slack);
                }
            }
        }
    });
    EXPECT_GT(records, 1000U);
}

TEST_F(FilledShapes, PairsAreAsFarApartAsTheRegionIs) {
    int inside = 0;
    int apart = 0;
    for_each_pair(600, [&](const FilledPair& pair) {
        const double bound = 2.0 * pair.slack;
        if (!pair.crosses && pair.gap <= bound) {
            return;  // they touch
        }
        const ShapeOracle triangle(std::vector<Ring>{pair.corners});
        const std::vector<Edge> boundary = pair.region.boundary();
        const bool within = !pair.crosses && pair.region.contains(pair.corners[0]);
        // A ring of the region inside the triangle is a part of it, or one of its holes.
        bool around = false;
        for (const Edge& piece : boundary) {
            around = around || (!pair.crosses && triangle.contains(piece.from));
        }
        const bool meet = pair.crosses || within || around;
        const SeparationResult separation = ask(
            SeparationQuery{pair.triangle, pair.filled, pair.size / 40.0}, Technique::automatic);
        EXPECT_NEAR(separation.distance, meet ? 0.0 : pair.gap, bound);
        EXPECT_LE(separation.error_bound, bound);
        EXPECT_EQ(ask(IntersectionTestQuery{pair.triangle, pair.filled}, Technique::cpu).intersects,
                  meet);
        const ContainmentResult containment =
            ask(ContainmentQuery{pair.triangle, pair.filled}, Technique::cpu);
        EXPECT_EQ(containment.inside, within && !around);
        if (containment.inside) {
            EXPECT_NEAR(containment.clearance, pair.gap, bound);
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
