#include <tests/query/agreement.hpp>
#include <tests/query/all_numbers.hpp>
#include <tests/query/check.hpp>
#include <tests/query/device_offers.hpp>
#include <tests/query/field_laws.hpp>
#include <tests/query/hard_pairs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t hard_pairs_seed = 1'000'000;

/// What was asked about a pair in a batch, and answered: by technique compute and by cpu.
struct Answers {
    const PlacedPair& pair;
    const AnyQuery* queries;
    const AnyResult* found;
    const AnyResult* expected;

    template <class Result>
    [[nodiscard]] const Result& get(std::size_t i) const {
        return std::get<Result>(found[i]);
    }
    template <class Result>
    [[nodiscard]] const Result& of_cpu(std::size_t i) const {
        return std::get<Result>(expected[i]);
    }
};

/// Every query that the device answers, about pairs that are easily answered wrong: in one batch by
/// technique compute, and by the pair tables of a world. Answers are compared with the oracle and
/// with technique cpu.
class ManyPairs : public FieldLaws {
protected:
    static void check_batch(const HardPairs& asked) {
        const Batch batch = batch_of(asked, Technique::compute);
        const Batch by_cpu = batch_of(asked, Technique::cpu);
        Results found;
        Results expected;
        ASSERT_TRUE(context().run(batch, found).ok());
        ASSERT_TRUE(context().run(by_cpu, expected).ok());
        const std::size_t each = batch.queries().size() / asked.pairs.size();
        asked.for_each([&](std::size_t i, const PlacedPair& pair) {
            const Answers answers{pair, &batch.queries()[each * i], &found.results[each * i],
                                  &expected.results[each * i]};
            check_points(answers);
            check_closest(answers);
            check_intersections(answers);
            check_field(answers);
        });
    }

private:
    // Positions of the queries about a pair.
    static constexpr std::size_t contacts = 2;
    static constexpr std::size_t without_records = 3;
    static constexpr std::size_t separation = 6;
    static constexpr std::size_t intersections = 8;
    static constexpr std::size_t field = 11;

    static Batch batch_of(const HardPairs& asked, Technique technique) {
        Batch batch;
        const auto add = [&](auto query) {
            query.technique = technique;
            batch.add(query);
        };
        for (std::size_t i = 0; i < asked.pairs.size(); ++i) {
            const PlacedPair& pair = *asked.pairs[i];
            for (const bool records : {true, false}) {
                for (const PenetrationPoints points : both_ways) {
                    PenetrationQuery query = pair.penetration(points);
                    query.summary_only = !records;
                    add(query);
                }
                ContactQuery query = pair.contacts(asked.contact_distance);
                query.summary_only = !records;
                add(query);
            }
            add(pair.separation());
            add(pair.closest_point());
            for (const IntersectionKind kind : every_kind) {
                add(pair.intersection(kind));
            }
            add(field_of(pair, asked.field_tolerances[i]));
        }
        return batch;
    }

    static DistanceFieldQuery field_of(const PlacedPair& pair, double tolerance) {
        DistanceFieldQuery query;
        query.b = pair.instance_b();
        query.tolerance = tolerance;
        const Rectangle box = pair.b().box();
        query.rectangle = {{box.min.x - tolerance, box.min.y - tolerance},
                           {box.max.x + tolerance, box.max.y + tolerance}};
        query.features = query.gradients = true;
        return query;
    }

    static void check_points(const Answers& answers) {
        for (std::size_t i = 0; i < both_ways.size(); ++i) {
            check_penetration(answers.pair, both_ways[i], answers.get<PenetrationResult>(i));
            check_without_records(answers, i);
        }
        const auto& query = std::get<ContactQuery>(answers.queries[contacts]);
        check_contacts(answers.pair, query.contact_distance, answers.get<ContactResult>(contacts));
        const auto& without = answers.get<ContactResult>(without_records + contacts);
        EXPECT_EQ(without.count, answers.get<ContactResult>(contacts).count) << "without records";
        for (std::size_t i = 0; i <= contacts; ++i) {
            check_agreement(
                {.pair = answers.pair, .query = answers.queries[i], .mostly_equal = false},
                answers.found[i], by_technique_of(answers.found[i], answers.expected[i]));
        }
    }

    /// Of points that are equally deep or near, and of features that are equally near, any may be
    /// named: which, depends on the points that the device looks at together.
    static void check_without_records(const Answers& answers, std::size_t i) {
        const auto& with = answers.get<PenetrationResult>(i);
        const auto& without = answers.get<PenetrationResult>(without_records + i);
        EXPECT_EQ(without.count, with.count) << "without records";
        EXPECT_EQ(without.intersects, with.intersects);
        EXPECT_EQ(without.error_bound, with.error_bound);
        if (with.count > 0) {
            EXPECT_NEAR(without.deepest.depth, with.deepest.depth, with.tolerance / 1000.0);
        }
    }

    static void check_closest(const Answers& answers) {
        const auto& found = answers.get<SeparationResult>(separation);
        const auto& closest = answers.get<ClosestPointResult>(separation + 1);
        check_separation(answers.pair, found);
        check_same(found, closest);
        const auto& expected = answers.of_cpu<SeparationResult>(separation);
        EXPECT_EQ(found.distance, expected.distance);
        EXPECT_EQ(found.intersects, expected.intersects);
        EXPECT_EQ(found.unique, expected.unique);
        EXPECT_EQ(closest.unique, answers.of_cpu<ClosestPointResult>(separation + 1).unique);
    }

    static void check_intersections(const Answers& answers) {
        for (std::size_t i = 0; i < every_kind.size(); ++i) {
            const std::size_t at = intersections + i;
            check_intersection(answers.pair, every_kind[i], answers.get<IntersectionResult>(at));
            if (has_grid_of_cpu(host_device())) {
                check_agreement({answers.pair, answers.queries[at]}, answers.found[at],
                                by_technique_of(answers.found[at], answers.expected[at]));
            }
        }
    }

    /// At some of the cells, as the field is the query that needs most of the oracle's time.
    static void check_field(const Answers& answers) {
        constexpr std::size_t cells = 200;
        const auto& query = std::get<DistanceFieldQuery>(answers.queries[field]);
        const auto& found = answers.get<DistanceFieldResult>(field);
        test::check_field(answers.pair.b(), query.tolerance, found, cells);
        check_cells(answers.pair.b(), query, found, cells);
        const auto& expected = answers.of_cpu<DistanceFieldResult>(field);
        ASSERT_EQ(found.values.size(), expected.values.size());
        const double most = found.error_bound + expected.error_bound + answers.pair.rounding();
        Report report("fields by compute and cpu");
        for (std::size_t i = 0; i < found.values.size(); ++i) {
            const auto one = static_cast<double>(found.values[i]);
            const auto other = static_cast<double>(expected.values[i]);
            report.require(std::abs(one - other) <= most, "cell ", i, " is ", one, " and ", other);
        }
    }
};

TEST_F(ManyPairs, AreAnsweredRightByEveryQuery) {
    constexpr int pairs_per_case = 32;
    for_each_case(hard_pairs_seed, 2, [&](Random& random) {
        const HardPairs pairs(context(), random, pairs_per_case);
        check_batch(pairs);
        check_tables(context(), pairs);
    });
}

}  // namespace
}  // namespace nearfield::test
