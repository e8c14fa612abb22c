#include <engine/narrowphase/boundary.hpp>
#include <engine/solvers/field_cells.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tests/support/polygons.hpp>

#include <cmath>
#include <vector>

namespace nearfield::solvers {
namespace {

constexpr std::uint64_t field_seed = 271;

/// Restores the machine's instruction sets.
class Targets : public testing::Test {
protected:
    void TearDown() override {
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }

    /// Calls `check()` with every instruction set that the machine supports and the code was
    /// compiled for.
    template <class Check>
    static void for_each(const Check& check) {
        hwy::SetSupportedTargetsForTest(0);
        const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
        EXPECT_FALSE(targets.empty());
        for (const std::int64_t target : targets) {
            SCOPED_TRACE(hwy::TargetName(target));
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().Update(target);
            check();
        }
    }
};

struct Solved {
    std::vector<float> distances;
    std::vector<std::uint32_t> nearest;
};

Solved solve(const geometry::TransformedPolygon& polygon, const FieldGrid& grid) {
    const std::size_t cells = std::size_t{grid.width} * grid.height;
    Solved solved{std::vector<float>(cells), std::vector<std::uint32_t>(cells)};
    CellSolver solver;
    solver.solve(polygon, {}, grid, {solved.distances, solved.nearest, 1.0, 7e-4});
    return solved;
}

void check_by_boundary(const Solved& solved, const geometry::TransformedPolygon& polygon,
                       const FieldGrid& grid) {
    narrowphase::Boundary boundary;
    boundary.set(polygon);
    for (std::uint32_t i = 0; i < solved.distances.size(); ++i) {
        const std::uint32_t row = i / grid.width;
        const geometry::Vector centre =
            grid.origin + grid.cell * geometry::Vector(i % grid.width + 0.5, row + 0.5);
        const double exact =
            std::sqrt(boundary.nearest(centre).on_edge.squared_distance) / grid.cell;
        const double bound = 0x1p-12 + CellSolver::relative_rounding * exact;
        ASSERT_NEAR(static_cast<double>(std::abs(solved.distances[i])), exact, bound) << i;
        const bool inside = (solved.nearest[i] & nearest_inside) != 0;
        ASSERT_EQ(std::signbit(solved.distances[i]), inside) << i;
        ASSERT_TRUE(inside == boundary.contains(centre) || exact < bound) << i;
        const std::uint32_t edge = solved.nearest[i] & ~(nearest_inside | nearest_unique);
        ASSERT_LT(edge, polygon.polygon().size());
        const double named =
            std::sqrt(geometry::nearest_on_segment(centre, polygon.vertex(edge),
                                                   polygon.vertex(polygon.polygon().next(edge)))
                          .squared_distance) /
            grid.cell;
        ASSERT_NEAR(named, exact, 2.0 * bound) << i;
    }
}

TEST_F(Targets, AllGiveTheDistancesOfTheExactBoundary) {
    test::Random random(field_seed);
    geometry::Polygon shape;
    ASSERT_TRUE(shape.assign(test::star(random, 300, 0.5)).ok());
    const geometry::TransformedPolygon polygon(shape, {{3e5, -2e5}, 0.7});
    // Not a whole number of blocks or squares, and partly outside.
    const FieldGrid grid{polygon.translation() - geometry::Vector(1.3, 0.9), 0.02, 133, 71};
    for_each([&] { check_by_boundary(solve(polygon, grid), polygon, grid); });
}

/// Millions of cells away, where single precision cannot tell edges apart that are cells apart.
TEST_F(Targets, AllGiveTheDistancesFarFromTheBoundary) {
    test::Random random(field_seed);
    for (const double cell : {0x1p-16, 0x1p-19, 0x1p-22, 0x1p-24}) {
        SCOPED_TRACE(cell);
        geometry::Polygon shape;
        ASSERT_TRUE(shape.assign(test::star(random, 300, 0.99999)).ok());
        const geometry::TransformedPolygon polygon(shape, {{0.3, -0.2}, 0.7});
        const FieldGrid grid{polygon.translation() - 30.0 * cell * geometry::Vector(1.0, 1.0), cell,
                             67, 43};
        for_each([&] { check_by_boundary(solve(polygon, grid), polygon, grid); });
    }
}

/// Edges much shorter than cells, smooth and rough, so that runs of edges are tested.
TEST_F(Targets, AllGiveTheDistancesOfManyShortEdges) {
    test::Random random(field_seed);
    for (const double min_radius : {0.999, 0.95, 0.3}) {
        SCOPED_TRACE(min_radius);
        geometry::Polygon shape;
        ASSERT_TRUE(shape.assign(test::star(random, 6001, min_radius)).ok());
        const geometry::TransformedPolygon polygon(shape, {{3e3, -2e3}, 0.7});
        const FieldGrid grid{polygon.translation() - geometry::Vector(1.3, 0.9), 0.04, 67, 43};
        for_each([&] { check_by_boundary(solve(polygon, grid), polygon, grid); });
    }
}

/// A square whose sides are divided into `edges_a_side` edges.
std::vector<Ring> square_of(int edges_a_side) {
    Ring ring;
    const std::vector<Vector2> corners{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}};
    for (std::size_t side = 0; side < 4; ++side) {
        const Vector2 from = corners[side];
        const Vector2 to = corners[(side + 1) % 4];
        for (int i = 0; i < edges_a_side; ++i) {
            const double t = static_cast<double>(i) / edges_a_side;
            ring.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
        }
    }
    return {ring};
}

class SquareField : public Targets, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(OfEdgesASide, SquareField, testing::Values(1, 64, 1000));

TEST_P(SquareField, AllFlagWhatIsNotUnique) {
    geometry::Polygon square;
    ASSERT_TRUE(square.assign(square_of(GetParam())).ok());
    const geometry::TransformedPolygon polygon(square, {});
    const FieldGrid grid{{-12.5, -12.5}, 1.0, 25, 25};
    for_each([&] {
        const Solved solved = solve(polygon, grid);
        for (int row = 0; row < 25; ++row) {
            for (int column = 0; column < 25; ++column) {
                const int x = column - 12;
                const int y = row - 12;
                // Inside, on the diagonals, two walls are equally near; at a corner both give the
                // same point.
                const bool two = std::abs(x) == std::abs(y) && std::abs(x) < 8;
                const auto word = solved.nearest[static_cast<std::size_t>(25 * row + column)];
                ASSERT_EQ((word & nearest_unique) == 0, two) << x << ", " << y;
            }
        }
    });
}

}  // namespace
}  // namespace nearfield::solvers
