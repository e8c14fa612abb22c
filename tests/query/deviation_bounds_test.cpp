#include <tests/query/query_test.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::test {
namespace {

struct Circle {
    Vector2 centre;
    double radius = 0.0;
};

/// Largest distances of the rings from the circles that they stand for, in world units.
struct Deviations {
    double a = 0.0;
    double b = 0.0;
};

constexpr double d = 0.2;
/// Rounding of an answer in double precision.
constexpr double rounding = 1e-12;
/// Off by what the polygons for the offset circles leave open.
constexpr double slack = 1e-5;
constexpr std::uint32_t corners = 2048;

/// A circle smaller than the one it stands for by the deviation all the way round, or larger: what
/// moves every distance by as much as the deviation allows.
Rings offset_circle(const Circle& circle, double deviation, bool larger) {
    const double radius = larger
                              ? circle.radius + deviation
                              : (circle.radius - deviation) / std::cos(std::numbers::pi / corners);
    Ring ring;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / corners;
        ring.push_back({circle.centre.x + radius * std::cos(angle),
                        circle.centre.y + radius * std::sin(angle)});
    }
    return {ring};
}

/// Circles with rings that deviate from them as far as they may, by different amounts.
class DeviationBounds : public QueryTest {
protected:
    /// Calls `check(deviations)` for all pairs, with shapes for the circles.
    template <class Check>
    void for_each_pair(const Circle& a, const Circle& b, bool larger, const Check& check) {
        for (const Deviations& of : {Deviations{0.2 * d, 0.04 * d}, Deviations{0.04 * d, 0.2 * d},
                                     Deviations{0.25 * d, 0.0}, Deviations{0.0, 0.25 * d}}) {
            SCOPED_TRACE(testing::Message() << "A is off by " << of.a << ", B by " << of.b);
            a_ = {*context().add_shape(offset_circle(a, of.a, larger), of.a), {}};
            b_ = {*context().add_shape(offset_circle(b, of.b, larger), of.b), {}};
            check(of);
            EXPECT_TRUE(context().remove_shape(a_.shape).ok());
            EXPECT_TRUE(context().remove_shape(b_.shape).ok());
        }
    }

    template <class Query>
    static typename Query::Result ask(Query query, Technique technique) {
        query.technique = technique;
        const auto result = run_alone(context(), query);
        EXPECT_TRUE(result.status.ok()) << to_string(technique) << ": " << result.status.text();
        return result;
    }

    Instance a_;
    Instance b_;
};

const Circle left{{-2.0, 0.5}, 1.5};
const Circle right{{2.0, 0.5}, 2.0};  // 0.5 apart
constexpr double gap = 0.5;

TEST_F(DeviationBounds, DistancesAreOffByBothDeviationsAndTheBoundSaysSo) {
    for_each_pair(left, right, false, [&](const Deviations& of) {
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            const SeparationResult separation = ask(SeparationQuery{a_, b_, d}, technique);
            EXPECT_NEAR(separation.distance, gap + of.a + of.b, slack);
            EXPECT_LE(std::abs(separation.distance - gap), separation.error_bound + slack);
            EXPECT_NEAR(separation.error_bound, of.a + of.b, rounding);
            const ClosestPointResult closest = ask(ClosestPointQuery{a_, b_, d}, technique);
            EXPECT_NEAR(closest.distance, gap + of.a + of.b, slack);
            EXPECT_LE(std::abs(closest.distance - gap), closest.error_bound + slack);
            EXPECT_NEAR(closest.error_bound, of.a + of.b, rounding);
        }
    });
}

TEST_F(DeviationBounds, OfShapesThatIntersectTheBoundIsTheSame) {
    const Circle near{{0.0, 0.5}, 1.5};
    for_each_pair(near, right, false, [&](const Deviations& of) {
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            EXPECT_NEAR(ask(SeparationQuery{a_, b_, d}, technique).error_bound, of.a + of.b,
                        rounding);
        }
    });
}

TEST_F(DeviationBounds, CirclesThatAreNoFartherApartMayBeReportedAsIntersecting) {
    for (const double part : {0.9, 1.1}) {
        for_each_pair(left, right, true, [&](const Deviations& of) {
            // So that the circles are this far apart.
            const double apart = part * (of.a + of.b);
            a_.pose.translation.x = gap - apart;
            const auto result = ask(IntersectionTestQuery{a_, b_}, Technique::cpu);
            EXPECT_EQ(result.intersects, part < 1.0);
            EXPECT_NEAR(result.error_bound, of.a + of.b, rounding);
        });
    }
}

TEST_F(DeviationBounds, TimesOfImpactTouchCirclesThatAreThatFarApart) {
    for_each_pair(left, right, true, [&](const Deviations& of) {
        TimeOfImpactQuery query{a_, b_, {{1.0, 0.0}, 0.0}, {}, d};
        query.time_bound = 1e-9;
        TimeOfImpactResult result = ask(query, Technique::cpu);
        ASSERT_EQ(result.state, ImpactState::hit);
        EXPECT_NEAR(result.time, gap - of.a - of.b, slack);
        EXPECT_LE(gap - result.time, result.error_bound + slack);
        EXPECT_NEAR(result.error_bound, of.a + of.b, rounding);
        query.contact_distance = 0.2;
        result = ask(query, Technique::cpu);
        ASSERT_EQ(result.state, ImpactState::hit);
        EXPECT_LE(gap - result.time - query.contact_distance, result.error_bound + slack);
        EXPECT_NEAR(result.error_bound, of.a + of.b, rounding);
    });
}

