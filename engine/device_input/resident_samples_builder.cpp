#include <engine/device_input/resident_samples_builder.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace nearfield::device_input {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;
using geometry::Vector;
using shaders::SampleTileData;

Box box_of(const std::vector<Region>& regions) {
    Box box;
    for (const Region& region : regions) {
        box.extend(geometry::to_vector(region.min));
        box.extend(geometry::to_vector(region.max));
    }
    return box;
}

/// How far the device's numbers may differ from exact ones (docs/resident_results.md): single
/// precision for lengths up to the extent of regions and boundary.
double error_of_samples(const PlannedQuery& planned, const Box& box, bool by_edge) {
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const Box all = by_edge ? box.merged(a.box()) : box;
    return all.isEmpty() ? 0.0
                         : std::ldexp(all.diagonal().norm(), -20) +
                               4.0 * geometry::placement_rounding(a, a.box());
}

/// Sets the position of a tile's cells.
void place(const PlannedTile& tile, const Vector& origin, SampleTileData& data) {
    const Vector corner = tile.origin() - origin;
    data.width = tile.width;
    data.height = tile.height;
    data.region = tile.region;
    data.corner_x = static_cast<float>(corner.x());
    data.corner_y = static_cast<float>(corner.y());
}

}  // namespace

void ResidentSamplesBuilder::add(const Plan& plan, std::span<const ComputeBatch> tile_batches,
                                 std::uint32_t query, const IntersectionResult& result,
                                 ResidentOutputs& resident) {
    if (!is_found_) {
        find_tiles(plan, tile_batches);
    }
    const PlannedQuery& planned = plan.queries[query];
    const auto& asked = std::get<IntersectionQuery>(*planned.query);
    const bool by_edge = asked.samples_on_device && asked.kind != IntersectionKind::volume_volume;
    const Box box = box_of(result.regions);
    SamplesOutput& samples = resident.samples.emplace_back();
    samples.query = query;
    samples.cell = planned.budget.cell;
    samples.error_bound = error_of_samples(planned, box, by_edge);
    if (asked.target != nullptr) {
        samples.target = *asked.target;
    }
    samples.first_run = static_cast<std::uint32_t>(resident.sample_runs.size());
    if (!box.isEmpty()) {
        samples.origin = box.center();
    }
    add_tiles(plan, asked, resident);
}

void ResidentSamplesBuilder::find_tiles(const Plan& plan,
                                        std::span<const ComputeBatch> tile_batches) {
    is_found_ = true;
    tiles_.clear();
    for (std::uint32_t number = 0; number < tile_batches.size(); ++number) {
        find_masks(plan, tile_batches[number], number);
    }
    // By query, then region, row and column: the order in which tiles were cut.
    std::sort(tiles_.begin(), tiles_.end(),
              [](const FoundTile& i, const FoundTile& j) { return i.index < j.index; });
}

void ResidentSamplesBuilder::find_masks(const Plan& plan, const ComputeBatch& batch,
                                        std::uint32_t number) {
    const ComputeWork& work = batch.work;
    for (const shaders::OverlapData& overlap : work.overlaps) {
        const std::uint32_t index = batch.tile_index[overlap.tile];
        if (plan.queries[plan.tiles[index].query].on_device) {
            FoundTile& found = tiles_.emplace_back();
            found.index = index;
            found.tile_batch = number;
            found.data.summary = overlap.tile;
            found.data.mask_a = overlap.mask_a;
            found.data.mask_b = overlap.mask_b;
            found.data.edges =
                overlap.first_edge == shaders::no_edges
                    ? shaders::no_word
                    : static_cast<std::uint32_t>(work.mask_words) + overlap.first_edge;
        }
    }
}

void ResidentSamplesBuilder::add_tiles(const Plan& plan, const IntersectionQuery& asked,
                                       ResidentOutputs& resident) {
    SamplesOutput& samples = resident.samples.back();
    const auto query_of = [&](const FoundTile& tile) { return plan.tiles[tile.index].query; };
    const auto first =
        std::partition_point(tiles_.begin(), tiles_.end(),
                             [&](const FoundTile& tile) { return query_of(tile) < samples.query; });
    const auto last = std::partition_point(first, tiles_.end(), [&](const FoundTile& tile) {
        return query_of(tile) == samples.query;
    });
    if (asked.samples_on_device) {
        place_blocks(plan, {first, last}, samples);
    }
    samples.tile_count = static_cast<std::uint32_t>(last - first);
    samples.bytes = sizeof(IntersectionSummaryData) +
                    std::uint64_t{samples.capacity} * sizeof(IntersectionSampleData);
    samples.block_bytes =
        (std::uint64_t{samples.tile_count} * shaders::words_of_box + samples.block_count) *
        sizeof(std::uint32_t);
    std::sort(first, last, [](const FoundTile& i, const FoundTile& j) {
        return i.tile_batch != j.tile_batch ? i.tile_batch < j.tile_batch : i.index < j.index;
    });
    for (auto tile = first; tile != last; ++tile) {
        if (tile == first || tile->tile_batch != std::prev(tile)->tile_batch) {
            SampleRunOutput& run = resident.sample_runs.emplace_back();
            run.tile_batch = tile->tile_batch;
            run.first_tile = static_cast<std::uint32_t>(resident.sample_tiles.size());
            ++samples.run_count;
        }
        place(plan.tiles[tile->index], samples.origin, tile->data);
        resident.sample_tiles.push_back(tile->data);
        ++resident.sample_runs.back().tile_count;
    }
    for (std::uint32_t i = 0; i < samples.run_count; ++i) {
        SampleRunOutput& run = resident.sample_runs[samples.first_run + i];
        run.table = static_cast<std::uint32_t>(resident.tables.size());
        for (std::uint32_t tile = 0; tile < run.tile_count; ++tile) {
            using Words = std::array<std::uint32_t, shaders::words_of_tile>;
            const auto words = std::bit_cast<Words>(resident.sample_tiles[run.first_tile + tile]);
            resident.tables.insert(resident.tables.end(), words.begin(), words.end());
        }
    }
}

/// One block per row of a tile, in the order of the samples: rows of adjacent tiles alternate.
void ResidentSamplesBuilder::place_blocks(const Plan& plan, std::span<FoundTile> tiles,
                                          SamplesOutput& samples) const {
    for (std::size_t first = 0; first < tiles.size();) {
        const PlannedTile& leader = plan.tiles[tiles[first].index];
        std::size_t end = first;
        while (end < tiles.size() && plan.tiles[tiles[end].index].region == leader.region &&
               plan.tiles[tiles[end].index].row == leader.row) {
            ++end;
        }
        const auto beside = static_cast<std::uint32_t>(end - first);
        for (std::uint32_t i = 0; i < beside; ++i) {
            SampleTileData& data = tiles[first + i].data;
            data.first_block = samples.block_count + i;
            data.block_step = beside;
            samples.capacity += plan.tiles[tiles[first + i].index].width * leader.height;
        }
        samples.block_count += beside * leader.height;
        first = end;
    }
}

}  // namespace nearfield::device_input
