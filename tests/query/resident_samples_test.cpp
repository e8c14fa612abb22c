#include <tests/query/resident_test.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t sample_seed = 8300;
constexpr std::array kinds_of_samples{IntersectionKind::boundary_boundary,
                                      IntersectionKind::boundary_volume,
                                      IntersectionKind::volume_volume};

using KeptSamples = Kept<IntersectionQuery>;

double per_axis(const Vector2& a, const Vector2& b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
}

bool holds(const Region& region, const Vector2& point) {
    return point.x > region.min.x && point.x < region.max.x && point.y > region.min.y &&
           point.y < region.max.y;
}

void check_kept_summary(const KeptSamples& kept) {
    const IntersectionSummaryData& summary = kept.contents.summary;
    const IntersectionResult& result = kept.result;
    const double bound = kept.output.error_bound;
    EXPECT_EQ(summary.capacity, kept.output.capacity);
    EXPECT_EQ(kept.output.size, sizeof(IntersectionSummaryData) +
                                    kept.output.capacity * sizeof(IntersectionSampleData));
    ASSERT_EQ(summary.count, result.count);
    EXPECT_EQ(kept.output.cell, result.cell);
    EXPECT_EQ(summary.cell, static_cast<float>(result.cell));
    const double area = static_cast<double>(result.count) * result.cell * result.cell;
    EXPECT_NEAR(summary.area, area, std::ldexp(area, -21));
    const Vector2 origin = kept.output.origin;
    const Vector2 low{origin.x + summary.low[0], origin.y + summary.low[1]};
    const Vector2 high{origin.x + summary.high[0], origin.y + summary.high[1]};
    if (result.count > 0) {
        EXPECT_LE(per_axis(low, result.box.min), bound);
        EXPECT_LE(per_axis(high, result.box.max), bound);
    } else {
        EXPECT_EQ(per_axis(low, origin) + per_axis(high, origin), 0.0);
    }
}

void check_kept_sample(const PlacedPair& pair, const KeptSamples& kept, std::size_t i) {
    const SampleContents& sample = kept.contents.samples[i];
    const IntersectionSample& expected = kept.result.samples[i];
    const double bound = kept.output.error_bound;
    ASSERT_LE(per_axis(sample.point, expected.position), bound) << "sample " << i;
    ASSERT_LT(sample.region, kept.result.regions.size());
    ASSERT_TRUE(holds(kept.result.regions[sample.region], sample.point)) << "sample " << i;
    if (sample.edge != expected.edge) {
        ASSERT_LT(sample.edge, pair.a().size()) << "sample " << i;
        const auto distance = [&](std::uint32_t edge) {
            return pair.a().nearest_on_edge(edge, expected.position).distance;
        };
        ASSERT_LE(std::abs(distance(sample.edge) - distance(expected.edge)), 2.0 * bound)
            << "sample " << i << " names edge " << sample.edge << " and " << expected.edge;
    }
}

/// Expects the same samples in the same order, and a summary of them.
void check_kept(const PlacedPair& pair, const KeptSamples& kept) {
    ASSERT_TRUE(kept.result.status.ok()) << kept.result.status.text();
    ASSERT_NO_FATAL_FAILURE(check_kept_summary(kept));
    std::uint64_t cells = 0;
    for (const Region& region : kept.result.regions) {
        cells += std::uint64_t{region.width} * region.height;
    }
    EXPECT_EQ(kept.output.capacity, cells);
    const std::vector<SampleContents>& samples = kept.contents.samples;
    ASSERT_EQ(samples.size(), kept.result.samples.size());
    std::size_t other_edges = 0;  // as near as those that the CPU reports
    for (std::size_t i = 0; i < samples.size(); ++i) {
        ASSERT_NO_FATAL_FAILURE(check_kept_sample(pair, kept, i));
        other_edges += samples[i].edge != kept.result.samples[i].edge ? 1U : 0U;
    }
    EXPECT_LE(other_edges, 1 + samples.size() / 50);
    if (!samples.empty()) {
        Vector2 low = samples.front().own_point;
        Vector2 high = low;
        for (const SampleContents& sample : samples) {
            low = {std::min(low.x, sample.own_point.x), std::min(low.y, sample.own_point.y)};
            high = {std::max(high.x, sample.own_point.x), std::max(high.y, sample.own_point.y)};
        }
        const IntersectionSummaryData& summary = kept.contents.summary;
        EXPECT_EQ((Vector2{summary.low[0], summary.low[1]}), low);
        EXPECT_EQ((Vector2{summary.high[0], summary.high[1]}), high);
    }
}

