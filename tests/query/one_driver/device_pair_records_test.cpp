#include <tests/query/device_pairs.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::test {
namespace {

/// The records of rows that the device finds, far from the origin, where double precision hardly
/// resolves the tolerance.
class DevicePairRecords : public DevicePairsTest {};

TEST_F(DevicePairRecords, AreAsManyAsTheirRowsCount) {
    std::uint32_t records_of_all = 0;
    for_each_case(29000, 6, [&](Random& random) {
        std::vector<InstanceHandle> added;
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = 0; i < 4; ++i) {
                Pose pose = any_pose(random, 3.0);
                pose.translation.x += 1e9;
                added.push_back(add(shape, pose));
            }
        }
        for (const PenetrationPoints points :
             {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
            PairTable table(PenetrationQuery{.tolerance = 1.12e-3, .points = points}, on_device);
            ASSERT_TRUE(world().update(table).ok());
            for (std::uint32_t i = 0; i < table.size(); ++i) {
                const std::vector<PenetratingPoint> records = points_of(table, i);
                EXPECT_EQ(records.size(), table.row(i)->count) << "row " << i;
                records_of_all += static_cast<std::uint32_t>(records.size());
            }
        }
        remove(added);
    });
    EXPECT_GT(records_of_all, 10000U);
}

}  // namespace
}  // namespace nearfield::test
