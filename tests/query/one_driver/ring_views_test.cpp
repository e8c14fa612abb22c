#include <tests/query/all_numbers.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/allocations.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t ring_views_seed = 91'000;

/// The numbers of a ring at a stride, with what must not be read in between.
template <class Number>
std::vector<Number> spread(const Ring& ring, std::size_t stride) {
    std::vector<Number> numbers(ring.size() * stride, std::numeric_limits<Number>::quiet_NaN());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        numbers[i * stride] = static_cast<Number>(ring[i].x);
        numbers[i * stride + 1] = static_cast<Number>(ring[i].y);
    }
    return numbers;
}

/// What single precision keeps of the coordinates.
Rings in_single_precision(Rings rings) {
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex = {static_cast<double>(static_cast<float>(vertex.x)),
                      static_cast<double>(static_cast<float>(vertex.y))};
        }
    }
    return rings;
}

class RingViews : public testing::Test {
protected:
    /// All numbers of an answer that depends on every vertex.
    std::vector<double> answers(const Expected<ShapeHandle>& shape) {
        EXPECT_TRUE(shape.has_value()) << shape.error().text();
        Batch batch;
        const Instance one{*shape, {}};
        const Instance other{*shape, {{0.3, 0.1}, 0.7}};
        batch.add(PenetrationQuery{one, other, 0.05, PenetrationPoints::vertices});
        batch.add(ContactQuery{one, other, 0.05, 0.02});
        Results results;
        EXPECT_TRUE(context_.run(batch, results).ok());
        return all_numbers(results);
    }

    Expected<ShapeHandle> add(std::span<const RingView> rings) { return context_.add_shape(rings); }

    Context context_ = *Context::create_cpu();
};

TEST_F(RingViews, AreTheSameShapesAsRings) {
    for_each_case(ring_views_seed, 20, [&](Random& random) {
        const Rings rings = with_holes(random, 3);
        const Rings rounded = in_single_precision(rings);
        for (const std::size_t stride : {2U, 3U, 8U}) {
            std::vector<std::vector<double>> doubles;
            std::vector<std::vector<float>> floats;
            std::vector<RingView> of_doubles;
            std::vector<RingView> of_floats;
            for (const Ring& ring : rings) {
                doubles.push_back(spread<double>(ring, stride));
                floats.push_back(spread<float>(ring, stride));
                of_doubles.emplace_back(doubles.back(), stride);
                of_floats.emplace_back(floats.back(), stride);
            }
            const std::vector<double> expected = answers(context_.add_shape(rings));
            ASSERT_GT(expected.size(), 100U);
            EXPECT_EQ(answers(add(of_doubles)), expected);
            EXPECT_EQ(answers(add(of_floats)), answers(context_.add_shape(rounded)));
            const Expected<ShapeHandle> shape = context_.add_shape(regular(5));
            ASSERT_TRUE(context_.update_shape(*shape, of_doubles).ok());
            EXPECT_EQ(answers(shape), expected);
        }
    });
}

TEST_F(RingViews, MayEndWithTheLastVertex) {
    // Vertices of a mesh: three floats of which the last z is not part of the span.
    const std::array<float, 9> mesh{0, 0, 7, 1, 0, 7, 0, 1, 7};
    const RingView whole[] = {RingView(mesh, 3)};
    const RingView cut[] = {RingView(std::span(mesh).first(8), 3)};
    const std::vector<double> expected =
        answers(context_.add_shape(Rings{{{0, 0}, {1, 0}, {0, 1}}}));
    EXPECT_EQ(answers(add(whole)), expected);
    EXPECT_EQ(answers(add(cut)), expected);
}

TEST_F(RingViews, AreRefusedByName) {
    const std::vector<double> triangle{0, 0, 1, 0, 0, 1};
    const Expected<ShapeHandle> shape = context_.add_shape(regular(5));
    const std::vector<double> before = answers(shape);
    const auto expect = [&](const RingView& second, const std::string& words) {
        const RingView rings[] = {RingView(triangle), second};
        for (const Status& status : {add(rings).error(), context_.update_shape(*shape, rings)}) {
            EXPECT_EQ(status.code(), StatusCode::invalid_shape);
            EXPECT_NE(status.message().find("ring 1"), std::string::npos) << status.text();
            EXPECT_NE(status.message().find(words), std::string::npos) << status.text();
        }
        EXPECT_EQ(answers(shape), before);
    };
    expect(RingView(triangle, 1), "stride is 1");
    expect(RingView(triangle, 0), "stride is 0");
    expect(RingView(std::span(triangle).first(5)), "lacks its y");
    expect(RingView(std::span<const double>()), "three different vertices");
    expect(RingView(triangle, 2 * sizeof(double)),
           "6 numbers at a stride of 16 numbers are fewer than three different vertices");
    const std::vector<float> odd{0, 0, 1, 0, 0, std::numeric_limits<float>::infinity()};
    expect(RingView(odd), "vertex 2");
}

TEST_F(RingViews, UpdatesOfAFrameAllocateNothing) {
    Random random(ring_views_seed);
    const std::vector<float> numbers = spread<float>(coast(random, 300, 0.5)[0], 4);
    const RingView rings[] = {RingView(numbers, 4)};
    const Expected<ShapeHandle> shape = add(rings);
    ASSERT_TRUE(shape.has_value()) << shape.error().text();
    ASSERT_TRUE(context_.update_shape(*shape, rings).ok());
    const std::uint64_t before = test_support::allocation_count();
    EXPECT_TRUE(context_.update_shape(*shape, rings).ok());
    EXPECT_EQ(test_support::allocation_count(), before);
}

}  // namespace
}  // namespace nearfield::test
