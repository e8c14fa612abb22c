#include <engine/batch/device_answers.hpp>
#include <engine/solvers/intersection_samples.hpp>

#include <algorithm>
#include <tuple>

namespace nearfield::batch {

using device_input::PlannedTile;

void DeviceAnswers::begin_batch(const device_input::Plan& plan) {
    // Points that no tile batch answers are left to the CPU.
    words_.assign(plan.points.size(), shaders::point_resolved | shaders::point_doubtful);
    pairs_.begin(plan.pairs.directions.empty() ? 0 : plan.queries.size());
    samples_.clear();
    fields_.begin_batch(plan);
}

void DeviceAnswers::add_points(const device_input::TileBatch& batch,
                               std::span<const std::uint32_t> words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        words_[batch.point_index[i]] = words[i];
    }
}

void DeviceAnswers::add_summaries(const device_input::Plan& plan,
                                  const device_input::TileBatch& batch,
                                  std::span<const shaders::TileSummary> summaries,
                                  std::vector<AnyResult>& results) {
    for (std::size_t i = 0; i < summaries.size(); ++i) {
        const PlannedTile& tile = plan.tiles[batch.tile_index[i]];
        if (tile.kind == device_input::TileKind::overlap) {
            solvers::add_summary(tile, summaries[i],
                                 std::get<IntersectionResult>(results[tile.query]));
        }
    }
}

void DeviceAnswers::add_samples(const device_input::Plan& plan,
                                const device_input::TileBatch& batch,
                                std::span<const shaders::SampleData> samples) {
    const auto run_of = [&](const shaders::SampleData& sample) -> queries::EdgeRun {
        return batch.runs.empty() ? queries::EdgeRun{sample.run, 1} : batch.runs[sample.run];
    };
    for (const shaders::SampleData& sample : samples) {
        const std::uint32_t index = batch.tile_index[sample.tile];
        const PlannedTile& tile = plan.tiles[index];
        samples_.push_back(
            {tile.query, tile.region, tile.row + (sample.cell >> 16U),
             tile.column + (sample.cell & 0xffffU),
             solvers::make_sample(plan.queries[tile.query], tile, sample.cell & 0xffffU,
                                  sample.cell >> 16U, run_of(sample))});
    }
}

void DeviceAnswers::write_drawn_samples(std::vector<AnyResult>& results) {
    // The device lists samples in no particular order; results are ordered.
    std::sort(samples_.begin(), samples_.end(), [](const FoundSample& i, const FoundSample& j) {
        return std::tie(i.query, i.region, i.row, i.column) <
               std::tie(j.query, j.region, j.row, j.column);
    });
    for (const FoundSample& sample : samples_) {
        std::get<IntersectionResult>(results[sample.query]).samples.push_back(sample.sample);
    }
}

QueryPoints DeviceAnswers::points_of(const device_input::Plan& plan, std::uint32_t query) const {
    const device_input::PlannedQuery& planned = plan.queries[query];
    if (planned.has_points_of(device_input::PointSource::device)) {
        return pairs_.points(query);
    }
    const device_input::PlannedPoints& points = planned.points();
    return {.points = std::span(plan.points).subspan(points.first, points.count),
            .words = words_of(points),
            .tiles = plan.tiles};
}

}  // namespace nearfield::batch
