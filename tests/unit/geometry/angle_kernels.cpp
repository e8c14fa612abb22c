#include <engine/geometry/angle_kernels.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace {

using nearfield::SineCosine;

bool has_bits_of(const SineCosine& one, const SineCosine& other) {
    return std::bit_cast<std::uint64_t>(one.sine) == std::bit_cast<std::uint64_t>(other.sine) &&
           std::bit_cast<std::uint64_t>(one.cosine) == std::bit_cast<std::uint64_t>(other.cosine);
}

/// Angles of all sizes, with those near multiples of an eighth of a turn and near the largest that
/// are reduced in vectors.
std::vector<double> angles_of_all_sizes() {
    std::vector<double> angles{0.0,
                               -0.0,
                               std::numeric_limits<double>::denorm_min(),
                               0x1p20,
                               std::nextafter(0x1p20, 0.0),
                               -0x1p20,
                               1e300};
    for (int i = -40; i <= 40; ++i) {
        const double angle = i * std::numbers::pi / 4;
        angles.insert(angles.end(),
                      {angle, std::nextafter(angle, -9e9), std::nextafter(angle, 9e9)});
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-60.0, 30.0);
    for (int i = 0; i < 20000; ++i) {
        angles.push_back((i % 2 == 0 ? 1.0 : -1.0) * std::exp2(exponent(random)));
    }
    return angles;
}

TEST(AngleKernels, AreTheFunctionOfOneAngleOnEveryInstructionSet) {
    const std::vector<double> angles = angles_of_all_sizes();
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        hwy::SetSupportedTargetsForTest(left & ~(left - 1));
        hwy::GetChosenTarget().DeInit();
        std::vector<SineCosine> turns(angles.size());
        nearfield::geometry::kernels::find_sines_cosines(angles, turns);
        for (std::size_t i = 0; i < angles.size(); ++i) {
            ASSERT_TRUE(has_bits_of(turns[i], nearfield::sine_cosine(angles[i]))) << angles[i];
        }
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().DeInit();
    }
}

TEST(AngleKernels, WriteAsManyAsAreAsked) {
    const std::vector<double> angles(20, 1.0);
    for (std::size_t count = 0; count <= angles.size(); ++count) {
        std::vector<SineCosine> turns(angles.size() + 1, SineCosine{7.0, 7.0});
        nearfield::geometry::kernels::find_sines_cosines(std::span(angles).first(count), turns);
        for (std::size_t i = 0; i < turns.size(); ++i) {
            const SineCosine expected = i < count ? nearfield::sine_cosine(1.0) : SineCosine{7, 7};
            EXPECT_TRUE(has_bits_of(turns[i], expected)) << count << " " << i;
        }
    }
}

}  // namespace
