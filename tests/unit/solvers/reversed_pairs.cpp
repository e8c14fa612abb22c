#include <engine/queries/error_budget.hpp>
#include <engine/solvers/penetration.hpp>

#include <gtest/gtest.h>
#include <tests/unit/solvers/test_workspace.hpp>
#include <tests/unit/support/shape_samples.hpp>

#include <array>
#include <vector>

namespace nearfield::solvers {
namespace {

using geometry::Polygon;

/// What a query looks for.
struct Asked {
    PenetrationPoints points = PenetrationPoints::boundary;
    bool records = true;
};

PenetrationQuery query_of(const Asked& asked) {
    PenetrationQuery query;
    query.tolerance = 0.02;
    query.points = asked.points;
    query.summary_only = !asked.records;
    return query;
}

/// Answers for A in B and then for B in A, of one batch.
class BothWays {
public:
    BothWays(const Polygon& a, const Polygon& b) : a_(&a), b_(&b) {}

    std::vector<PenetrationResult> answer(const std::array<Asked, 2>& asked,
                                          PenetrationSolver& penetration) {
        std::array<AnyQuery, 2> queries{query_of(asked[0]), query_of(asked[1])};
        std::array<queries::CheckedQuery, 2> checked;
        for (std::size_t i = 0; i < 2; ++i) {
            checked[i].query = &queries[i];
            checked[i].a = i == 0 ? a_ : b_;
            checked[i].b = i == 0 ? b_ : a_;
            checked[i].budget = queries::penetration_budget(query_of(asked[i]));
        }
        TestWorkspace workspace;
        penetration.begin_batch();
        std::vector<PenetrationResult> results(2);
        for (std::size_t i = 0; i < 2; ++i) {
            results[i].tolerance = 0.02;
            results[i].cell = checked[i].budget.cell;
            penetration.answer(checked[i], workspace, results[i]);
            EXPECT_TRUE(results[i].status.ok()) << results[i].status.text();
        }
        return results;
    }

private:
    const Polygon* a_;
    const Polygon* b_;
};

void expect_equal(const PenetrationResult& one, const PenetrationResult& other) {
    EXPECT_EQ(one.intersects, other.intersects);
    EXPECT_EQ(one.count, other.count);
    ASSERT_EQ(one.points.size(), other.points.size());
    for (std::size_t i = 0; i < one.points.size(); ++i) {
        EXPECT_EQ(one.points[i].position, other.points[i].position) << i;
        EXPECT_EQ(one.points[i].depth, other.points[i].depth) << i;
    }
}

/// The way back takes over what the way there has found, as far as that has looked for it.
TEST(ReversedPairs, AreAnsweredAsByThemselvesWhateverTheWayThereWasAskedFor) {
    test::Random random(11);
    const std::vector<test::NamedRings> shapes = samples::assorted_shapes(random);
    std::vector<Asked> asked;
    for (const auto points : {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
        asked.push_back({points, true});
        asked.push_back({points, false});
    }
    std::size_t records = 0;
    PenetrationSolver kept;  // with what the pair before has left in it
    for (std::size_t i = 0; i + 1 < shapes.size(); ++i) {
        SCOPED_TRACE(shapes[i].name + ", " + shapes[i + 1].name);
        const Polygon a = samples::polygon(shapes[i].rings);
        const Polygon b = samples::polygon(shapes[i + 1].rings);
        for (const Asked& there : asked) {
            for (const Asked& back : asked) {
                PenetrationSolver fresh;
                const auto both = BothWays(a, b).answer({there, back}, kept);
                const auto reversed = BothWays(b, a).answer({back, there}, fresh);
                expect_equal(both[1], reversed[0]);
                records += both[1].points.size();
            }
        }
    }
    EXPECT_GT(records, 1000U);
}

}  // namespace
}  // namespace nearfield::solvers
