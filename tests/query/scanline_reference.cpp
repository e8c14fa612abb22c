#include "scanline_reference.hpp"

#include <engine/device_input/planner.hpp>
#include <engine/geometry/polygon.hpp>
#include <engine/gpu/device.hpp>
#include <engine/raster/drawn_batch_builder.hpp>

#include <gtest/gtest.h>
#include <tests/support/planned_queries.hpp>
#include <tests/support/scanline.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace nearfield::test {
namespace {

constexpr std::uint32_t nothing = UINT32_MAX;

struct Placed {
    std::tuple<std::uint32_t, std::uint64_t, std::uint64_t> key;  // region, row, column
    ReferenceSample sample;
};

/// The triangles of a tile, in its cells: those that reach it or the gap around it.
geometry::Mesh in_tile(const shaders::TileData& tile, const geometry::Mesh& all) {
    constexpr auto gap = static_cast<float>(raster::atlas_gap);
    geometry::Mesh mesh;
    for (std::size_t i = 0; i + 2 < all.size(); i += 3) {
        const auto is_near = [&](const geometry::MeshVertex& vertex) {
            const float x = vertex.x - static_cast<float>(tile.atlas_x);
            const float y = vertex.y - static_cast<float>(tile.atlas_y);
            return x >= -gap && y >= -gap && x <= static_cast<float>(tile.width) + gap &&
                   y <= static_cast<float>(tile.height) + gap;
        };
        if (is_near(all[i]) && is_near(all[i + 1]) && is_near(all[i + 2])) {
            for (std::size_t j = i; j < i + 3; ++j) {
                mesh.push_back({all[j].x - static_cast<float>(tile.atlas_x),
                                all[j].y - static_cast<float>(tile.atlas_y), all[j].distance,
                                all[j].id});
            }
        }
    }
    return mesh;
}

/// The triangles that decide where a shape is in a tile.
geometry::Mesh mesh_of(const raster::DrawnBatch& batch, const device_input::OverlapTile& overlap,
                       IntersectionStrategy strategy, bool is_a) {
    using raster::OverlapStep;
    const shaders::TileData& tile = batch.tiles[overlap.tile];
    const auto mesh = [&](OverlapStep step) -> const geometry::Mesh& {
        return batch.meshes[raster::overlaps_of(strategy, step)];
    };
    if ((is_a ? overlap.part_a : overlap.part_b) == device_input::Part::volume) {
        return in_tile(tile, mesh(is_a ? OverlapStep::parity_a : OverlapStep::parity_b));
    }
    geometry::Mesh found =
        in_tile(tile, mesh(is_a ? OverlapStep::boundary_a : OverlapStep::boundary_b));
    if (is_a) {
        const geometry::Mesh watched = in_tile(tile, mesh(OverlapStep::watched_a));
        found.insert(found.end(), watched.begin(), watched.end());
    }
    return found;
}

/// For each sample the id of the first triangle that covers it, or none; for volumes, 0 or none.
std::vector<std::uint32_t> scan(const support::Tile& tile, const geometry::Mesh& mesh,
                                device_input::Part part) {
    std::vector<std::uint32_t> image(std::size_t{tile.width} * tile.height, nothing);
    if (part == device_input::Part::volume) {
        const std::vector<std::uint8_t> parity = support::draw_parity(tile, mesh);
        std::transform(parity.begin(), parity.end(), image.begin(),
                       [](std::uint8_t odd) { return odd != 0 ? 0 : nothing; });
        return image;
    }
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) {
        support::rasterise(tile, std::span<const geometry::MeshVertex, 3>(&mesh[i], 3),
                           [&](std::size_t index, const auto&) {
                               image[index] = std::min(image[index], mesh[i].id);
                           });
    }
    return image;
}

void scan_tile(const device_input::Plan& plan, const raster::DrawnBatch& batch,
               const device_input::OverlapTile& overlap, IntersectionStrategy strategy,
               geometry::SubpixelGrid grid, std::vector<Placed>& found) {
    const device_input::PlannedTile& planned = plan.tiles[batch.tile_index[overlap.tile]];
    const support::Tile tile{planned.width, planned.height, grid};
    const auto a = scan(tile, mesh_of(batch, overlap, strategy, true), overlap.part_a);
    const auto b = scan(tile, mesh_of(batch, overlap, strategy, false), overlap.part_b);
    for (std::uint32_t row = 0; row < tile.height; ++row) {
        for (std::uint32_t column = 0; column < tile.width; ++column) {
            const std::size_t index = tile.index(column, row);
            if (a[index] == nothing || b[index] == nothing) {
                continue;
            }
            const geometry::Vector centre(static_cast<double>(planned.column + column) + 0.5,
                                          static_cast<double>(planned.row + row) + 0.5);
            const geometry::Vector point = planned.grid.origin + planned.grid.cell * centre;
            queries::EdgeRun run{0, 0};
            if (overlap.part_a == device_input::Part::boundary) {
                run = batch.runs[a[index] >> shaders::run_shift];
            }
            found.push_back({{planned.region, planned.row + row, planned.column + column},
                             {geometry::to_public(point), run.first, run.count}});
        }
    }
}

}  // namespace

geometry::SubpixelGrid grid_of(const HostDevice& host) {
    const gpu::Device device(host);
    return {std::ldexp(1.0, static_cast<int>(device.limits().subPixelPrecisionBits))};
}

std::vector<ReferenceSample> scan_intersection(geometry::SubpixelGrid grid, const PlacedPair& pair,
                                               IntersectionQuery query, const Settings& settings) {
    geometry::Polygon a;
    geometry::Polygon b;
    EXPECT_TRUE(a.assign(pair.pair().a.rings).ok() && b.assign(pair.pair().b.rings).ok());
    queries::QueryLimits limits;
    limits.subpixel = grid;
    limits.memory = settings.memory_limit;
    query.a.shape = {0, 0};
    query.b.shape = {1, 0};
    const std::vector<AnyQuery> queries{query};
    device_input::Planner planner(limits);
    device_input::Plan plan;
    std::vector<AnyResult> results;
    const std::vector<queries::QueryShapes> shapes{{&a, &b}};
    plan_all(checked_queries(queries, shapes, limits, results), {}, planner, plan, results);
    raster::DrawnBatchBuilder builder(limits.subpixel);
    std::vector<raster::DrawnBatch> batches;
    const std::uint32_t count = builder.build(plan, batches);
    EXPECT_EQ(count, batches.size());
    std::vector<Placed> found;
    for (const raster::DrawnBatch& batch : batches) {
        for (const device_input::OverlapTile& drawn :
             batch.overlaps[static_cast<std::size_t>(query.strategy)]) {
            scan_tile(plan, batch, drawn, query.strategy, limits.subpixel, found);
        }
    }
    std::sort(found.begin(), found.end(),
              [](const Placed& i, const Placed& j) { return i.key < j.key; });
    std::vector<ReferenceSample> samples;
    for (const Placed& placed : found) {
        samples.push_back(placed.sample);
    }
    return samples;
}

}  // namespace nearfield::test
