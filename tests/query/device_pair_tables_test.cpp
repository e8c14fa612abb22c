// What tables of pairs by the device have in common, whatever they ask: their rows are those of the
// CPU.

#include <tests/limits/cut.hpp>
#include <tests/query/device_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_tables_seed = 24000;

/// A query, and the reach of its table.
template <class Query>
struct AskedTable {
    Query query;
    double reach = 0.0;
};

/// What a kind of query is asked. `size`: of the shapes. close(): with a reach of 1/4, if any;
/// fine(): more than single precision tells of long shapes, and double precision of very long ones.
template <class Query>
struct Kind;

template <>
struct Kind<PenetrationQuery> {
    static constexpr int cases = 6;
    static constexpr int far_cases = 3;
    static constexpr double smallest_far = 1.0;
    static constexpr bool is_mostly_decided = false;

    static std::vector<AskedTable<PenetrationQuery>> any(Random& random, double size) {
        const double tolerance = size * random.scale(1e-3, 0.1);
        return {{{.tolerance = tolerance, .points = PenetrationPoints::vertices}},
                {{.tolerance = tolerance, .points = PenetrationPoints::boundary}}};
    }
    static AskedTable<PenetrationQuery> far(double size) { return {{.tolerance = 0.01 * size}}; }
    static AskedTable<PenetrationQuery> close() {
        return {{.tolerance = 1e-5, .points = PenetrationPoints::vertices}};
    }
    static AskedTable<PenetrationQuery> fine() {
        return {{.tolerance = 1e-6, .points = PenetrationPoints::vertices}};
    }
};

template <>
struct Kind<ContactQuery> {
    static constexpr int cases = 6;
    static constexpr int far_cases = 3;
    static constexpr double smallest_far = 1.0;
    static constexpr bool is_mostly_decided = false;

    static std::vector<AskedTable<ContactQuery>> any(Random& random, double size) {
        const double tolerance = size * random.scale(3e-3, 0.1);
        return {
            {{.tolerance = tolerance, .contact_distance = tolerance * random.scale(0.2, 20.0)}}};
    }
    static AskedTable<ContactQuery> far(double size) {
        return {{.tolerance = 0.02 * size, .contact_distance = 0.05 * size}};
    }
    static AskedTable<ContactQuery> close() {
        return {{.tolerance = 0.05, .contact_distance = 0.25}};
    }
    static AskedTable<ContactQuery> fine() {
        return {{.tolerance = 1e-4, .contact_distance = 1e-3, .summary_only = true}};
    }
};

template <>
struct Kind<IntersectionTestQuery> {
    static constexpr int cases = 12;
    static constexpr int far_cases = 80;
    static constexpr double smallest_far = 1e-6;
    static constexpr bool is_mostly_decided = true;

    static std::vector<AskedTable<IntersectionTestQuery>> any(Random& /*random*/, double /*size*/) {
        return {{}};
    }
    static AskedTable<IntersectionTestQuery> far(double /*size*/) { return {}; }
    static AskedTable<IntersectionTestQuery> close() { return {}; }
    static AskedTable<IntersectionTestQuery> fine() { return {}; }
};

/// Of queries whose answer is a distance.
template <class Query>
struct KindOfDistance {
    static constexpr int cases = 5;
    static constexpr int far_cases = 3;
    static constexpr double smallest_far = 1e-5;
    static constexpr bool is_mostly_decided = true;

    static std::vector<AskedTable<Query>> any(Random& random, double size) {
        const Query query{.tolerance = 0.01 * size};
        return {{query, 0.0},
                {query, 1e-3 * size},
                {query, size},
                {query, size * random.scale(0.01, 5.0)}};
    }
    static AskedTable<Query> far(double size) { return {{.tolerance = 0.01 * size}, 0.3 * size}; }
    static AskedTable<Query> close() { return {{.tolerance = 0.01}, 0.25}; }
    static AskedTable<Query> fine() { return {{.tolerance = 1e-6}, 1.0}; }
};
template <>
struct Kind<SeparationQuery> : KindOfDistance<SeparationQuery> {};
template <>
struct Kind<ClosestPointQuery> : KindOfDistance<ClosestPointQuery> {};

