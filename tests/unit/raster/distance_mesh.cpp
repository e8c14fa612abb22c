#include <engine/geometry/clip.hpp>
#include <engine/raster/distance_mesh.hpp>

#include <gtest/gtest.h>
#include <tests/support/degenerate_polygons.hpp>
#include <tests/support/polygons.hpp>
#include <tests/support/scanline.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>

namespace nearfield {
namespace {

using geometry::Box;
using geometry::Mesh;
using geometry::Vector;
using raster::DistanceMesh;
using raster::DistanceMeshOptions;
using support::Tile;

constexpr double float_slack = 1e-4;

struct Feature {
    Vector a, b;  // equal: a vertex
};

struct Drawing {
    std::vector<Feature> features;  // by id
    Mesh mesh;
};

Mesh triangles_of(DistanceMesh& mesh) {
    const float farthest = mesh.place();
    Mesh triangles;
    mesh.for_each_triangle([&](const std::array<geometry::MeshVertex, 3>& triangle) {
        for (const geometry::MeshVertex& vertex : triangle) {
            EXPECT_LE(vertex.distance, farthest);
        }
        triangles.insert(triangles.end(), triangle.begin(), triangle.end());
    });
    EXPECT_LE(triangles.size(), 3 * mesh.max_triangles());
    return triangles;
}

Mesh tent(const Vector& a, const Vector& b, double reach, const DistanceMeshOptions& options) {
    DistanceMesh mesh;
    mesh.begin(options);
    mesh.add_tent(a, b, raster::tangent(a, b), {reach, reach}, 0);
    return triangles_of(mesh);
}

Mesh cone_sector(const Vector& before, const Vector& v, const Vector& after, double reach,
                 const DistanceMeshOptions& options) {
    DistanceMesh mesh;
    mesh.begin(options);
    mesh.add_cone_sector(raster::tangent(before, v), v, raster::tangent(v, after), reach, 3);
    return triangles_of(mesh);
}

// Clips an edge to the part that can be nearest to a sample of the tile, as callers do.
bool clip_to_neighbourhood(Vector& a, Vector& b, const Tile& tile, double reach) {
    const double margin = reach + 1.0;
    return geometry::clip_to_slab(a, b, 0, -margin, tile.width + margin) &&
           geometry::clip_to_slab(a, b, 1, -margin, tile.height + margin);
}

Drawing draw(const support::Rings& rings, const Tile& tile, double reach,
             const DistanceMeshOptions& options) {
    Drawing drawing;
    DistanceMesh mesh;
    mesh.begin(options);
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector& before = ring[(i + ring.size() - 1) % ring.size()];
            Vector v = ring[i];
            Vector after = ring[(i + 1) % ring.size()];
            auto id = static_cast<std::uint32_t>(drawing.features.size());
            drawing.features.push_back({v, after});
            drawing.features.push_back({v, v});
            Vector start = v;
            Vector end = after;
            if (clip_to_neighbourhood(start, end, tile, reach)) {
                mesh.add_tent(start, end, raster::tangent(start, end), {reach, reach}, id);
            }
            start = end = v;
            if (clip_to_neighbourhood(start, end, tile, reach)) {
                mesh.add_cone_sector(raster::tangent(before, v), v, raster::tangent(v, after),
                                     reach, id + 1);
            }
        }
    }
    drawing.mesh = triangles_of(mesh);
    return drawing;
}

double distance_to(const Feature& feature, const Vector& p) {
    return support::distance_to_segment(p, feature.a, feature.b);
}

double true_distance(const std::vector<Feature>& features, const Vector& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Feature& feature : features) {
        least = std::min(least, distance_to(feature, p));
    }
    return least;
}

// Every sample within reach must be covered with the correct distance; the winning feature must be
// correct wherever one wins.
void expect_law(const support::DegeneratePolygon& polygon, const Tile& tile, double reach,
                double error) {
    const Drawing drawing = draw(polygon.rings, tile, reach, {.error = error, .grid = tile.grid});
    const auto image = support::draw_nearest(tile, drawing.mesh);
    for (std::uint32_t row = 0; row < tile.height; ++row) {
        for (std::uint32_t column = 0; column < tile.width; ++column) {
            const Vector p = Tile::centre(column, row);
            const auto& hit = image[tile.index(column, row)];
            const double expected = true_distance(drawing.features, p);
            const bool is_hit = hit.id < drawing.features.size();
            const bool must_be_hit = expected <= reach - 1e-9;
            if (!must_be_hit && !is_hit) {
                continue;
            }
            ASSERT_TRUE(is_hit) << "crack: " << polygon.name << " reach " << reach << " at "
                                << p.transpose();
            ASSERT_LE(distance_to(drawing.features[hit.id], p), expected + error + float_slack)
                << polygon.name << " reach " << reach << " at " << p.transpose();
            if (must_be_hit) {
                ASSERT_NEAR(static_cast<double>(hit.distance), expected, error / 2.0 + float_slack)
                    << polygon.name << " reach " << reach << " at " << p.transpose();
            }
        }
    }
}

