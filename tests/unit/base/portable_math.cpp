#include <nearfield/portable_math.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace nearfield {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "the reference must be finer");

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Integers alone, so that the cases are the same everywhere.
class Bits {
public:
    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15;
        std::uint64_t z = state_;
        z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9;
        z = (z ^ z >> 27U) * 0x94D049BB133111EB;
        return z ^ z >> 31U;
    }
    /// A finite number of any size and sign.
    double number() {
        for (;;) {
            if (const double any = std::bit_cast<double>(next()); std::isfinite(any)) {
                return any;
            }
        }
    }
    /// Between -1 and 1.
    double fraction() {
        return static_cast<double>(static_cast<std::int64_t>(next() >> 11U)) * 0x1p-52 - 1.0;
    }

private:
    std::uint64_t state_ = 7;
};

/// The error of a result in units in its last place.
double error_in_units(double result, long double truth) {
    const double magnitude = std::abs(static_cast<double>(truth));
    const double unit = std::max(std::nextafter(magnitude, infinity) - magnitude,
                                 std::numeric_limits<double>::denorm_min());
    return static_cast<double>(std::abs(static_cast<long double>(result) - truth) / unit);
}

void expect_exact(double angle) {
    const SineCosine found = sine_cosine(angle);
    ASSERT_LT(error_in_units(found.sine, std::sin(static_cast<long double>(angle))), 0.9) << angle;
    ASSERT_LT(error_in_units(found.cosine, std::cos(static_cast<long double>(angle))), 0.9)
        << angle;
}

TEST(PortableMath, SinesAreExactAtAnglesOfAnySize) {
    Bits bits;
    for (int i = 0; i < 300'000; ++i) {
        expect_exact(bits.number());
        expect_exact(bits.fraction() * 0.8);
        expect_exact(bits.fraction() * 7.0);
        expect_exact(bits.fraction() * 0x1p20);
    }
    for (const double angle : {0.0, -0.0, 0x1p20, 0x1p-1074, 6381956970095103.0 * 0x1p797,
                               std::numeric_limits<double>::max()}) {
        expect_exact(angle);
        expect_exact(std::nextafter(angle, 0.0));
    }
}

TEST(PortableMath, SinesAreExactNextToQuarterTurns) {
    for (std::uint32_t i = 0; i < 200'000; ++i) {
        const long double turns = i < 100'000 ? i : i * 16'777'259.0L;
        const auto angle = static_cast<double>(turns * (std::numbers::pi_v<long double> / 2));
        expect_exact(angle);
        expect_exact(-angle);
        expect_exact(std::nextafter(angle, infinity));
        expect_exact(std::nextafter(angle, 0.0));
    }
}

TEST(PortableMath, SinesOfWhatIsNotFiniteAreNoNumbers) {
    for (const double angle : {infinity, -infinity, std::nan("")}) {
        EXPECT_TRUE(std::isnan(sine_cosine(angle).sine)) << angle;
        EXPECT_TRUE(std::isnan(sine_cosine(angle).cosine)) << angle;
        EXPECT_TRUE(std::isnan(arc_tangent(angle, 1.0))) << angle;
        EXPECT_TRUE(std::isnan(arc_tangent(1.0, angle))) << angle;
    }
}

TEST(PortableMath, ArcTangentsAreExactInAllDirections) {
    Bits bits;
    const auto expect = [](double y, double x) {
        const long double truth =
            std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        if (std::abs(truth) > std::numeric_limits<double>::min()) {
            ASSERT_LT(error_in_units(arc_tangent(y, x), truth), 4.0) << y << ", " << x;
        }
    };
    for (int i = 0; i < 300'000; ++i) {
        expect(bits.fraction(), bits.fraction());
        expect(bits.fraction(), bits.fraction() * 1e-3);
        expect(bits.number(), bits.number());
        const double same = bits.fraction();
        expect(same, same);
        expect(std::nextafter(same, infinity), -same);
    }
    for (const double zero : {0.0, -0.0}) {
        expect(zero, 1.0);
        expect(1.0, zero);
        EXPECT_EQ(arc_tangent(zero, -1.0), std::copysign(std::numbers::pi, zero));
        EXPECT_EQ(arc_tangent(zero, 0.0), zero);
    }
}

/// The bits themselves: a compiler that fuses, reorders or keeps more digits changes some.
TEST(PortableMath, HasFixedBits) {
    Bits bits;
    std::uint64_t hash = 0;
    const auto add = [&hash](double number) {
        hash = std::rotl(hash ^ std::bit_cast<std::uint64_t>(number), 23) * 0x9E3779B97F4A7C15;
    };
    for (int i = 0; i < 100'000; ++i) {
        for (const double angle : {bits.number(), bits.fraction() * 7.0}) {
            const SineCosine found = sine_cosine(angle);
            add(found.sine);
            add(found.cosine);
        }
        const double y = bits.fraction();
        add(arc_tangent(y, bits.fraction()));
    }
    EXPECT_EQ(hash, 8469527756211107583U);
}

}  // namespace
}  // namespace nearfield
