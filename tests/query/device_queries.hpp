#pragma once

#include <tests/query/device_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace nearfield::test {

/// Worlds that the device is asked about, compared with the CPU bit for bit.
class DeviceQueriesTest : public DevicePairsTest {
protected:
    static void expect_equal(const RayHit& found, const RayHit& expected) {
        EXPECT_EQ(found.instance, expected.instance);
        EXPECT_EQ(found.parameter, expected.parameter);
        EXPECT_EQ(found.error_bound, expected.error_bound);
        EXPECT_EQ(found.point, expected.point);
        EXPECT_EQ(found.normal, expected.normal);
        EXPECT_EQ(found.edge, expected.edge);
    }
    static void expect_equal(const NearestHit& found, const NearestHit& expected) {
        EXPECT_EQ(found.instance, expected.instance);
        EXPECT_EQ(found.distance, expected.distance);
        EXPECT_EQ(found.error_bound, expected.error_bound);
        EXPECT_EQ(found.nearest, expected.nearest);
        EXPECT_EQ(found.feature.kind, expected.feature.kind);
        EXPECT_EQ(found.feature.index, expected.feature.index);
    }
    /// Returns how many name an instance.
    template <class Hit>
    static std::size_t expect_equal(const std::vector<Hit>& found,
                                    const std::vector<Hit>& expected) {
        std::size_t hits = 0;
        EXPECT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < expected.size() && !HasFailure(); ++i) {
            SCOPED_TRACE("question " + std::to_string(i));
            expect_equal(found[i], expected[i]);
            hits += expected[i].instance == InstanceHandle{} ? 0U : 1U;
        }
        return hits;
    }

    std::size_t compare(DeviceRays& rays, const std::vector<Segment>& segments,
                        const WorldFilter& filter = {}) {
        std::vector<RayHit> found(segments.size());
        std::vector<RayHit> expected(segments.size());
        const Status status = world().cast_rays(rays, segments, found, filter);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_TRUE(world().cast_rays(segments, expected, filter).ok());
        EXPECT_EQ(rays.size(), segments.size());
        return expect_equal(found, expected);
    }
    std::size_t compare(DeviceNearest& nearest, const NearestQuery& query,
                        const std::vector<Vector2>& points) {
        std::vector<NearestHit> found(points.size());
        std::vector<NearestHit> expected(points.size());
        const Status status = world().find_nearest(nearest, query, points, found);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_TRUE(world().find_nearest(query, points, expected).ok());
        EXPECT_EQ(nearest.size(), points.size());
        return expect_equal(found, expected);
    }

    static Vector2 any_place(Random& random, double extent, const Vector2& around = {}) {
        return {around.x + random.between(-extent, extent),
                around.y + random.between(-extent, extent)};
    }
    /// Segments of all lengths around a place.
    static std::vector<Segment> some_segments(Random& random, int count, double extent,
                                              const Vector2& around = {}) {
        std::vector<Segment> segments;
        for (int i = 0; i < count; ++i) {
            const double length = random.scale(1e-4, 3.0) * extent;
            const double angle = random.between(-4.0, 4.0);
            const Vector2 from = any_place(random, extent, around);
            segments.push_back(
                {from, {from.x + length * std::cos(angle), from.y + length * std::sin(angle)}});
        }
        return segments;
    }
    static std::vector<Vector2> some_points(Random& random, int count, double extent,
                                            const Vector2& around = {}) {
        std::vector<Vector2> points;
        for (int i = 0; i < count; ++i) {
            points.push_back(any_place(random, extent, around));
        }
        return points;
    }

    /// Shapes of all kinds, some times each.
    std::vector<InstanceHandle> add_some(Random& random, double extent,
                                         const Vector2& around = {}) {
        std::vector<InstanceHandle> added;
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = random.whole(1, 5); i > 0; --i) {
                Pose pose = any_pose(random, extent);
                pose.translation.x += around.x;
                pose.translation.y += around.y;
                added.push_back(add(shape, pose));
            }
        }
        return added;
    }

    /// Squares in several categories; `compare(square, filter)` asks about those that filters
    /// consider.
    template <class Compare>
    std::vector<InstanceHandle> consider_filters(Random& random, const Compare& compare) {
        const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        std::vector<InstanceHandle> added;
        for (int i = 0; i < 100; ++i) {
            added.push_back(add(square, any_pose(random, 7.0)));
            const auto bits = static_cast<std::uint32_t>(1 << random.whole(0, 2));
            EXPECT_TRUE(world().set_filter(added.back(), bits, 7 - bits).ok());
        }
        for (std::uint32_t bits = 0; bits < 8; ++bits) {
            compare(square,
                    WorldFilter{.category = 7 - bits / 2, .mask = bits, .ignored = added[bits]});
        }
        return added;
    }

    /// Squares of side 1 that share edges and vertices, from (0, 0) to (6, 6), with tiny holes in
    /// some; one of them twice; and needles along some of their edges.
    std::vector<InstanceHandle> add_tiles(const Vector2& at = {}) {
        const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        Rings holed = rectangle({0.0, 0.0}, {1.0, 1.0});
        holed.push_back({{0.5, 0.5}, {0.5, 0.5 + 1e-9}, {0.5 + 1e-9, 0.5}});
        const ShapeHandle with_hole = add_shape(holed);
        const ShapeHandle needle = add_shape({{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1e-9}}});
        std::vector<InstanceHandle> added;
        for (int i = 0; i < 36; ++i) {
            const Vector2 place{at.x + i % 6, at.y + i / 6};
            added.push_back(add(i % 5 == 0 ? with_hole : square, {place, 0.0}));
            if (i % 7 == 0) {
                added.push_back(add(needle, {place, 0.0}));
                added.push_back(add(square, {place, 0.0}));
            }
        }
        return added;
    }
    /// Places on a raster, where tiles have vertices, middles of edges and centres.
    static Vector2 place_of_tiles(Random& random, const Vector2& at = {}) {
        return {at.x + 0.5 * random.whole(-1, 13), at.y + 0.5 * random.whole(-1, 13)};
    }
    static std::vector<Segment> segments_of_tiles(Random& random, int count,
                                                  const Vector2& at = {}) {
        std::vector<Segment> segments;
        for (int i = 0; i < count; ++i) {
            segments.push_back({place_of_tiles(random, at), place_of_tiles(random, at)});
        }
        return segments;
    }
    static std::vector<Vector2> points_of_tiles(Random& random, int count, const Vector2& at = {}) {
        std::vector<Vector2> points;
        for (int i = 0; i < count; ++i) {
            points.push_back(place_of_tiles(random, at));
        }
        return points;
    }
};

}  // namespace nearfield::test