double farthest_sample(const support::Rings& rings, const Tile& tile) {
    double farthest = 0.0;
    for (const auto& ring : rings) {
        for (const double x : {0.0, static_cast<double>(tile.width)}) {
            for (const double y : {0.0, static_cast<double>(tile.height)}) {
                farthest = std::max(farthest, (ring.front() - Vector(x, y)).norm());
            }
        }
    }
    return farthest;
}

TEST(DistanceMesh, NearestFeatureWithinTheErrorAndNoCrackAnywhere) {
    const Tile tile{.width = 64, .height = 64};
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        for (const auto& polygon : support::degenerate_polygons(tile.width, tile.height, seed)) {
            const double reach = farthest_sample(polygon.rings, tile);
            expect_law(polygon, tile, reach, seed % 2 == 0 ? 0.125 : 0.5);
        }
    }
}

TEST(DistanceMesh, LimitedReachHoldsUpToTheReach) {
    const Tile tile{.width = 48, .height = 40};
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        for (const auto& polygon : support::degenerate_polygons(tile.width, tile.height, seed)) {
            for (const double reach : {0.75, 4.0, 16.0}) {
                expect_law(polygon, tile, reach, 0.125);
            }
        }
        for (const auto& polygon : support::huge_polygons(tile.width, tile.height, seed)) {
            expect_law(polygon, tile, 16.0, 0.125);
        }
    }
}

TEST(DistanceMesh, CoarseGridsAndFineErrorsHold) {
    const Tile coarse{.width = 32, .height = 32, .grid = {.steps = 16.0}};
    const Tile fine{.width = 32, .height = 32};
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        for (const auto& polygon : support::degenerate_polygons(32, 32, seed)) {
            expect_law(polygon, coarse, 20.0, 10.0 * coarse.grid.largest_move());
            expect_law(polygon, fine, 20.0, 10.0 * fine.grid.largest_move());
        }
    }
}

// Cracks appear first at the vertex between two edges that turn by a tiny angle, at a random
// position and orientation: the tents separate by less than a sub-pixel step, or by a few.
TEST(DistanceMesh, SlightTurnsLeaveNoCrack) {
    const Tile tile{.width = 64, .height = 64};
    for (std::uint32_t i = 0; i < 400; ++i) {
        const double heading = 0.1 + 0.731 * i;
        const double turn = std::exp2(-20.0 + 0.05 * i) * (i % 2 == 0 ? 1.0 : -1.0);
        const Vector v(31.0 + std::fmod(0.377 * i, 2.0), 31.0 + std::fmod(0.619 * i, 2.0));
        const Vector in(std::cos(heading), std::sin(heading));
        const Vector out(std::cos(heading + turn), std::sin(heading + turn));
        const support::DegeneratePolygon line{"turn " + std::to_string(turn),
                                              {{v - 80.0 * in, v, v + 80.0 * out, v}}};
        expect_law(line, tile, 50.0, 0.125);
    }
}

// Samples exactly at the reach, where the outline of the mesh would be if it were not enlarged.
TEST(DistanceMesh, HitsSamplesAtExactlyTheReach) {
    const Tile tile{.width = 64, .height = 64};
    for (const double nudge : {0.0, 0.25, 0.5, 0.75}) {
        const Vector shift = Vector::Constant(nudge / tile.grid.steps);
        for (const double reach : {5.0, 13.0}) {
            const support::DegeneratePolygon box{
                "box",
                {{Vector(20.5, 20.5) - shift, Vector(40.5, 20.5) - shift,
                  Vector(40.5, 40.5) - shift, Vector(20.5, 40.5) - shift}}};
            expect_law(box, tile, reach + shift.x() + 1e-9, 0.125);
            expect_law(box, tile, reach - shift.x() + 1e-9, 0.125);
        }
    }
}

TEST(DistanceMesh, TentsAreExactWhereTheirVerticesWereSnappedTo) {
    const Tile tile{.width = 64, .height = 64, .grid = {.steps = 16.0}};
    for (const auto& polygon : support::degenerate_polygons(tile.width, tile.height, 5)) {
        const Vector& a = polygon.rings.front()[0];
        const Vector& b = polygon.rings.front()[1];
        const Mesh mesh = tent(a, b, 16.0, {.error = 0.5, .grid = tile.grid});
        const Vector tangent = (b - a).normalized();
        for (const auto& vertex : mesh) {
            const Vector p(static_cast<double>(vertex.x), static_cast<double>(vertex.y));
            const double expected = std::abs(geometry::cross(tangent, p - a));
            const bool on_ridge = expected < 1.0;
            ASSERT_NEAR(static_cast<double>(vertex.distance), expected,
                        on_ridge ? tile.grid.largest_move() : float_slack)
                << polygon.name;
        }
    }
}

