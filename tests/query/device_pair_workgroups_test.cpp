// Searches for so many pairs that a stage has more workgroups than one row of a dispatch.

#include <tests/query/device_pairs.hpp>

#include <vector>

namespace nearfield::test {
namespace {

using DevicePairWorkgroups = DevicePairsTest;

TEST_F(DevicePairWorkgroups, OfMoreThanOneRow) {
    // 75,350 ordered pairs, all of whose 64 edges are near the other shape: 4.8 million edges.
    const ShapeHandle disc = add_shape(regular(64));
    Random random(1);
    std::vector<InstanceHandle> discs;
    for (int i = 0; i < 275; ++i) {
        discs.push_back(add(disc, any_pose(random, 0.05)));
    }
    PenetrationQuery query;
    query.tolerance = 0.01;
    query.points = PenetrationPoints::vertices;
    query.records = false;
    DevicePairTable<PenetrationQuery> by_device(query);
    const Status status = world().update(by_device);
    if (status.code() == StatusCode::too_large) {
        // Lavapipe's shaders reach 128 MiB of a buffer.
        EXPECT_NE(status.message().find("of a buffer"), std::string::npos) << status.text();
        return;
    }
    ASSERT_TRUE(status.ok()) << status.text();
    PairTable<PenetrationQuery> by_cpu(query, {.hits_only = true});
    ASSERT_TRUE(world().update(by_cpu).ok());
    std::uint32_t next = 0;
    for (const PairRow<PenetrationQuery>& expected : by_cpu.rows()) {
        if (expected.count == 0) {
            continue;  // crossing boundaries are a hit there
        }
        const Expected<PairRow<PenetrationQuery>> row = by_device.row(next++);
        ASSERT_TRUE(row.has_value()) << row.error().text();
        ASSERT_TRUE(row->a == expected.a && row->b == expected.b) << "row " << next - 1;
        ASSERT_EQ(row->count, expected.count) << "row " << next - 1;
        ASSERT_NEAR(row->deepest.depth, expected.deepest.depth, 1e-5) << "row " << next - 1;
    }
    EXPECT_EQ(by_device.size(), next);
    remove(discs);
}

}  // namespace
}  // namespace nearfield::test