template <class Query>
class DevicePairTables : public DevicePairsTest {
protected:
    static Tables<Query> tables_of(const AskedTable<Query>& asked) {
        return Tables<Query>(asked.query, asked.reach);
    }
    /// Squares that overlap, touch or are at the reach of close(): some pairs are the CPU's.
    void add_squares() {
        const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        for (int i = 0; i < 8; ++i) {
            const double x = 1.0 / 3.0 + 1.25 * i;
            add(square, {.translation = {x, 0.0}});
            add(square, {.translation = {x + 1.0, 0.5}});
        }
    }
};
using Queries = testing::Types<PenetrationQuery, ContactQuery, IntersectionTestQuery,
                               SeparationQuery, ClosestPointQuery>;
TYPED_TEST_SUITE(DevicePairTables, Queries);

TYPED_TEST(DevicePairTables, AreThoseOfTheCpu) {
    using Kind = Kind<TypeParam>;
    for_each_case(device_pair_tables_seed, Kind::cases, [&](Random& random) {
        std::vector<InstanceHandle> added;
        std::vector<Rings> shapes = some_shapes(random);
        for (int i = Kind::is_mostly_decided ? 8 : 0; i > 0; --i) {
            shapes.push_back(any_shape(random).rings);
        }
        for (const Rings& rings : shapes) {
            const ShapeHandle shape = this->add_shape(rings);
            for (int i = random.whole(1, 4); i > 0; --i) {
                added.push_back(this->add(shape, this->any_pose(random, 5.0)));
            }
        }
        for (const AskedTable<TypeParam>& asked : Kind::any(random, 1.0)) {
            Tables<TypeParam> tables = this->tables_of(asked);
            this->compare(tables);
            EXPECT_GT(tables.device.size(), 10U);
            if (Kind::is_mostly_decided) {
                EXPECT_LT(tables.device.left_to_cpu(), tables.device.candidates() / 20);
            }
        }
        this->remove(added);
    });
}

TYPED_TEST(DevicePairTables, DoNotShowTheirHistory) {
    for_each_case(device_pair_tables_seed + 1000, 2, [&](Random& random) {
        Tables<TypeParam> tables = this->tables_of(Kind<TypeParam>::any(random, 1.0).front());
        this->run_history(random, {.steps = 10, .instances = 130, .extent = 25.0},
                          [&] { this->compare(tables); });
    });
}

TYPED_TEST(DevicePairTables, FarFromTheOrigin) {
    using Kind = Kind<TypeParam>;
    for_each_case(device_pair_tables_seed + 2000, Kind::far_cases, [&](Random& random) {
        std::vector<InstanceHandle> added;
        const double size = random.scale(Kind::smallest_far, 1.0);
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = this->add_shape(scaled_and_moved(rings, size, {}));
            for (int i = 0; i < 3; ++i) {
                Pose pose = this->any_pose(random, 4.0 * size);
                pose.translation.x += 1e6;
                pose.translation.y -= 3e6;
                added.push_back(this->add(shape, pose));
            }
        }
        Tables<TypeParam> tables = this->tables_of(Kind::far(size));
        this->compare(tables);
        this->remove(added);
    });
}

/// The CPU answers what floats may not hold: products of the least and the largest lengths.
TYPED_TEST(DevicePairTables, OfTheSmallestAndLargestShapes) {
    for (const double size : {1e-18, 1e-12, 1e-9, 1e-4, 1e4, 1e11}) {
        SCOPED_TRACE("size " + std::to_string(size));
        Random random(device_pair_tables_seed + 3000);
        std::vector<InstanceHandle> added;
        for (int i = 0; i < 4; ++i) {
            const ShapeHandle shape =
                this->add_shape(scaled_and_moved(star(random, 9, 0.5), size, {0.0, 0.0}));
            for (int k = 0; k < 2; ++k) {
                added.push_back(this->add(shape, this->any_pose(random, size)));
            }
        }
        Tables<TypeParam> tables = this->tables_of(Kind<TypeParam>::far(size));
        this->compare(tables);
        EXPECT_GT(tables.device.size(), 0U);
        this->remove(added);
    }
}

/// Sizes whose ratio is far from 1, side by side.
TYPED_TEST(DevicePairTables, OfTheSmallestBesideTheLargestShapes) {
    Random random(device_pair_tables_seed + 4000);
    for (const double size : {1e-18, 1e-9, 1e-4, 1.0, 1e4, 1e11}) {
        const ShapeHandle shape = this->add_shape(scaled_and_moved(star(random, 9, 0.5), size, {}));
        const ShapeHandle holes =
            this->add_shape(scaled_and_moved(with_holes(random, 3), size, {}));
        for (int i = 0; i < 3; ++i) {
            this->add(shape, this->any_pose(random, size));
            this->add(holes, this->any_pose(random, size));
        }
    }
    Tables<TypeParam> tables = this->tables_of(Kind<TypeParam>::far(1e9));
    this->compare(tables);
    EXPECT_GT(tables.device.size(), 10U);
}

