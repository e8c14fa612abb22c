#include <tests/oracle/overlap.hpp>
#include <tests/query/agreement.hpp>
#include <tests/query/check.hpp>
#include <tests/query/hard_pairs.hpp>
#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

/// A world of pairs: A of pair i is its instance 2 i, B the next.
class WorldOfPairs {
public:
    WorldOfPairs(Context& context, const HardPairs& asked) : world_(*World::create(context)) {
        for (const auto& pair : asked.pairs) {
            for (const Instance& one : {pair->instance_a(), pair->instance_b()}) {
                instances_.push_back(*world_.add({.shape = one.shape, .pose = one.pose}));
            }
        }
    }

    template <class Table>
    void update(Table& table) {
        const Status status = world_.update(table);
        ASSERT_TRUE(status.ok()) << status.text();
    }

    /// The rows by the number of their instance `a`; all are rows of a pair.
    template <class Query>
    [[nodiscard]] std::vector<std::optional<PairRow<Query>>> sorted(
        std::span<const PairRow<Query>> rows) const {
        std::vector<std::optional<PairRow<Query>>> result(instances_.size());
        for (const PairRow<Query>& row : rows) {
            const std::size_t a = number_of(row.a);
            EXPECT_EQ(number_of(row.b), a ^ 1U) << "a row of two pairs";
            EXPECT_EQ(row.status, StatusCode::ok);
            EXPECT_FALSE(result[a].has_value()) << "two rows of one pair";
            result[a] = row;
        }
        return result;
    }

private:
    [[nodiscard]] std::size_t number_of(InstanceHandle instance) const {
        const auto found = std::find(instances_.begin(), instances_.end(), instance);
        return static_cast<std::size_t>(found - instances_.begin());
    }

    World world_;
    std::vector<InstanceHandle> instances_;
};

/// What the device and the CPU say about the pairs, by the number of a row's instance `a`.
template <class Query>
class Rows {
public:
    using Row = PairRow<Query>;
    using Result = typename Query::Result;

    Rows(WorldOfPairs& world, const Query& query, double reach = 0.0)
        : device_(query, within(reach, on_device)), cpu_(query, within(reach, on_cpu)) {
        world.update(device_);
        world.update(cpu_);
        found_ = world.sorted(device_.rows());
        EXPECT_EQ(device_.rows().size(), device_.size()) << device_.read_status().text();
        expected_ = world.sorted(cpu_.rows());
    }

    [[nodiscard]] const std::optional<Row>& found(std::size_t a) const { return found_[a]; }
    [[nodiscard]] const std::optional<Row>& expected(std::size_t a) const { return expected_[a]; }

    // As the answer to a query alone; without a row, that of shapes that do not intersect.
    [[nodiscard]] Result found_result(std::size_t a) { return as_result(device_, found_[a]); }
    [[nodiscard]] Result expected_result(std::size_t a) { return as_result(cpu_, expected_[a]); }

private:
    [[nodiscard]] static Result as_result(PairTable<Query>& table, const std::optional<Row>& row) {
        Result result;
        if constexpr (requires { table.query().tolerance; }) {
            result.tolerance = result.error_bound = table.query().tolerance;
        }
        if (row) {
            static_cast<typename Result::Values&>(result) = *row;
            result.intersects = row->intersects;
            result.error_bound = row->error_bound;
            if constexpr (requires { result.points; }) {
                const auto records = table.points(*row);
                result.points.assign(records.begin(), records.end());
            }
            if constexpr (requires { result.manifold; }) {
                const auto manifold = table.manifold(*row);
                result.manifold.assign(manifold.begin(), manifold.end());
            }
        }
        return result;
    }

    PairTable<Query> device_;
    PairTable<Query> cpu_;
    std::vector<std::optional<Row>> found_;
    std::vector<std::optional<Row>> expected_;
};

void check_tests(WorldOfPairs& world, const HardPairs& asked) {
    Rows<IntersectionTestQuery> rows(world, IntersectionTestQuery{});
    asked.for_each([&](std::size_t i, const PlacedPair& pair) {
        const bool found = rows.found(2 * i).has_value();
        EXPECT_EQ(found, rows.expected(2 * i).has_value());
        const Truth truth = pair.intersects();
        EXPECT_TRUE(truth == Truth::too_close_to_call || found == (truth == Truth::yes));
    });
}

/// Both rows of a pair have what those of the CPU have; `agree` compares the answers for A in B.
template <class Query, class Agree>
void compare(Rows<Query>& rows, Rows<Query>& summaries, std::size_t i, const Agree& agree) {
    for (const std::size_t a : {2 * i, 2 * i + 1}) {
        const auto found = rows.found_result(a);
        const auto summary = summaries.found_result(a);
        const auto expected = rows.expected_result(a);
        EXPECT_EQ(found.count, found.points.size());
        EXPECT_EQ(found.count, expected.count) << "row of instance " << a;
        EXPECT_EQ(found.count, summary.count) << "without records";
        EXPECT_EQ(rows.found(a).has_value(), summaries.found(a).has_value());
        if (a % 2 == 0) {
            agree(found, expected);
        }
    }
}

