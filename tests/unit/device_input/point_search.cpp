#include <engine/device_input/point_search.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nearfield::device_input {
namespace {

using test::Random;
using test::Rings;

float as_float(std::uint32_t word) {
    return std::bit_cast<float>(word);
}

/// Two shapes, and a plan of one searched query of them.
class PointSearchInput : public testing::Test {
protected:
    PointSearchInput() {
        query_ = PenetrationQuery{};
        plan_.queries.resize(1);
        PlannedQuery& planned = plan_.queries.front();
        planned.query = &query_;
        planned.a = &a_;
        planned.b = &b_;
        planned.budget.cell = 0.05;
        planned.work.emplace<PlannedPoints>().source = PointSource::device;
    }

    void build(const Rings& a, const Rings& b) {
        ASSERT_TRUE(a_.assign(a).ok());
        ASSERT_TRUE(b_.assign(b).ok());
        build();
    }
    void build() {
        plan_.clear();
        add(1);
        ASSERT_EQ(search().directions.size(), 1U);
    }

    /// The next build is of other polygons.
    void use(const geometry::Polygon& a, const geometry::Polygon& b) {
        plan_.queries.front().a = &a;
        plan_.queries.front().b = &b;
    }
    void ask_for_penetration(double tolerance, bool summarized) {
        PenetrationQuery penetration;
        penetration.tolerance = tolerance;
        query_ = penetration;
        plan_.queries.front().budget = queries::penetration_budget(penetration);
        plan_.queries.front().points().summarized = summarized;
    }
    /// Adds so many directions like that of the query.
    void add(std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto place = static_cast<std::uint32_t>(search().directions.size());
            static_cast<void>(builder_.add(place, plan_.queries.front(), geometry::Vector::UnitX(),
                                           geometry::Vector::Zero(), plan_.pairs));
        }
    }
    void fit(std::uint64_t bytes) { builder_.fit(bytes, plan_); }
    void ask_for_contacts_within(double distance) {
        ContactQuery contacts;
        contacts.contact_distance = distance;
        query_ = contacts;
        plan_.queries.front().points().outside = true;
    }

    [[nodiscard]] std::size_t builder_size() const { return builder_.shapes().units().size(); }
    [[nodiscard]] const GivenPairs& search() const { return plan_.pairs; }
    [[nodiscard]] const SearchUnit& unit(std::size_t index) const {
        return builder_.shapes().units()[index];
    }
    [[nodiscard]] std::uint32_t word(std::size_t index) const { return unit(index / 4)[index % 4]; }

    /// The boxes of a level hold those below, and the lowest ones hold the edges of the polygon.
    void check(std::uint32_t first, const geometry::Polygon& polygon) const {
        const auto [chunks, levels, edges, infos] = unit(first);
        const int exponent = -std::ilogb(polygon.radius());
        const auto expect_at = [&](const geometry::Vector& place, const std::uint32_t* words) {
            EXPECT_EQ(as_float(words[0]), std::ldexp(static_cast<float>(place.x()), exponent));
            EXPECT_EQ(as_float(words[1]), std::ldexp(static_cast<float>(place.y()), exponent));
        };
        const std::uint32_t places = infos + 4 * ((chunks + 3) / 4);
        std::uint32_t edge = 0;
        for (std::uint32_t place = 0; place < chunks; ++place) {
            const std::uint32_t chunk = word(places + place);
            ASSERT_LT(chunk, chunks);
            const std::uint32_t info = word(infos + chunk);
            ASSERT_EQ(info >> 4U, edge);
            for (std::uint32_t i = 0; i < (info & 15U); ++i, ++edge) {
                const SearchUnit& ends = unit(edges + shaders::chunk_size * chunk + i);
                expect_at(polygon.vertices()[edge], &ends[0]);
                expect_at(polygon.vertices()[polygon.next(edge)], &ends[2]);
                expect_holds(unit(first_box(first, 0) + chunk), ends);
            }
        }
        EXPECT_EQ(edge, polygon.size());
        check_rings(first, polygon);
        std::uint32_t boxes = chunks;
        for (std::uint32_t level = 1; level < levels; ++level) {
            for (std::uint32_t i = 0; i < boxes; ++i) {
                expect_holds(unit(first_box(first, level) + i / shaders::chunk_size),
                             unit(first_box(first, level - 1) + i));
            }
            boxes = (boxes + shaders::chunk_size - 1) / shaders::chunk_size;
        }
        EXPECT_LE(boxes, shaders::chunk_size);
        EXPECT_EQ(levels == 1, chunks <= shaders::chunk_size);
        for (std::uint32_t i = 0; i < boxes; ++i) {
            expect_holds(unit(first + shaders::unit_of_box),
                         unit(first_box(first, levels - 1) + i));
        }
    }