/// Cut at any checkpoint, those of the pairs that the CPU decides included, an update fails as a
/// whole, and the next one is as if nothing had been.
TYPED_TEST(DevicePairTables, CutByLimitsAreNone) {
    this->add_squares();
    Tables<TypeParam> tables = this->tables_of(Kind<TypeParam>::close());
    const std::uint64_t cuts = cut_everywhere(dense, [&](std::uint64_t n) {
        SCOPED_TRACE("cut at checkpoint " + std::to_string(n));
        const Cut cut(n);
        const Status status = this->world().update(tables.device, {}, cut.limits());
        EXPECT_EQ(status.code(), cut.has_cut() ? StatusCode::cancelled : StatusCode::ok)
            << status.text();
        if (cut.has_cut()) {
            EXPECT_EQ(tables.device.size(), 0U);
            EXPECT_TRUE(tables.device.rows().empty());
        }
        this->compare(tables);
        EXPECT_GT(tables.device.left_to_cpu(), 0U);
        return cut.has_cut() && !this->HasFailure();
    });
    EXPECT_GE(cuts, 8U);
}

/// The order of the rows and every bit of them are the same in each run, and whether a row is read
/// by itself or with all others, at once or when the world has changed.
TYPED_TEST(DevicePairTables, AreTheSameInEachRunAndStayAsTheyWere) {
    Random random(device_pair_tables_seed + 5000);
    std::vector<InstanceHandle> added;
    ShapeHandle last;
    for (const Rings& rings : some_shapes(random)) {
        last = this->add_shape(rings);
        for (int i = 0; i < 8; ++i) {
            added.push_back(this->add(last, this->any_pose(random, 8.0)));
        }
    }
    const AskedTable<TypeParam> asked = Kind<TypeParam>::far(1.0);
    const auto table = [&] {
        return PairTable<TypeParam>(asked.query, within(asked.reach, on_device));
    };
    PairTable<TypeParam> first = table();
    PairTable<TypeParam> read_later = table();
    PairTable<TypeParam> read_one_by_one = table();
    for (PairTable<TypeParam>* const each : {&first, &read_later, &read_one_by_one}) {
        ASSERT_TRUE(this->world().update(*each).ok());
    }
    EXPECT_GT(first.size(), 10U);
    const std::vector<double> expected = numbers_of_table(first);
    for (const InstanceHandle instance : added) {
        ASSERT_TRUE(this->world().move(instance, this->any_pose(random, 8.0)).ok());
    }
    ASSERT_TRUE(this->context().update_shape(last, rectangle({-3.0, -3.0}, {3.0, 3.0})).ok());
    EXPECT_EQ(numbers_of_table(read_later), expected);
    Numbers one_by_one;
    for (std::uint32_t i = 0; i < read_one_by_one.size(); ++i) {
        const auto row = read_one_by_one.row(i);
        ASSERT_TRUE(row.has_value()) << row.error().text();
        one_by_one.add_row(read_one_by_one, *row);
    }
    EXPECT_EQ(one_by_one.list(), rows_of(first));
}

/// Sides that touch, corners on sides, corners on corners, and the same shape twice, whatever the
/// rounding of their places says; and squares apart by the reach itself.
TYPED_TEST(DevicePairTables, OfSquaresThatTouchOrAreAtTheReach) {
    const ShapeHandle square = this->add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int x = 0; x < 6; ++x) {
        for (int y = 0; y < 6; ++y) {
            const Vector2 place{x / 3.0 + x, y / 3.0 + y};
            this->add(square, {.translation = place});
            this->add(square, {.translation = {place.x + 1.0, place.y}});
            this->add(square, {.translation = {place.x + 1.0, place.y + 1.0}});
            // Of contacts of shapes that share a boundary, either normal is right.
            if (x == y && !std::is_same_v<TypeParam, ContactQuery>) {
                this->add(square, {.translation = place});
                this->add(square, {.translation = {place.x + 0.25, place.y + 0.25}});
                this->add(square, {.translation = {place.x, place.y + 1.0 + 1e-14}});
            }
        }
    }
    for (int i = 0; i < 12; ++i) {
        const Vector2 place{i / 3.0 + 4.0 * i, 20.0};
        this->add(square, {.translation = place});
        this->add(square, {.translation = {place.x + 1.25 - 0.25 * (i % 2), 20.5}});
    }
    Tables<TypeParam> tables = this->tables_of(Kind<TypeParam>::close());
    this->compare(tables);
    EXPECT_GT(tables.device.size(), 0U);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

