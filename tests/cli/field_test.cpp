#include "cli_test.hpp"
#include "contract.hpp"
#include "file_formats.hpp"

#include <cstddef>
#include <numbers>

namespace nearfield::test {
namespace {

class Field : public CliTest {
protected:
    /// Requests a field at tolerance 0.05 and reads its file.
    Json ask(const Arguments& query) {
        const Json json =
            answer(query + Arguments{"-d", "0.05", "--field", folder_.path("field of b.npy")});
        if (json.is_object()) {
            expect_common_part(json, "distance-field", d, cell);
            EXPECT_NEAR(json.at("cell").get<double>(), cell, 1e-12);
            array_ = parse_npy(folder_.read("field of b.npy"));
            EXPECT_EQ(array_.columns, json.at("width").get<std::size_t>());
            EXPECT_EQ(array_.rows, json.at("height").get<std::size_t>());
        }
        return json;
    }
    /// The value of the cell at (x, y) is `distance`, within the bound and what the cell's centre
    /// is off by; and it is on the right side.
    void expect_value(const Json& json, double x, double y, double distance) const {
        const double half = 0.5 * std::numbers::sqrt2 * cell;
        const auto index = [&](double at, std::size_t axis) {
            return static_cast<std::size_t>((at - json.at("origin").at(axis).get<double>()) / cell);
        };
        const std::size_t at = index(y, 1) * array_.columns + index(x, 0);
        ASSERT_LT(at, array_.values.size());
        EXPECT_NEAR(array_.values[at], distance, json.at("error_bound").get<double>() + half)
            << "at " << x << ", " << y;
    }

    static constexpr double d = 0.05;
    static constexpr double cell = d * std::numbers::sqrt2;

private:
    FloatArray array_;
};

/// Expects the minimum number of cells that cover a length.
void expect_covers(const Json& count, double length, double cell) {
    EXPECT_GE(count.get<double>() * cell, length - 1e-9);
    EXPECT_LT((count.get<double>() - 1.0) * cell, length + 1e-9);
}

TEST_F(Field, CoversTheCommonBoxGrownByTheTolerance) {
    const Json json = ask(squares("distance-field") + Arguments{"--pose-b", "0.6,0.3,0"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), true);
    EXPECT_NEAR(json.at("origin").at(0).get<double>(), 0.6 - d, 1e-12);
    EXPECT_NEAR(json.at("origin").at(1).get<double>(), 0.3 - d, 1e-12);
    expect_covers(json.at("width"), 0.4 + 2.0 * d, cell);
    expect_covers(json.at("height"), 0.7 + 2.0 * d, cell);
    expect_value(json, 1.0, 0.8, -0.4);
    expect_value(json, 0.7, 0.9, -0.1);
    expect_value(json, 0.9, 0.35, -0.05);
}

/// The boxes of A and B may be disjoint: only the rectangle determines the covered area.
TEST_F(Field, CoversTheRectangleAsked) {
    const Json json = ask(squares("distance-field") +
                          Arguments{"--pose-b", "-5,2,0", "--rect", "-5.7,-0.25,-1.5,3.3"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), false);
    EXPECT_EQ(json.at("origin"), Json({-5.7, -0.25}));
    expect_covers(json.at("width"), 4.2, cell);
    expect_covers(json.at("height"), 3.55, cell);
    expect_value(json, -4.5, 2.5, -0.5);
    expect_value(json, -4.5, 0.0, 2.0);
    expect_value(json, -2.0, 2.5, 2.0);
}

/// Wider than any device's images: the field is computed in slabs without a visible seam.
TEST_F(Field, IsWorkedOffInSlabs) {
    const Json json = ask(squares("distance-field") +
                          Arguments{"--pose-b", "2799,0,0", "--rect", "0,-0.1,2800,0.1"});
    ASSERT_TRUE(json.is_object());
    EXPECT_GT(json.at("width").get<int>(), 32768);
    for (double x = 0.05; x < 2798.9; x += 7.3) {
        expect_value(json, x, 0.05, 2799.0 - x);
    }
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
