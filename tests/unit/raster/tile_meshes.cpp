#include <engine/device_input/planner.hpp>
#include <engine/raster/drawn_batch_builder.hpp>
#include <engine/raster/point_planner.hpp>

#include <gtest/gtest.h>
#include <tests/support/planned_queries.hpp>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <list>
#include <span>
#include <vector>

namespace nearfield::raster {
namespace {

using geometry::MeshVertex;

/// How far a triangle reaches beyond a tile, in cells.
float overreach(std::span<const MeshVertex> triangle, const shaders::TileData& tile) {
    float most = 0.0F;
    for (const MeshVertex& vertex : triangle) {
        const float x = vertex.x - static_cast<float>(tile.atlas_x);
        const float y = vertex.y - static_cast<float>(tile.atlas_y);
        most = std::max({most, -x, -y, x - static_cast<float>(tile.width),
                         y - static_cast<float>(tile.height)});
    }
    return most;
}

/// Batches of all kinds of tiles, of random shapes.
class RasterTileMeshes : public ::testing::Test {
protected:
    /// `steps`: of the sub-pixel grid.
    std::vector<DrawnBatch> tile_batches(std::uint64_t seed, double steps) {
        test::Random random(seed);
        std::vector<AnyQuery> queries;
        std::vector<queries::QueryShapes> shapes;
        for (int i = 0; i < 40; ++i) {
            const double d = random.scale(0.01, 0.2);
            // The largest deviation allowed makes the widest offset polygons.
            const double deviation = i % 2 == 0 ? 0.25 * d * 0.49 : 0.0;
            shapes.push_back({shape(random, deviation), shape(random, deviation)});
            queries.push_back(query(random, d, i));
        }
        queries::QueryLimits limits;
        limits.memory = std::uint64_t{1} << 34U;
        limits.subpixel = {steps};
        device_input::Planner planner(limits);
        raster::PointPlanner points;
        const auto plan_drawn = [&](device_input::CurrentQuery& current, AnyResult& result) {
            points.plan(current, result);
        };
        device_input::Plan plan;
        std::vector<AnyResult> results;
        test::plan_all(test::checked_queries(queries, shapes, limits, results), plan_drawn, planner,
                       plan, results);
        for (const AnyResult& result : results) {
            const Status status = std::visit([](const auto& one) { return one.status; }, result);
            EXPECT_TRUE(status.ok()) << status.text();
        }
        DrawnBatchBuilder builder(limits.subpixel);
        std::vector<DrawnBatch> built;
        const std::uint32_t count = builder.build(plan, built);
        EXPECT_EQ(count, built.size());
        return built;
    }

private:
    const geometry::Polygon* shape(test::Random& random, double deviation) {
        geometry::Polygon& polygon = polygons_.emplace_back();
        const test::Rings rings =
            random.whole(0, 1) == 0 ? test::star(random, 30, 0.4) : test::coast(random, 60, 0.5);
        EXPECT_TRUE(polygon.assign(rings, deviation).ok());
        return &polygon;
    }

    static AnyQuery query(test::Random& random, double d, int i) {
        const Pose pose{{random.between(-1.0, 1.0), random.between(-1.0, 1.0)},
                        random.between(0.0, 6.0)};
        if (i % 4 == 0) {
            PenetrationQuery query{{}, {{}, pose}, d};
            query.technique = Technique::raster;
            return query;
        }
        if (i % 4 == 1) {
            DistanceFieldQuery query{{}, {{}, pose}, d};
            query.rectangle = Rectangle{{-0.5, -0.5}, {0.5, 0.5}};
            query.sign = static_cast<SignEncoding>(random.whole(0, 2));
            query.gradients = true;
            query.gradient = GradientMethod::blended;
            query.technique = Technique::raster;
            return query;
        }
        IntersectionQuery query{{}, {{}, pose}, d};
        query.kind = static_cast<IntersectionKind>(random.whole(0, 2));
        query.strategy = static_cast<IntersectionStrategy>(random.whole(0, 3));
        query.technique = Technique::raster;
        return query;
    }

    std::list<geometry::Polygon> polygons_;
};

TEST_F(RasterTileMeshes, ReachNoOtherTile) {
    for (const double steps : {16.0, 256.0}) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            SCOPED_TRACE(seed);
            for (const DrawnBatch& batch : tile_batches(seed, steps)) {
                for (const geometry::Mesh& mesh : batch.meshes.meshes()) {
                    for (std::size_t i = 0; i < mesh.size(); i += 3) {
                        float least = 1e9F;
                        for (const shaders::TileData& tile : batch.tiles) {
                            least = std::min(least, overreach({&mesh[i], 3}, tile));
                        }
                        // Sample positions are half a cell within the next tile.
                        ASSERT_LT(least, static_cast<float>(atlas_gap));
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::raster