/// The device chooses the deepest point of a row in single precision, as the nearest features.
void take_deepest_of_records(PenetrationResult& result) {
    for (const PenetratingPoint& record : result.points) {
        if (record.depth > result.deepest.depth) {
            EXPECT_NEAR(record.depth, result.deepest.depth, result.tolerance / 1000.0);
            result.deepest = record;
        }
    }
}

void check_penetrations(WorldOfPairs& world, const HardPairs& asked, PenetrationPoints points) {
    PenetrationQuery query{.tolerance = asked.tolerance, .points = points};
    const AnyQuery any = query;
    Rows<PenetrationQuery> rows(world, query);
    query.summary_only = true;
    Rows<PenetrationQuery> summaries(world, query);
    asked.for_each([&](std::size_t i, const PlacedPair& pair) {
        PenetrationResult result = rows.found_result(2 * i);
        if (!rows.found(2 * i)) {
            result.intersects = pair.intersects() == Truth::yes;  // of crossings there is no row
        }
        take_deepest_of_records(result);
        check_penetration(pair, points, result);
        compare(rows, summaries, i, [&](const auto& found, const auto& expected) {
            Report report("penetrations by the device and the CPU");
            check_agreement(report, {.pair = pair, .query = any, .mostly_equal = false}, found,
                            expected);
        });
        for (const std::size_t a : {2 * i, 2 * i + 1}) {
            const double depth = rows.found_result(a).deepest.depth;
            EXPECT_EQ(depth, summaries.found_result(a).deepest.depth);
            EXPECT_NEAR(depth, rows.expected_result(a).deepest.depth, asked.tolerance / 1000.0);
        }
    });
}

void check_all_contacts(WorldOfPairs& world, const HardPairs& asked) {
    ContactQuery query{.tolerance = asked.tolerance, .contact_distance = asked.contact_distance};
    const AnyQuery any = query;
    Rows<ContactQuery> rows(world, query);
    query.summary_only = true;
    Rows<ContactQuery> summaries(world, query);
    asked.for_each([&](std::size_t i, const PlacedPair& pair) {
        check_contacts(pair, asked.contact_distance, rows.found_result(2 * i));
        compare(rows, summaries, i, [&](const auto& found, const auto& expected) {
            EXPECT_EQ(found.manifold.size(), summaries.found_result(2 * i).manifold.size());
            Report report("contacts by the device and the CPU");
            check_agreement(report, {.pair = pair, .query = any, .mostly_equal = false}, found,
                            expected);
        });
    });
}

template <class Query>
void compare_distances(const Rows<Query>& rows, std::size_t a) {
    const auto& found = rows.found(a);
    const auto& expected = rows.expected(a);
    ASSERT_EQ(found.has_value(), expected.has_value()) << "row of instance " << a;
    if (found) {
        EXPECT_EQ(found->intersects, expected->intersects);
        EXPECT_EQ(found->distance, expected->distance);
        EXPECT_EQ(found->direction, expected->direction);
        EXPECT_EQ(found->unique, expected->unique);
    }
}

void check_distances(WorldOfPairs& world, const HardPairs& asked) {
    Rows<SeparationQuery> separations(world, SeparationQuery{.tolerance = asked.tolerance},
                                      asked.reach);
    Rows<ClosestPointQuery> closest(world, ClosestPointQuery{.tolerance = asked.tolerance},
                                    asked.reach);
    asked.for_each([&](std::size_t i, const PlacedPair& pair) {
        compare_distances(separations, 2 * i);
        compare_distances(closest, 2 * i);
        compare_distances(closest, 2 * i + 1);
        if (separations.found(2 * i)) {
            const SeparationResult found = separations.found_result(2 * i);
            check_separation(pair, found);
            check_same(found, closest.found_result(2 * i));
        } else {
            EXPECT_NE(pair.intersects(), Truth::yes);
            EXPECT_GT(oracle::boundary_distance(pair.a(), pair.b()),
                      asked.reach - 4.0 * pair.rounding());
        }
    });
}

}  // namespace

void check_tables(Context& context, const HardPairs& asked) {
    WorldOfPairs world(context, asked);
    check_tests(world, asked);
    check_penetrations(world, asked, PenetrationPoints::boundary);
    check_penetrations(world, asked, PenetrationPoints::vertices);
    check_all_contacts(world, asked);
    check_distances(world, asked);
}

}  // namespace nearfield::test