    /// A chunk begins each ring.
    void check_rings(std::uint32_t first, const geometry::Polygon& polygon) const {
        const std::uint32_t infos = unit(first)[3];
        const SearchUnit& rings = unit(first + shaders::unit_of_rings);
        ASSERT_EQ(rings[0], polygon.ring_count());
        std::vector<std::uint32_t> starts;
        for (std::uint32_t i = 0; i < rings[0]; ++i) {
            starts.push_back(word(infos + word(rings[1] + i)) >> 4U);
        }
        std::sort(starts.begin(), starts.end());
        for (std::uint32_t ring = 0; ring < rings[0]; ++ring) {
            EXPECT_EQ(starts[ring], polygon.ring_begin(ring));
        }
    }

    /// The mean width of the boxes of a level.
    [[nodiscard]] double mean_width(std::uint32_t first, std::uint32_t level,
                                    std::uint32_t boxes) const {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < boxes; ++i) {
            const SearchUnit& box = unit(first_box(first, level) + i);
            sum += static_cast<double>(as_float(box[2]) - as_float(box[0]));
        }
        return sum / boxes;
    }

private:
    [[nodiscard]] std::uint32_t first_box(std::uint32_t first, std::uint32_t level) const {
        return unit(first + shaders::unit_of_first_boxes + level / 4)[level % 4];
    }
    static void expect_holds(const SearchUnit& box, const SearchUnit& corners) {
        for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
            for (const std::size_t corner : {axis, axis + 2}) {
                EXPECT_LE(as_float(box[axis]), as_float(corners[corner]));
                EXPECT_GE(as_float(box[axis + 2]), as_float(corners[corner]));
            }
        }
    }

    AnyQuery query_;
    Plan plan_;
    GivenPairsBuilder builder_;

protected:
    geometry::Polygon a_;
    geometry::Polygon b_;
};

TEST_F(PointSearchInput, HasAllEdgesInBoxesOnEveryLevel) {
    Random random(18);
    // One chunk, eight and nine of them (a second level), 65 (a third), and rings of few edges.
    for (const int size : {3, 8, 64, 65, 72, 512, 513, 4000}) {
        SCOPED_TRACE(size);
        build(test::star(random, size, 0.3), test::several_parts(random, 1 + size % 50));
        check(search().directions.front().shape_a, a_);
        check(search().directions.front().shape_b, b_);
        EXPECT_EQ(search().items, static_cast<std::uint32_t>(size + 7) / 8);
    }
}

TEST_F(PointSearchInput, FollowsShapesThatGrowShrinkAndMove) {
    Random random(19);
    std::size_t largest = 0;
    for (int frame = 0; frame < 400; ++frame) {
        SCOPED_TRACE(frame);
        build(test::star(random, random.whole(3, 300), 0.3), test::regular(random.whole(3, 40)));
        check(search().directions.front().shape_a, a_);
        check(search().directions.front().shape_b, b_);
        largest = std::max(largest, builder_size());
    }
    // No more is left behind than a few times what is in use.
    EXPECT_LT(largest, 4096U + 4 * 2 * 2 * (300 + 40));
}

TEST_F(PointSearchInput, ForgetsShapesThatAreNoLongerUsed) {
    Random random(20);
    std::vector<geometry::Polygon> polygons(300);
    for (geometry::Polygon& polygon : polygons) {
        ASSERT_TRUE(polygon.assign(test::star(random, 100, 0.3)).ok());
    }
    std::size_t largest = 0;
    for (std::size_t frame = 1; frame < polygons.size(); ++frame) {
        use(polygons[frame - 1], polygons[frame]);
        build();
        largest = std::max(largest, builder_size());
    }
    // A shape of 100 edges takes less than 100 units for edges and boxes, and 50 for its samples.
    EXPECT_LT(largest, 4096U + 5 * 4 * 150);
}

