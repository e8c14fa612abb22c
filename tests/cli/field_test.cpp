#include "cli_test.hpp"
#include "contract.hpp"
#include "file_formats.hpp"
#include "rectangle_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

namespace nearfield::test {
namespace {

using SignedDistance = std::function<double(Point)>;

class Field : public CliTest {
protected:
    /// Requests a field at tolerance 0.05 and compares all its cells with the true distances.
    Json ask(const Arguments& query, const SignedDistance& truth) {
        const Json json =
            answer(query + Arguments{"-d", "0.05", "--field", folder_.path("field of b.npy")});
        if (json.is_object()) {
            expect_grid(json);
            array_ = parse_npy(folder_.read("field of b.npy"));
            EXPECT_EQ(array_.columns, json.at("width").get<std::size_t>());
            EXPECT_EQ(array_.rows, json.at("height").get<std::size_t>());
            expect_values(json, truth);
        }
        return json;
    }

    static constexpr double d = 0.05;
    static constexpr double cell = d * std::numbers::sqrt2;

private:
    static void expect_grid(const Json& json) {
        expect_common_part(json, "distance-field", d, cell);
        EXPECT_NEAR(json.at("cell").get<double>(), cell, 1e-12);
        EXPECT_TRUE(json.at("width").is_number_unsigned());
        EXPECT_TRUE(json.at("height").is_number_unsigned());
    }

    void expect_values(const Json& json, const SignedDistance& truth) const {
        const Point origin = to_point(json.at("origin"));
        const double bound = json.at("error_bound").get<double>();
        int worse = 0;
        for (std::size_t row = 0; row < array_.rows; ++row) {
            for (std::size_t column = 0; column < array_.columns; ++column) {
                const double value = double{array_.values[row * array_.columns + column]};
                const Point centre{origin.x + (static_cast<double>(column) + 0.5) * cell,
                                   origin.y + (static_cast<double>(row) + 0.5) * cell};
                const double exact = truth(centre);
                const bool right = std::abs(value - exact) <= bound * (1.0 + 1e-6) &&
                                   (std::abs(exact) <= bound || (value < 0.0) == (exact < 0.0));
                if (!right && ++worse <= 10) {
                    ADD_FAILURE() << "column " << column << ", row " << row << ": " << value
                                  << " instead of " << exact;
                }
            }
        }
        EXPECT_EQ(worse, 0) << "cells beyond the error bound " << bound;
    }

    FloatArray array_;
};

/// Expects the minimum number of cells that cover a length.
void expect_covers(const Json& count, double length, double cell) {
    EXPECT_GE(count.get<double>() * cell, length - 1e-9);
    EXPECT_LT((count.get<double>() - 1.0) * cell, length + 1e-9);
}

TEST_F(Field, CoversTheCommonBoxGrownByTheTolerance) {
    const Rectangle b = unit_square_at({0.6, 0.3});
    const Json json = ask(squares("distance-field") + Arguments{"--pose-b", "0.6,0.3,0"},
                          [&](Point p) { return b.signed_distance(p); });
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), true);
    const Point origin = to_point(json.at("origin"));
    EXPECT_NEAR(origin.x, 0.6 - d, 1e-12);
    EXPECT_NEAR(origin.y, 0.3 - d, 1e-12);
    expect_covers(json.at("width"), 0.4 + 2.0 * d, cell);
    expect_covers(json.at("height"), 0.7 + 2.0 * d, cell);
}

/// The boxes of A and B may be disjoint: only the rectangle determines the covered area.
TEST_F(Field, CoversTheRectangleAsked) {
    const Rectangle b = unit_square_at({-5.0, 2.0});
    const Json json = ask(squares("distance-field") +
                              Arguments{"--pose-b", "-5,2,0", "--rect", "-5.7,-0.25,-1.5,3.3"},
                          [&](Point p) { return b.signed_distance(p); });
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), false);
    const Point origin = to_point(json.at("origin"));
    EXPECT_EQ(origin.x, -5.7);
    EXPECT_EQ(origin.y, -0.25);
    expect_covers(json.at("width"), 4.2, cell);
    expect_covers(json.at("height"), 3.55, cell);
}

TEST_F(Field, IsPositiveInHolesAndNegativeInParts) {
    const std::string parts =
        folder_.write("parts.wkt",
                      "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 3, 3 3, 3 1, 1 1)), "
                      "((6 1, 7 1, 7 3, 6 3, 6 1)))");
    const Rectangle outer{{0, 0}, {4, 4}};
    const Rectangle hole{{1, 1}, {3, 3}};
    const Rectangle part{{6, 1}, {7, 3}};
    const auto truth = [&](Point p) {
        const double first = std::max(outer.signed_distance(p), -hole.signed_distance(p));
        return std::min(first, part.signed_distance(p));
    };
    const Json json = ask({"query", "distance-field", a_, parts, "--rect", "-1,-1,8,5"}, truth);
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), true);
}

/// Wider than any device's images: the field is computed in slabs without a visible seam.
TEST_F(Field, IsWorkedOffInSlabs) {
    const Rectangle b = unit_square_at({2799.0, 0.0});
    const Json json = ask(
        squares("distance-field") + Arguments{"--pose-b", "2799,0,0", "--rect", "0,-0.1,2800,0.1"},
        [&](Point p) { return b.signed_distance(p); });
    ASSERT_TRUE(json.is_object());
    EXPECT_GT(json.at("width").get<int>(), 32768);
}

TEST_F(Field, WithoutAFileOnlyTheGridIsTold) {
    const auto before = folder_.contents();
    const Json json = answer(squares("distance-field") + Arguments{"-d", "0.05"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("width"), 16);  // (1 + 2 d) / cell = 15.6
    EXPECT_EQ(folder_.contents(), before);
}

}  // namespace
}  // namespace nearfield::test
