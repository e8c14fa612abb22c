// What tables of pairs by the device have in common, whatever they ask: their rows are those of the
// CPU.

#include <tests/limits/cut.hpp>
#include <tests/query/device_pairs.hpp>

#include <cstdint>
#include <string>
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

/// What a kind of query is asked. `size`: of the shapes.
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
        return {{.tolerance = 0.05, .contact_distance = 1.0 / 3.0}};
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
    static AskedTable<Query> close() { return {{.tolerance = 0.01}, 1.0 / 3.0}; }
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
    /// Squares that overlap or touch, of which some pairs are the CPU's.
    void add_squares() {
        const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        for (int i = 0; i < 8; ++i) {
            add(square, {.translation = {i / 3.0 + i, 0.0}});
            add(square, {.translation = {i / 3.0 + i + 1.0, 0.5}});
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
/// by itself or with all others.
TYPED_TEST(DevicePairTables, AreTheSameInEachRun) {
    Random random(device_pair_tables_seed + 5000);
    for (const Rings& rings : some_shapes(random)) {
        const ShapeHandle shape = this->add_shape(rings);
        for (int i = 0; i < 8; ++i) {
            this->add(shape, this->any_pose(random, 8.0));
        }
    }
    const AskedTable<TypeParam> asked = Kind<TypeParam>::far(1.0);
    PairTable<TypeParam> first(asked.query, within(asked.reach, on_device));
    ASSERT_TRUE(this->world().update(first).ok());
    EXPECT_GT(first.size(), 10U);
    for (int run = 0; run < 2; ++run) {
        PairTable<TypeParam> second(asked.query, within(asked.reach, on_device));
        ASSERT_TRUE(this->world().update(second).ok());
        ASSERT_EQ(first.size(), second.size());
        for (std::uint32_t i = 0; i < first.size(); ++i) {
            const auto one = first.row(i);
            ASSERT_TRUE(one.has_value());
            const PairRow<TypeParam>& other = second.rows()[i];
            EXPECT_EQ(one->a, other.a);
            EXPECT_EQ(one->b, other.b);
            EXPECT_EQ(one->index, other.index);
            if constexpr (requires { one->count; }) {
                EXPECT_EQ(one->count, other.count);
            }
            const auto records = points_of(first, i);
            const auto again = points_of(second, i);
            ASSERT_EQ(records.size(), again.size());
            for (std::size_t k = 0; k < records.size(); ++k) {
                if constexpr (requires { records[k].nearest; }) {
                    EXPECT_EQ(records[k].position, again[k].position);
                    EXPECT_EQ(records[k].nearest, again[k].nearest);
                }
            }
        }
    }
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