TEST_F(DeviationBounds, SeparationVectorsLeaveCirclesThatDeepInEachOther) {
    const Circle near{{0.0, 0.5}, 1.5};
    for_each_pair(near, right, false, [&](const Deviations& of) {
        // The way that the circles themselves have to go.
        constexpr double depth = 1.5 + 2.0 - 2.0;
        SeparationVectorQuery query{a_, b_, d};
        query.max_work = 100'000;
        const SeparationVectorResult result = ask(query, Technique::cpu);
        ASSERT_TRUE(result.intersects);
        EXPECT_LE(result.lower_bound, depth - of.a - of.b + slack);
        EXPECT_GE(result.length, depth - of.a - of.b - slack);
        EXPECT_NEAR(result.error_bound, of.a + of.b, rounding);
    });
}

TEST_F(DeviationBounds, ClearanceIsOffByBothDeviationsAndTheBoundSaysSo) {
    const Circle small{{1.0, 0.5}, 0.7};  // 1 from the centre of B
    constexpr double clearance = 2.0 - 1.0 - 0.7;
    for_each_pair(small, right, false, [&](const Deviations& of) {
        const ContainmentResult result = ask(ContainmentQuery{a_, b_}, Technique::cpu);
        EXPECT_TRUE(result.inside);
        EXPECT_NEAR(result.clearance, clearance + of.a - of.b, slack);
        EXPECT_LE(std::abs(result.clearance - clearance), result.error_bound + slack);
        EXPECT_NEAR(result.error_bound, of.a + of.b, rounding);
    });
}

TEST_F(DeviationBounds, PenetrationIsOffByBothDeviationsAndTheBoundSaysSo) {
    const Circle small{{1.0, 0.5}, 0.7};  // its deepest point is 1 - 0.7 from the centre of B
    constexpr double depth = 2.0 - 0.3;
    for_each_pair(small, right, false, [&](const Deviations& of) {
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            PenetrationQuery query{a_, b_, d, PenetrationPoints::vertices};
            PenetrationResult result = ask(query, technique);
            EXPECT_NEAR(result.deepest.depth, depth - of.a - of.b, slack);
            EXPECT_LE(std::abs(result.deepest.depth - depth), result.error_bound);
            EXPECT_NEAR(result.error_bound, d / 1024.0 + of.a + of.b, rounding);
            query.points = PenetrationPoints::boundary;
            result = ask(query, technique);
            EXPECT_LE(std::abs(result.deepest.depth - depth), result.error_bound);
            EXPECT_NEAR(result.error_bound,
                        d * (std::numbers::sqrt2 / 2.0 + 1.0 / 1024.0) + of.a + of.b, rounding);
        }
    });
}

TEST_F(DeviationBounds, ContactsOfTheCirclesHaveARecordWithinTheBound) {
    for_each_pair(left, right, false, [&](const Deviations& of) {
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            ContactQuery query{a_, b_, d};
            const double bound = d * (std::numbers::sqrt2 / 2.0 + 1.0 / 1024.0) + of.a + of.b;
            query.contact_distance = gap + bound;
            const ContactResult result = ask(query, technique);
            EXPECT_NEAR(result.error_bound, bound, rounding);
            // The nearest points of the circles are as near as the law promises records for.
            for (const auto& [side, x] : {std::pair(Side::a, -0.5), std::pair(Side::b, 0.0)}) {
                bool found = false;
                for (const ContactPoint& record : result.points) {
                    found = found ||
                            (record.on == side &&
                             std::hypot(record.position.x - x, record.position.y - 0.5) <= bound);
                }
                EXPECT_TRUE(found) << (side == Side::a ? "on A" : "on B");
            }
        }
    });
}

TEST_F(DeviationBounds, FieldsAreOffByTheDeviationOfBAlone) {
    const Circle far{{-9.0, 0.0}, 1.0};
    for_each_pair(far, right, false, [&](const Deviations& of) {
        if (of.b > 0.24 * d) {
            return;  // more than the coarsest raster allows a field
        }
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            DistanceFieldQuery query{{}, b_, d, Rectangle{{0.0, -2.0}, {4.5, 3.0}}};
            query.features = true;
            const DistanceFieldResult result = ask(query, technique);
            double off = 0.0;
            for (std::uint32_t i = 0; i < result.values.size(); ++i) {
                const double x = result.origin.x + (i % result.width + 0.5) * result.cell;
                const double y = result.origin.y + (i / result.width + 0.5) * result.cell;
                const double truth = std::hypot(x - right.centre.x, y - right.centre.y) - 2.0;
                off = std::max(off, std::abs(static_cast<double>(result.values[i]) - truth));
            }
            EXPECT_LE(off, result.error_bound);
            EXPECT_GE(off, 0.9 * of.b);
            EXPECT_GE(result.error_bound, of.b + d / 1024.0);
            if (technique == Technique::cpu) {
                EXPECT_NEAR(result.error_bound, of.b + d / 1024.0, 1e-4 * d);
            }
        }
    });
}

}  // namespace
}  // namespace nearfield::test