TEST(DistanceMesh, DistanceStaysBetweenZeroAndReachPlusError) {
    const Tile tile{.width = 64, .height = 64};
    for (const auto& polygon : support::degenerate_polygons(tile.width, tile.height, 9)) {
        for (const double reach : {1.0, 16.0, 256.0}) {
            for (const auto& vertex : draw(polygon.rings, tile, reach, {}).mesh) {
                const double distance = static_cast<double>(vertex.distance);
                ASSERT_GE(distance, 0.0) << polygon.name;
                ASSERT_LE(distance, reach + DistanceMeshOptions{}.error) << polygon.name;
                ASSERT_EQ(vertex.x, static_cast<float>(tile.grid.snap(vertex.x))) << polygon.name;
                ASSERT_EQ(vertex.y, static_cast<float>(tile.grid.snap(vertex.y))) << polygon.name;
            }
        }
    }
}

TEST(DistanceMesh, DegenerateFeatures) {
    const Vector v(3.0, 4.0);
    EXPECT_TRUE(tent(v, v, 16.0, {}).empty()) << "an edge of no length has no tent";
    EXPECT_TRUE(cone_sector({1.0, 4.0}, v, {7.0, 4.0}, 16.0, {}).empty())
        << "no gap on a straight line";
    EXPECT_EQ(tent(v, {3.0, 5.0}, 16.0, {}).size(), 12U);

    const Mesh half = cone_sector({1.0, 4.0}, v, {1.0, 4.0}, 16.0, {});
    for (const auto& vertex : half) {
        EXPECT_GE(vertex.x, 3.0F) << "the half cone lies beyond the tip";
    }
    const Mesh whole = cone_sector(v, v, {1.0, 4.0}, 16.0, {});
    EXPECT_NEAR(static_cast<double>(whole.size()), 2.0 * static_cast<double>(half.size()), 3.0);
}

// Triangles cost time on the device: a turn of the boundary uses no more than the error requires.
TEST(DistanceMesh, UsesNoMoreTrianglesThanTheErrorAsksFor) {
    for (const double reach : {16.0, 256.0}) {
        for (const double error : {0.125, 0.25}) {
            const Mesh mesh = cone_sector({0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, reach,
                                          {.error = error, .grid = {}});
            const double inscribed = std::numbers::pi / std::acos(reach / (reach + error));
            EXPECT_LE(static_cast<double>(mesh.size()) / 3.0, 1.05 * inscribed + 1.0);
        }
    }
}

TEST(DistanceMesh, KeepsNothingOfTheTileBefore) {
    DistanceMesh mesh;
    mesh.begin({});
    for (std::uint32_t i = 0; i < 20; ++i) {
        mesh.add_tent({0.0, i + 0.0}, {9.0, i + 1.0}, raster::tangent({0.0, 0.0}, {9.0, 1.0}),
                      {200.0, 200.0}, i);
    }
    EXPECT_GT(mesh.place(), 199.0F);
    for (const double reach : {3.0, 5.0}) {
        mesh.begin({});
        mesh.add_tent({0.0, 0.0}, {9.0, 0.0}, Vector::UnitX(), {reach, 0.0}, 7);
        const auto farthest = static_cast<double>(mesh.place());
        EXPECT_NEAR(farthest, reach, 0.1);
        EXPECT_EQ(triangles_of(mesh).size(), 6U);
    }
}

// Triangles are left out only where no point of the box is in them, also beyond a slanted side.
TEST(DistanceMesh, LeavesOutWhatIsOutsideABox) {
    test::Random random(18);
    DistanceMeshOptions options;
    options.within = {Vector::Zero(), Vector(32.0, 24.0)};
    std::size_t left_out_beside = 0;
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE("seed 18 case " + std::to_string(i));
        const auto any = [&] {
            return Vector(random.between(-20.0, 50.0), random.between(-20.0, 50.0));
        };
        const Vector a = any();
        const Vector b = any();
        const Vector c = any();
        const double reach = random.scale(1.0, 40.0);
        const auto mesh = [&](const DistanceMeshOptions& chosen) {
            return i % 2 == 0 ? tent(a, b, reach, chosen) : cone_sector(a, b, c, reach, chosen);
        };
        const Mesh within = mesh(options);
        const Mesh all = mesh({});
        const auto drawn = support::draw_nearest({.width = 32, .height = 24}, within);
        const auto expected = support::draw_nearest({.width = 32, .height = 24}, all);
        for (std::size_t cell = 0; cell < expected.size(); ++cell) {
            ASSERT_EQ(drawn[cell].id, expected[cell].id) << cell;
            ASSERT_EQ(drawn[cell].distance, expected[cell].distance) << cell;
        }
        Box around;
        for (const auto& vertex : all) {
            around.extend(Vector(vertex.x, vertex.y));
        }
        if (around.intersects(options.within) && within.empty()) {
            ++left_out_beside;
        }
    }
    EXPECT_GT(left_out_beside, 10U);
}

}  // namespace
}  // namespace nearfield