/// Gaps and overlaps that single precision does not resolve, and gaps of a few roundings of their
/// places, or less: which of them intersect, the CPU tells.
TYPED_TEST(DevicePairTables, OfSquaresThatAlmostTouch) {
    const auto compare = [&](const AskedTable<TypeParam>& asked, double size, const Vector2& first,
                             double apart, const auto& gap_of) {
        const ShapeHandle square = this->add_shape(rectangle({0.0, 0.0}, {size, size}));
        std::vector<InstanceHandle> added;
        for (int i = 0; i < 48; ++i) {
            const double x = first.x + apart * size * i;
            added.push_back(this->add(square, {.translation = {x, first.y}}));
            const Vector2 beside{x + size + gap_of(i), first.y + 0.3 * size};
            added.push_back(this->add(square, {.translation = beside}));
        }
        Tables<TypeParam> tables = this->tables_of(asked);
        this->compare(tables);
        EXPECT_GT(tables.device.candidates(), 10U);
        this->remove(added);
    };
    using Kind = Kind<TypeParam>;
    compare(Kind::close(), 1.0, {}, 4.0 + 1.0 / 3.0,
            [](int i) { return std::ldexp(i % 2 == 0 ? 1.0 : -1.0, -20 - i % 20); });
    for (const double size : {1.0, 1e-5}) {
        compare(Kind::far(size), size, {1e6, 1e6}, 3.0,
                [](int i) { return std::ldexp(1.0, i / 2 - 44); });
    }
}

/// Dots in the hole and in the walls of a frame, between rings that alternate and across their
/// boundaries; and a bar across all, which has no sample in them.
TYPED_TEST(DevicePairTables, OfNestedRings) {
    const auto square = [](double half) { return rectangle({-half, -half}, {half, half}).front(); };
    this->add(this->add_shape({square(3.0), square(2.0)}), {});
    this->add(this->add_shape({square(6.0), square(5.0), square(4.0), square(3.5)}), {});
    this->add(this->add_shape({square(10.0), square(7.75)}), {});
    this->add(this->add_shape(rectangle({-30.0, -0.01}, {30.0, 0.01})),
              {.translation = {0.0, 5.5}, .angle = 0.1});
    const ShapeHandle dot = this->add_shape({square(0.25)});
    for (const double x : {0.0, 1.5, 1.7, 2.5, 3.25, 3.75, 4.5, 5.5, 7.0, 9.5, 10.2, 12.0}) {
        this->add(dot, {.translation = {x, 0.0}, .angle = 0.1});
        this->add(dot, {.translation = {0.0, -x}});
    }
    for (const double size : {1.0, 0.1, 30.0}) {
        Tables<TypeParam> tables = this->tables_of(Kind<TypeParam>::far(size));
        this->compare(tables);
        EXPECT_GT(tables.device.size(), 5U);
    }
}

/// A tolerance that the coordinates of one instance do not resolve is an error of its pairs alone.
TYPED_TEST(DevicePairTables, StateTheErrorsOfTheirPairs) {
    const ShapeHandle small = this->add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    this->add(small, {});
    this->add(small, {.translation = {0.5, 0.5}});
    this->add(this->add_shape(rectangle({-1e9, -1.0}, {1e9, 1.0})), {});
    Tables<TypeParam> tables = this->tables_of(Kind<TypeParam>::fine());
    this->compare(tables);
    const auto rows = tables.device.rows();
    const auto errors = std::count_if(rows.begin(), rows.end(),
                                      [](const auto& row) { return row.status != StatusCode::ok; });
    const bool has_tolerance = !std::is_same_v<TypeParam, IntersectionTestQuery>;
    EXPECT_EQ(2 * tables.device.size(), has_tolerance ? 3 * errors : 6);
}

TYPED_TEST(DevicePairTables, OfAnEmptyWorldAreNone) {
    Tables<TypeParam> tables = this->tables_of(Kind<TypeParam>::far(1.0));
    this->compare(tables);
    const InstanceHandle only = this->add(this->add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0})), {});
    this->compare(tables);
    this->compare(tables);
    ASSERT_TRUE(this->world().move(only, {{1.0, 2.0}, 0.5}).ok());
    this->compare(tables);
    EXPECT_EQ(tables.device.size(), 0U);
    EXPECT_FALSE(tables.device.row(0).has_value());
}

}  // namespace
}  // namespace nearfield::test