TEST_F(PointSearchInput, ForgetsEarlierShapesWhereAllTakeTooMuch) {
    Random random(24);
    std::vector<geometry::Polygon> polygons(2);
    for (geometry::Polygon& polygon : polygons) {
        ASSERT_TRUE(polygon.assign(test::star(random, 100, 0.3)).ok());
        use(polygon, polygon);
        build();
    }
    const std::size_t of_both = builder_size();
    fit(of_both * sizeof(SearchUnit));
    EXPECT_EQ(builder_size(), of_both);
    fit(of_both * sizeof(SearchUnit) - 1);
    EXPECT_EQ(builder_size(), of_both / 2);
    check(search().directions.front().shape_a, polygons.back());
}

TEST_F(PointSearchInput, HasNearbyRingsInOneBoxWhateverTheirOrder) {
    Random random(23);
    Rings islands;
    for (int i = 0; i < 512; ++i) {
        const Vector2 low{random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        islands.push_back(test::rectangle(low, {low.x + 0.01, low.y + 0.01}).front());
    }
    build(test::star(random, 20, 0.3), islands);
    const std::uint32_t shape = search().directions.front().shape_b;
    check(shape, b_);
    // Eight islands take an eighth of the whole width, or a quarter; eight at random most of it.
    EXPECT_LT(mean_width(shape, 1, 64), 0.6);
    EXPECT_LT(mean_width(shape, 2, 8), 1.2);
}

TEST_F(PointSearchInput, ReachesTheContactDistance) {
    Random random(21);
    for (int i = 0; i < 100; ++i) {
        const double distance = random.between(1e-3, 2.0);
        ask_for_contacts_within(distance);
        build(test::star(random, 20, 0.3), test::star(random, 20, 0.3));
        const double unit = std::ldexp(1.0, std::ilogb(b_.radius()));
        EXPECT_GE(static_cast<double>(search().directions.front().reach) * unit, distance);
        EXPECT_LE(static_cast<double>(search().directions.front().reach) * unit,
                  distance * (1.0 + 1e-6));
    }
}

TEST_F(PointSearchInput, MarginCoversSixteenRoundings) {
    Random random(22);
    for (int i = 0; i < 100; ++i) {
        build(test::star(random, 20, 0.3), test::star(random, 20, 0.3));
        const double unit = std::ldexp(1.0, std::ilogb(b_.radius()));
        const double extent = a_.radius() + b_.radius();  // the centres coincide
        const double rounding = std::ldexp(extent, -24);
        EXPECT_GE(static_cast<double>(search().directions.front().margin) * unit, 16.0 * rounding);
        EXPECT_LE(static_cast<double>(search().directions.front().margin) * unit, 17.0 * rounding);
    }
}

// Each direction names its query and its first item, and bounds say what the device may find.
TEST_F(PointSearchInput, FollowOneAnother) {
    build(test::regular(40), test::regular(40));
    const double points = search().max_points;
    constexpr std::uint32_t queries = 50;
    add(queries - 1);
    const GivenPairs& pairs = search();
    ASSERT_EQ(pairs.directions.size(), queries);
    for (std::uint32_t i = 0; i < queries; ++i) {
        EXPECT_EQ(pairs.directions[i].a, i);
        EXPECT_EQ(pairs.directions[i].first_item, 5 * i);
    }
    EXPECT_EQ(pairs.items, 5 * queries);
    EXPECT_EQ(pairs.max_edges, 40.0 * queries);
    EXPECT_EQ(pairs.max_points, points * queries);
}

// A row tells of the points only where nobody asks for all of them.
TEST_F(PointSearchInput, SaysWhereTheDeepestPointIsEnough) {
    for (const bool summarized : {true, false}) {
        ask_for_penetration(0.01, summarized);
        build(test::regular(5), test::regular(6));
        const double unit = std::ldexp(1.0, std::ilogb(b_.radius()));
        const auto touching = static_cast<float>(0.01 / 1024.0 / unit);
        EXPECT_FLOAT_EQ(search().directions.front().touching, summarized ? touching : -touching);
    }
}

}  // namespace
}  // namespace nearfield::device_input
