#include <tests/query/query_test.hpp>

#include <algorithm>

namespace nearfield::test {
namespace {

constexpr double tolerance = 0.125;
constexpr double touching_depth = tolerance / 1024.0;

/// A bar that reaches into a square by a little.
class Touching : public QueryTest {
protected:
    static PenetrationResult penetration(PenetrationPoints points, Technique technique) {
        return run_alone(context(), PenetrationQuery{.a = {bar_, {}},
                                                     .b = {square_, {}},
                                                     .tolerance = tolerance,
                                                     .points = points,
                                                     .technique = technique});
    }

    static ContactResult contacts(Technique technique) {
        return run_alone(context(), ContactQuery{.a = {bar_, {}},
                                                 .b = {square_, {}},
                                                 .tolerance = tolerance,
                                                 .contact_distance = tolerance,
                                                 .technique = technique});
    }

    static void check(double depth) {
        SCOPED_TRACE(depth / tolerance);
        bar_ = *context().add_shape(rectangle({-1.0, 0.4}, {depth, 0.6}));
        square_ = *context().add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        const bool penetrates = depth > touching_depth;
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            for (const PenetrationPoints points :
                 {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
                const PenetrationResult result = penetration(points, technique);
                EXPECT_TRUE(result.intersects);
                EXPECT_EQ(result.count > 0, penetrates);
                EXPECT_EQ(result.count, result.points.size());
            }
            const ContactResult found = contacts(technique);
            EXPECT_TRUE(found.intersects);
            EXPECT_GT(found.count, 0U);
            const auto inside = std::count_if(found.points.begin(), found.points.end(),
                                              [](const auto& record) { return record.inside; });
            EXPECT_EQ(inside > 0, penetrates);
            for (const ContactPoint& record : found.points) {
                if (record.on == Side::a && record.position.x == depth) {
                    EXPECT_EQ(record.normal.x, -1.0) << "the normal has the side of the point";
                }
            }
        }
        ASSERT_TRUE(context().remove_shape(bar_).ok());
        ASSERT_TRUE(context().remove_shape(square_).ok());
    }

private:
    static inline ShapeHandle bar_;
    static inline ShapeHandle square_;
};

TEST_F(Touching, EndsAtTheSameDepthByEveryTechnique) {
    for (const double depth : {1e-12, 1e-7, 3e-5, 9e-4, 9.7e-4, 9.8e-4, 1e-3, 2e-3, 1e-2}) {
        check(depth * tolerance);
    }
}

TEST_F(Touching, IsAllThatNearlyCoincidentShapesDo) {
    Random random(21);
    for (int i = 0; i < 20; ++i) {
        const Rings rings = star(random, 12, 0.5);
        const ShapeHandle shape = *context().add_shape(rings);
        const double off = random.scale(1e-12, 5e-4) * tolerance;
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            const PenetrationResult result =
                run_alone(context(), PenetrationQuery{.a = {shape, {{off, off}, 0.0}},
                                                      .b = {shape, {}},
                                                      .tolerance = tolerance,
                                                      .technique = technique});
            EXPECT_EQ(result.count, 0U) << off;
            EXPECT_TRUE(result.intersects);
        }
        ASSERT_TRUE(context().remove_shape(shape).ok());
    }
}

}  // namespace
}  // namespace nearfield::test
