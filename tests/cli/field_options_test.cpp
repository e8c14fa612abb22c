#include "cli_test.hpp"
#include "file_formats.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>

namespace nearfield::test {
namespace {

/// The header of an array in NumPy's format as text.
std::string npy_header(const std::string& bytes) {
    return bytes.substr(10, bytes.find('\n') - 10);
}

std::uint32_t word_at(const std::string& bytes, std::size_t index) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + bytes.find('\n') + 1 + 4 * index, sizeof word);
    return word;
}

/// A field of the unit square over [-1, 2] x [-1, 2].
class FieldOptions : public CliTest {
protected:
    [[nodiscard]] Arguments field() const {
        return squares("distance-field") + Arguments{"-d", "0.05", "--rect", "-1,-1,2,2"};
    }
};

TEST_F(FieldOptions, SignEncodingsGiveTheSameFile) {
    std::string first;
    for (const std::string sign : {"stencil", "color", "feature-bit"}) {
        const std::string file = folder_.path(sign + ".npy");
        const Json json = answer(field() + Arguments{"--sign", sign, "--field", file});
        ASSERT_TRUE(json.is_object());
        EXPECT_EQ(json.at("sign"), sign);
        const std::string bytes = folder_.read(sign + ".npy");
        EXPECT_TRUE(first.empty() || bytes == first) << sign;
        first = bytes;
    }
}

TEST_F(FieldOptions, FeaturesAreEdgesAndVertices) {
    const Json json = answer(field() + Arguments{"--features", folder_.path("f.npy")});
    ASSERT_TRUE(json.is_object());
    const std::string bytes = folder_.read("f.npy");
    const auto width = json.at("width").get<std::size_t>();
    const auto height = json.at("height").get<std::size_t>();
    EXPECT_NE(npy_header(bytes).find("'<u4'"), std::string::npos);
    EXPECT_NE(
        npy_header(bytes).find("(" + std::to_string(height) + ", " + std::to_string(width) + ")"),
        std::string::npos);
    constexpr std::uint32_t vertex = 1U << 31U;
    EXPECT_EQ(word_at(bytes, 0), vertex | 0U);                        // below and left of (0, 0)
    EXPECT_EQ(word_at(bytes, width - 1), vertex | 1U);                // right of (1, 0)
    EXPECT_EQ(word_at(bytes, width / 2), 0U);                         // below edge 0
    EXPECT_EQ(word_at(bytes, width * (height / 2) + width - 1), 1U);  // right of edge 1
}

TEST_F(FieldOptions, GradientsOfAllMethodsPointTheSameWay) {
    for (const std::string method : {"analytic", "central-differences", "blended"}) {
        SCOPED_TRACE(method);
        const Json json = answer(
            field() + Arguments{"--gradient", method, "--gradient-field", folder_.path("g.npy")});
        ASSERT_TRUE(json.is_object());
        EXPECT_EQ(json.at("gradient"), method);
        EXPECT_EQ(json.contains("gradient_format"), method == "blended");
        EXPECT_GT(json.at("gradient_error_bound").get<double>(), 0.0);
        const std::string bytes = folder_.read("g.npy");
        EXPECT_NE(npy_header(bytes).find(", 2)"), std::string::npos);
        const auto width = json.at("width").get<std::size_t>();
        const auto height = json.at("height").get<std::size_t>();
        const auto gradient = [&](std::size_t column, std::size_t row, std::size_t axis) {
            const std::uint32_t word = word_at(bytes, 2 * (row * width + column) + axis);
            float number = 0.0F;
            std::memcpy(&number, &word, sizeof number);
            return static_cast<double>(number);
        };
        // At the middle of the grid's right edge, the gradient points away from the square's right
        // edge.
        EXPECT_NEAR(gradient(width - 1, height / 2, 0), 1.0, 1e-5);
        EXPECT_NEAR(gradient(width - 1, height / 2, 1), 0.0, 1e-5);
        EXPECT_NEAR(gradient(0, height / 2, 0), -1.0, 1e-5);
        EXPECT_NEAR(gradient(width / 2, 0, 1), -1.0, 1e-5);
    }
}

TEST_F(FieldOptions, PointsAreReconstructed) {
    const Json json = answer(field() + Arguments{"--at", "1.5,0.5", "--at", "-1,-1", "--at",
                                                 "0.1,0.5", "--gradient", "analytic"});
    ASSERT_TRUE(json.is_object());
    const Json& points = json.at("points");
    ASSERT_EQ(points.size(), 3U);
    const double expected[] = {0.5, std::sqrt(2.0), -0.1};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(points[i].at("distance").get<double>(), expected[i],
                    points[i].at("error_bound").get<double>());
        EXPECT_EQ(points[i].at("inside").get<double>() > 0.5, expected[i] < 0.0);
        EXPECT_EQ(points[i].at("unique"), true);
    }
    EXPECT_EQ(points[0].at("feature").at("edge"), 1);
    EXPECT_EQ(points[1].at("feature").at("vertex"), 0);
    EXPECT_EQ(points[2].at("gradient"), Json::array({-1.0, 0.0}));
}

TEST_F(FieldOptions, PicturesAreDrawn) {
    for (const std::string show : {"field", "voronoi", "gradient"}) {
        const Json json =
            answer(field() + Arguments{"--image", folder_.path(show + ".png"), "--show", show});
        ASSERT_TRUE(json.is_object());
        EXPECT_EQ(parse_png(folder_.read(show + ".png")).width, 1600U);
    }
    EXPECT_NE(folder_.read("field.png"), folder_.read("voronoi.png"));
    EXPECT_NE(folder_.read("gradient.png"), folder_.read("voronoi.png"));
}

TEST_F(FieldOptions, WithoutMeaningAreRefused) {
    const auto with = [&](const Arguments& options) { return field() + options; };
    expect_refused(with({"--sign", "pink"}), {"--sign", "pink", "feature-bit"});
    expect_refused(with({"--gradient", "steep", "--at", "0,0"}), {"--gradient", "steep"});
    expect_refused(with({"--gradient", "blended"}), {"--gradient", "--at"});
    expect_refused(with({"--show", "voronoi"}), {"--show", "--image"});
    expect_refused(with({"--show", "all", "--image", folder_.path("x.png")}), {"--show", "all"});
    expect_refused(with({"--at", "1"}), {"--at", "X,Y"});
    expect_refused(with({"--at", "nan,0"}), {"--at", "nan"});
    expect_refused(with({"--at", "0,0", "--at", "5,5"}), {"point 1", "(5, 5)", "outside"});
    expect_refused(
        with({"--features", folder_.path("a.npy"), "--gradient-field", folder_.path("a.npy")}),
        {"a.npy", "another output"});
    // Of two names of one file, neither of which is there yet.
    const std::string here = std::filesystem::relative(folder_.path("a.npy")).string();
    expect_refused(with({"--features", here, "--gradient-field", "./" + here}),
                   {"a.npy", "another output"});
}

}  // namespace
}  // namespace nearfield::test
