// Searches for so many pairs that a stage has more workgroups than one row of a dispatch or, where
// shaders reach less memory than that, as lavapipe's do, several parts.

#include <tests/query/device_pairs.hpp>

#include <vector>

namespace nearfield::test {
namespace {

class DevicePairWorkgroups : public DevicePairsTest {
protected:
    using DevicePairsTest::compare;
    void compare(const PenetrationQuery& query, std::uint32_t least) {
        Tables<PenetrationQuery> tables(query);
        compare(tables);
        EXPECT_GE(tables.device.candidates(), least);
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