class ResidentIntersections : public Resident {
protected:
    /// All kinds.
    std::size_t check_all(const Pair& shapes) {
        std::size_t found = 0;
        const PlacedPair pair(context(), shapes, Technique::compute);
        for (const IntersectionKind kind : kinds_of_samples) {
            IntersectionQuery query = pair.intersection(kind);
            SCOPED_TRACE(static_cast<int>(kind));
            const KeptSamples kept = keep(context(), query);
            check_kept(pair, kept);
            EXPECT_EQ(kept.result.technique, Technique::compute);
            found += kept.contents.samples.size();
        }
        return found;
    }
};

TEST_F(ResidentIntersections, SamplesAreThoseThatComeBack) {
    std::size_t found = 0;
    for_each_case(sample_seed, 12, [&](Random& random) {
        const Pair shapes = any_pair(random);
        SCOPED_TRACE(describe(shapes));
        found += check_all(shapes);
    });
    EXPECT_GT(found, 5000U);
}

TEST_F(ResidentIntersections, SamplesOfEveryFamily) {
    int number = 0;
    for (const Pair& made : family_pairs(sample_seed)) {
        SCOPED_TRACE(describe(made));
        const PlacedPair pair(context(), made, Technique::compute);
        IntersectionQuery query =
            pair.intersection(kinds_of_samples[static_cast<std::size_t>(number++) % 3]);
        const KeptSamples kept = keep(context(), query);
        check_kept(pair, kept);
    }
}

TEST_F(ResidentIntersections, EdgesOfRealOutlines) {
    const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
    std::size_t named = 0;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const oracle::ShapeOracle shape(outlines[i].rings);
        const auto [low, high] = shape.box();
        const double side = std::max(high.x - low.x, high.y - low.y);
        const Pose moved{{0.05 * side, 0.02 * side}, 0.0};
        const PlacedPair pair(context(), {outlines[i], outlines[i], {}, moved, side / 300},
                              Technique::compute);
        SCOPED_TRACE(outlines[i].name);
        const KeptSamples kept =
            keep(context(), pair.intersection(IntersectionKind::boundary_volume));
        check_kept(pair, kept);
        named += kept.contents.samples.size();
    }
    EXPECT_GT(named, 1000U);
}

/// A context whose atlas is so small that intersections take many tiles and tile batches.
Expected<Context> context_of_many_rounds(const HostDevice& host) {
    Settings settings;
    settings.memory_limit = std::uint64_t{24} << 20U;
    return Context::create(host, on_demand(settings));
}

Pair pair_of_many_rounds() {
    Random random(sample_seed);
    const Rings rings = with_holes(random, 3);
    return {{"turned", rings}, {"holes", rings}, {{0.03, 0.02}, 0.12}, {}, 0.0042};
}

TEST_F(ResidentIntersections, SamplesOfManyRoundsStayInOrder) {
    Expected<Context> made = context_of_many_rounds(host_device());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const PlacedPair pair(*made, pair_of_many_rounds(), Technique::compute);
    for (const IntersectionKind kind :
         {IntersectionKind::volume_volume, IntersectionKind::boundary_volume}) {
        const KeptSamples kept = keep(*made, pair.intersection(kind));
        check_kept(pair, kept);
        EXPECT_GT(kept.output.capacity, 256U * 256U);
        EXPECT_GT(kept.contents.samples.size(), 1000U);
    }
}

TEST_F(ResidentIntersections, WhatComesBackAndWhatStaysAreAskedForApart) {
    const PlacedPair pair(context(), pair_of_many_rounds(), Technique::compute);
    for (const IntersectionKind kind : kinds_of_samples) {
        IntersectionQuery query = pair.intersection(kind);
        query.tolerance = 0.02;
        const KeptSamples all = keep(context(), query);
        query.summary_only = true;
        KeptSamples none_back = keep(context(), query);
        EXPECT_TRUE(none_back.result.samples.empty());
        EXPECT_EQ(none_back.contents.samples.size(), all.result.samples.size());
        none_back.result.samples = all.result.samples;
        check_kept(pair, none_back);
        query.samples_on_device = false;
        const KeptSamples summary = keep(context(), query);
        EXPECT_GT(summary.result.count, 0U);
        EXPECT_EQ(summary.output.capacity, 0U);
        check_kept_summary(summary);
        query.summary_only = false;
        const KeptSamples summary_stays = keep(context(), query);
        EXPECT_EQ(summary_stays.result.samples.size(), all.result.samples.size());
        check_kept_summary(summary_stays);
    }
}

TEST_F(ResidentIntersections, WhereNothingMeetsTheSummaryIsEmpty) {
    const NamedRings square{"square", rectangle({0.0, 0.0}, {1.0, 1.0})};
    // Disjoint boxes; and overlapping boxes of disjoint shapes.
    const NamedRings corner{"corner", {{{0.0, 0.0}, {3.0, 0.0}, {0.0, 3.0}}}};
    for (const Pair& apart : {Pair{square, square, {}, {{5.0, 0.0}, 0.0}, 0.05},
                              Pair{corner, square, {}, {{1.9, 1.9}, 0.0}, 0.05}}) {
        const PlacedPair pair(context(), apart, Technique::compute);
        for (const IntersectionKind kind : kinds_of_samples) {
            const KeptSamples kept = keep(context(), pair.intersection(kind));
            check_kept(pair, kept);
            EXPECT_EQ(kept.contents.summary.count, 0U);
        }
    }
}

