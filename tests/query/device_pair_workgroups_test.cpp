// Searches for so many pairs that a stage has more workgroups than one row of a dispatch or, where
// shaders reach less memory than that, as lavapipe's do, several parts.

#include <tests/query/device_pairs.hpp>

#include <vector>

namespace nearfield::test {
namespace {

class DevicePairWorkgroups : public DevicePairsTest {
protected:
    /// Updates a table and one of the CPU, whose rows it has to have.
    void compare(const PenetrationQuery& query, std::uint32_t least) {
        PairTable<PenetrationQuery> by_device(query, on_device);
        const Status status = world().update(by_device);
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_GE(by_device.candidates(), least);
        PairTable<PenetrationQuery> by_cpu(query, on_cpu);
        ASSERT_TRUE(world().update(by_cpu).ok());
        std::uint32_t next = 0;
        for (const PairRow<PenetrationQuery>& expected : by_cpu.rows()) {
            const Expected<PairRow<PenetrationQuery>> row = by_device.row(next++);
            ASSERT_TRUE(row.has_value()) << row.error().text();
            ASSERT_TRUE(row->a == expected.a && row->b == expected.b) << "row " << next - 1;
            ASSERT_EQ(row->count, expected.count) << "row " << next - 1;
            ASSERT_NEAR(row->deepest.depth, expected.deepest.depth, 1e-5) << "row " << next - 1;
        }
        EXPECT_EQ(by_device.size(), next);
    }
};

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
    query.summary_only = true;
    compare(query, 75350);
    remove(discs);
}

TEST_F(DevicePairWorkgroups, OfAHundredThousandPairsOfSamples) {
    Random random(2);
    const ShapeHandle shape = add_shape(star(random, 50, 0.5));
    std::vector<InstanceHandle> stars;
    for (int i = 0; i < 1000; ++i) {
        stars.push_back(add(shape, any_pose(random, 5.0)));
    }
    compare({.tolerance = 0.03, .summary_only = true}, 90000);
    remove(stars);
}

}  // namespace
}  // namespace nearfield::test
