#include <engine/geometry/segment.hpp>
#include <engine/simd/neighbour_kernels.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tests/unit/support/shape_samples.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace nearfield::simd {
namespace {

using geometry::NearestOnSegment;
using geometry::Vector;

/// Points beside chains of three edges, some of which have no length.
struct Chains {
    static constexpr std::uint32_t count = 101;
    using Numbers = std::vector<double>;

    std::array<Numbers, 4> x;
    std::array<Numbers, 4> y;
    Numbers point_x = Numbers(padded(count));
    Numbers point_y = Numbers(padded(count));

    explicit Chains(test::Random& random) {
        x.fill(Numbers(padded(count)));
        y.fill(Numbers(padded(count)));
        for (std::uint32_t i = 0; i < count; ++i) {
            point_x[i] = random.between(-1.0, 1.0);
            point_y[i] = random.between(-1.0, 1.0);
            for (std::size_t k = 0; k < 4; ++k) {
                const bool repeats = k > 0 && random.between(0.0, 1.0) < 0.1;
                x[k][i] = repeats ? x[k - 1][i] : random.between(-1.0, 1.0);
                y[k][i] = repeats ? y[k - 1][i] : random.between(-1.0, 1.0);
            }
        }
    }

    [[nodiscard]] NearestOnSegment nearest(std::uint32_t i, std::size_t edge) const {
        return geometry::nearest_on_segment({point_x[i], point_y[i]}, {x[edge][i], y[edge][i]},
                                            {x[edge + 1][i], y[edge + 1][i]});
    }
};

void expect_nearest(const Chains& chains, bool with_neighbours) {
    std::array<std::vector<double>, 5> found;
    found.fill(std::vector<double>(padded(Chains::count)));
    NeighbourArrays edges;
    for (std::size_t k = 0; k < 4; ++k) {
        edges.x[k] = chains.x[k].data();
        edges.y[k] = chains.y[k].data();
    }
    kernels::find_nearest_of_neighbours(
        {Chains::count, chains.point_x.data(), chains.point_y.data()}, edges, with_neighbours,
        {found[0].data(), found[1].data(), found[2].data(), found[3].data(), found[4].data()});
    for (std::uint32_t i = 0; i < Chains::count; ++i) {
        NearestOnSegment nearest = chains.nearest(i, 1);
        double edge = 0.0;
        for (const std::size_t other : {0U, 2U}) {
            const NearestOnSegment on_other = chains.nearest(i, other);
            if (with_neighbours && on_other.squared_distance < nearest.squared_distance) {
                nearest = on_other;
                edge = static_cast<double>(other) - 1.0;
            }
        }
        EXPECT_EQ(found[0][i], nearest.point.x()) << i;
        EXPECT_EQ(found[1][i], nearest.point.y()) << i;
        EXPECT_EQ(found[2][i], std::sqrt(nearest.squared_distance)) << i;
        EXPECT_EQ(found[3][i], nearest.parameter) << i;
        EXPECT_EQ(found[4][i], edge) << i;
    }
}

TEST(NeighbourKernels, SayWhatOneByOneSaysOnEveryInstructionSet) {
    test::Random random(7);
    const Chains chains(random);
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        const std::int64_t target = left & ~(left - 1);
        SCOPED_TRACE(target);
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().DeInit();
        expect_nearest(chains, false);
        expect_nearest(chains, true);
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().DeInit();
    }
}

}  // namespace
}  // namespace nearfield::simd
