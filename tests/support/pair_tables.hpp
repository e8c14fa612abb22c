#pragma once

#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

/// \file
/// Tables of pairs by the device, and what is read of any.

namespace nearfield::test {

/// The options of a table of hits that the device finds.
inline constexpr PairTableOptions on_device{.hits_only = true, .technique = Technique::compute};
/// Of the same table by the CPU.
inline constexpr PairTableOptions on_cpu{.hits_only = true, .technique = Technique::cpu};
/// Of a list of pairs.
inline constexpr PairTableOptions of_list{.listed = true, .technique = Technique::cpu};

/// The same with a reach.
[[nodiscard]] inline PairTableOptions within(double reach, PairTableOptions options) {
    options.reach = reach;
    return options;
}

/// An update at poses that the host's commands write.
[[nodiscard]] inline PairTableInput at_poses(const DevicePoses& poses) {
    return {.poses = &poses};
}

/// The points of the row with this index.
template <class Query>
[[nodiscard]] std::vector<typename PairTable<Query>::Point> points_of(PairTable<Query>& table,
                                                                      std::uint32_t index) {
    const Expected<PairRow<Query>> row = table.row(index);
    EXPECT_TRUE(row.has_value()) << row.error().text();
    if (!row.has_value()) {
        return {};
    }
    const auto points = table.points(*row);
    EXPECT_TRUE(table.read_status().ok()) << table.read_status().text();
    EXPECT_EQ(points.size(), row->point_count);
    return {points.begin(), points.end()};
}

/// The manifold of the row with this index.
[[nodiscard]] inline std::vector<ContactCluster> manifold_of(PairTable<ContactQuery>& table,
                                                             std::uint32_t index) {
    const Expected<PairRow<ContactQuery>> row = table.row(index);
    EXPECT_TRUE(row.has_value()) << row.error().text();
    if (!row.has_value()) {
        return {};
    }
    const auto manifold = table.manifold(*row);
    EXPECT_TRUE(table.read_status().ok()) << table.read_status().text();
    return {manifold.begin(), manifold.end()};
}

}  // namespace nearfield::test
