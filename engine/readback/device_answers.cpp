#include <engine/readback/device_answers.hpp>
#include <engine/records/intersection_samples.hpp>

#include <algorithm>
#include <tuple>

namespace nearfield::readback {

using plan::Tile;

void DeviceAnswers::begin_batch(const plan::Plan& plan) {
    // Points that no tile batch answers are left to the CPU.
    words_.assign(plan.points.size(), plan::point_resolved | plan::point_doubtful);
    pairs_.begin(plan.pairs.directions.empty() ? 0 : plan.queries.size());
    samples_.clear();
    fields_.begin_batch(plan);
}

void DeviceAnswers::add_points(const plan::TileBatch& batch, std::span<const std::uint32_t> words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        words_[batch.point_index[i]] = words[i];
    }
}

void DeviceAnswers::add_summaries(const plan::Plan& plan, const plan::TileBatch& batch,
                                  std::span<const plan::TileSummary> summaries,
                                  std::vector<AnyResult>& results) {
    for (std::size_t i = 0; i < summaries.size(); ++i) {
        const Tile& tile = plan.tiles[batch.tile_index[i]];
        if (tile.kind == plan::TileKind::overlap) {
            records::add_summary(tile, summaries[i],
                                 std::get<IntersectionResult>(results[tile.query]));
        }
    }
}

void DeviceAnswers::add_samples(const plan::Plan& plan, const plan::TileBatch& batch,
                                std::span<const plan::SampleData> samples) {
    const auto run_of = [&](const plan::SampleData& sample) -> plan::EdgeRun {
        return batch.runs.empty() ? plan::EdgeRun{sample.run, 1} : batch.runs[sample.run];
    };
    for (const plan::SampleData& sample : samples) {
        const std::uint32_t index = batch.tile_index[sample.tile];
        const Tile& tile = plan.tiles[index];
        samples_.push_back(
            {tile.query, tile.region, tile.row + (sample.cell >> 16U),
             tile.column + (sample.cell & 0xffffU),
             records::make_sample(plan.queries[tile.query], tile, sample.cell & 0xffffU,
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

QueryPoints DeviceAnswers::points_of(const plan::Plan& plan, std::uint32_t query) const {
    const plan::PlannedQuery& planned = plan.queries[query];
    if (planned.has_points_of(plan::PointSource::device)) {
        return pairs_.points(query);
    }
    const plan::PlannedPoints& points = planned.points();
    return {.points = std::span(plan.points).subspan(points.first, points.count),
            .words = words_of(points),
            .tiles = plan.tiles};
}

}  // namespace nearfield::readback
