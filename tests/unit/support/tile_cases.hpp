#pragma once

#include <engine/geometry/transformed_polygon.hpp>
#include <engine/queries/simplified_shapes.hpp>
#include <engine/queries/tile_edges.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {

inline constexpr std::uint32_t width = 40;
inline constexpr std::uint32_t height = 24;

/// A shape over, around or beside a tile of 40 x 24 cells of side 1 with its low corner at the
/// origin.
struct TileCase {
    std::string name;
    geometry::Polygon polygon;
    Pose pose;
    queries::SimplifiedShapes shapes;
    std::optional<queries::TileBoundary> placed;

    TileCase(const NamedRings& shape, std::uint64_t seed, double deviation) {
        Random random(seed);
        const double size = random.scale(3.0, 3e5);
        name = shape.name + ", seed " + std::to_string(seed);
        EXPECT_TRUE(polygon.assign(scaled_and_moved(shape.rings, size, {})).ok()) << name;
        pose = {{random.between(-0.7, 0.7) * size + 0.5 * width,
                 random.between(-0.7, 0.7) * size + 0.5 * height},
                random.between(0.0, 7.0)};
        placed.emplace(shapes.get(polygon, deviation, 64.0),
                       queries::ToCells(geometry::TransformedPolygon(polygon, pose),
                                        geometry::Vector::Zero(), 1.0));
    }

    [[nodiscard]] const queries::TileBoundary& boundary() const { return *placed; }
};

inline std::vector<std::unique_ptr<TileCase>> cases(double deviation) {
    std::vector<std::unique_ptr<TileCase>> all;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        for (const NamedRings& shape : every_family(seed)) {
            all.push_back(std::make_unique<TileCase>(shape, 1000 * seed + all.size(), deviation));
        }
    }
    return all;
}

}  // namespace nearfield::test
