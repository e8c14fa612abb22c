#include "scanline_reference.hpp"

#include <engine/geometry/polygon.hpp>
#include <engine/gpu/device.hpp>
#include <engine/plan/planner.hpp>
#include <engine/plan/tile_batch.hpp>

#include <gtest/gtest.h>
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

geometry::Mesh part_of(const geometry::Mesh& mesh, plan::DrawRange range) {
    const auto first = mesh.begin() + range.first;
    return {first, first + range.count};
}

/// For each sample the id of the first triangle that covers it, or none; for volumes, 0 or none.
std::vector<std::uint32_t> scan(const support::Tile& tile, const geometry::Mesh& mesh,
                                plan::Part part) {
    std::vector<std::uint32_t> image(std::size_t{tile.width} * tile.height, nothing);
    if (part == plan::Part::volume) {
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

void scan_tile(const plan::Plan& plan, const plan::TileBatch& round, const plan::TileDraw& draw,
               geometry::SubpixelGrid grid, std::vector<Placed>& found) {
    const plan::Tile& planned = plan.tiles[round.tile_index[draw.tile]];
    const support::Tile tile{draw.width, draw.height, grid};
    const auto a = scan(tile, part_of(round.mesh, draw.a), draw.part_a);
    const auto b = scan(tile, part_of(round.mesh, draw.b), draw.part_b);
    for (std::uint32_t row = 0; row < tile.height; ++row) {
        for (std::uint32_t column = 0; column < tile.width; ++column) {
            const std::size_t index = tile.index(column, row);
            if (a[index] == nothing || b[index] == nothing) {
                continue;
            }
            const geometry::Vector centre(static_cast<double>(planned.column + column) + 0.5,
                                          static_cast<double>(planned.row + row) + 0.5);
            const geometry::Vector point = planned.grid.origin + planned.grid.cell * centre;
            plan::EdgeRun run{0, 0};
            if (draw.part_a == plan::Part::boundary) {
                run = round.runs[a[index] >> plan::run_shift];
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
    plan::PlanLimits limits;
    limits.subpixel = grid;
    limits.memory = settings.memory_limit;
    query.a.shape = {0, 0};
    query.b.shape = {1, 0};
    const std::vector<AnyQuery> queries{query};
    plan::Planner planner(limits);
    plan::Plan plan;
    std::vector<AnyResult> results;
    const std::vector<plan::QueryShapes> shapes{{&a, &b}};
    planner.plan(queries, shapes, plan, results);
    plan::TileBatchBuilder builder(limits.subpixel);
    plan::TileBatch round;
    std::vector<Placed> found;
    for (std::uint32_t number = 0; number < plan.tile_batches; ++number) {
        builder.build(plan, number, round);
        for (const auto& draws : round.overlap_draws) {
            for (const plan::TileDraw& draw : draws) {
                scan_tile(plan, round, draw, limits.subpixel, found);
            }
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
