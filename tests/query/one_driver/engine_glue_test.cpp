#include <tests/query/query_test.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/host_gpu.hpp>

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

#include <docs/engine_glue.hpp>  // the code of docs/engine_glue.md

class EngineGlue : public QueryTest {};

TEST_F(EngineGlue, AnswersEveryFrame) {
    Random random(8800);
    const Rings rings_a = coast(random, 100, 0.5);
    const Rings rings_b = with_holes(random, 3);
    test_support::HostFrames host(host_device(), Proximity::frames);
    Proximity proximity(host_device());
    const Instance a{*proximity.context().add_shape(rings_a), {}};
    const ShapeHandle b = *proximity.context().add_shape(rings_b);
    std::vector<ContactQuery> asked;
    std::vector<QueryHandle<ContactQuery>> handles;
    PointsOnDevice last;
    for (std::uint64_t frame = 0; frame < 8; ++frame) {
        ContactQuery query{a, {b, {{0.05 * static_cast<double>(frame), 0.1}, 0.3}}, 0.04, 0.05};
        query.on_device = true;
        asked.push_back(query);
        Batch batch;
        handles.push_back(batch.add(query));
        const auto records = proximity.record(host.begin(frame), frame, batch, handles.back());
        ASSERT_TRUE(records.has_value()) << records.error().text();
        last = *records;
        host.submit(frame);
        if (frame >= Proximity::frames) {
            const std::uint64_t former = frame - Proximity::frames;
            ContactQuery alone = asked[former];
            alone.on_device = false;
            alone.a.shape = *context().add_shape(rings_a);
            alone.b.shape = *context().add_shape(rings_b);
            alone.technique = Technique::compute;
            const ContactResult expected = run_alone(context(), alone);
            const ContactResult& found = proximity.results()[handles[former]];
            ASSERT_GT(found.points.size(), 10U);
            EXPECT_EQ(found.points.size(), expected.points.size());
            EXPECT_TRUE(context().remove_shape(alone.a.shape).ok());
            EXPECT_TRUE(context().remove_shape(alone.b.shape).ok());
        }
    }
    for (const std::uint64_t frame : {5U, 6U, 7U}) {
        host.wait(frame);
    }
    test_support::HostGpu gpu(host_device());
    SummaryData summary;
    std::memcpy(static_cast<void*>(&summary),
                gpu.read(last.buffer, last.offset, sizeof(summary), last.state).data(),
                sizeof(summary));
    EXPECT_GT(summary.count, 10U);
}

}  // namespace
}  // namespace nearfield::test