TEST_F(ResidentIntersections, OfManyQueriesInFlightEachHasItsOwn) {
    Expected<Context> made = context_of_many_rounds(host_device());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const PlacedPair pair(*made, pair_of_many_rounds(), Technique::compute);
    const auto submit = [&](int number) {
        Batch batch;
        for (const double tolerance : {0.01, 0.02}) {
            PenetrationQuery depths = pair.penetration();
            depths.on_device = true;
            depths.tolerance = 0.02;
            batch.add(depths);
            for (const IntersectionKind kind : kinds_of_samples) {
                IntersectionQuery query = pair.intersection(kind);
                query.tolerance = tolerance;
                query.b.pose.translation.x += 0.02 * number;
                query.on_device = true;
                batch.add(query);
            }
        }
        const Expected<Ticket> ticket = made->submit(batch);
        EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
        return ticket.has_value() ? *ticket : Ticket{};
    };
    Ticket former = submit(0);
    for (int number = 1; number < 5; ++number) {
        const Ticket next = submit(number);
        std::vector<KeptSamples> kept(8);
        for (std::uint32_t i = 0; i < 8; ++i) {
            if (i % 4 != 0) {
                const auto resident = made->on_device(former, QueryHandle<IntersectionQuery>{i});
                ASSERT_TRUE(resident.has_value()) << resident.error().text();
                kept[i].output = *resident;
                kept[i].contents = contents_of(*resident);
            }
        }
        Results results;
        ASSERT_TRUE(made->collect(former, results).ok());
        for (std::uint32_t i = 0; i < 8; ++i) {
            if (i % 4 != 0) {
                kept[i].result = results[QueryHandle<IntersectionQuery>{i}];
                check_kept(pair, kept[i]);
            }
        }
        former = next;
    }
    Results results;
    ASSERT_TRUE(made->collect(former, results).ok());
}

TEST_F(ResidentIntersections, RecordedIntoAHostsCommandsTheyAreTheSame) {
    Expected<Context> made = Context::create(host_device(), on_demand());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    test_support::HostFrames host(host_device(), 1);
    std::uint64_t number = 0;
    const PlacedPair pair(*made, pair_of_many_rounds(), Technique::compute);
    for (const IntersectionKind kind : kinds_of_samples) {
        IntersectionQuery query = pair.intersection(kind);
        query.tolerance = 0.01;
        query.on_device = true;
        Batch batch;
        const auto handle = batch.add(query);
        const VkCommandBuffer commands = host.begin(number);
        const Expected<Ticket> ticket =
            made->record(batch, {.commands = commands, .frame = number});
        ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
        host.submit(number);
        const auto resident = made->on_device(*ticket, handle);
        ASSERT_TRUE(resident.has_value()) << resident.error().text();
        KeptSamples kept{*resident, contents_of(*resident), {}};
        host.wait(number);
        made->frame_completed(number++);
        Results results;
        ASSERT_TRUE(made->collect(*ticket, results).ok());
        kept.result = results[handle];
        check_kept(pair, kept);
        EXPECT_GT(kept.result.count, 100U);
    }
}

TEST_F(ResidentIntersections, RefusesByName) {
    const ShapeHandle square = *context().add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    IntersectionQuery query{{square, {}}, {square, {}}, 0.1};
    Batch batch;
    const auto not_resident = batch.add(query);
    query.on_device = true;
    query.technique = Technique::cpu;
    const auto of_cpu = batch.add(query);
    query.technique = Technique::compute;
    query.tolerance = 0.00001;
    query.summary_only = true;
    const auto of_huge = batch.add(query);
    const Expected<Ticket> ticket = context().submit(batch);
    ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
    const auto expect = [&](const QueryHandle<IntersectionQuery>& handle, StatusCode code,
                            const char* words) {
        const auto answer = context().on_device(*ticket, handle);
        EXPECT_FALSE(answer.has_value());
        EXPECT_EQ(answer.error().code(), code) << answer.error().text();
        EXPECT_NE(answer.error().message().find(words), std::string::npos) << answer.error().text();
    };
    expect(not_resident, StatusCode::invalid_query, "did not ask");
    expect(of_cpu, StatusCode::invalid_query, "technique cpu");
    expect(of_huge, StatusCode::too_large, "samples_on_device");
    Results results;
    ASSERT_TRUE(context().collect(*ticket, results).ok());
    EXPECT_EQ(results[of_huge].status.code(), StatusCode::too_large);
    EXPECT_TRUE(context().remove_shape(square).ok());
}

}  // namespace
}  // namespace nearfield::test
