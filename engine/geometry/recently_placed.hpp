#pragma once

#include <engine/geometry/transformed_polygon.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::geometry {

struct BoxedPolygon {
    TransformedPolygon placed;
    Box box;

    BoxedPolygon(const Polygon& polygon, const Pose& pose)
        : placed(polygon, pose), box(placed.box()) {}
};

/// Polygons at poses, with their boxes: many pairs of a batch have an instance in common, whose
/// sine, cosine and box are computed once as long as others do not take its place. Neither the
/// polygons nor their rings are looked at before they are placed anew. Precondition: polygons of
/// different times have different addresses or revisions.
class RecentlyPlaced {
public:
    /// How many it remembers at most.
    explicit RecentlyPlaced(std::size_t count) : entries_(count) {}

    [[nodiscard]] BoxedPolygon place(const Polygon& polygon, const Pose& pose);

private:
    /// Of a pose, bit for bit.
    using PoseBits = std::array<std::uint64_t, 3>;
    struct Entry {
        std::uint64_t revision = 0;
        PoseBits pose{};
        std::optional<BoxedPolygon> instance;
    };

    std::vector<Entry> entries_;  // by hash
};

}  // namespace nearfield::geometry
