#include <engine/records/intersection_samples.hpp>
#include <engine/results/results.hpp>

#include <algorithm>
#include <tuple>

namespace nearfield::results {
namespace {

using plan::Tile;

}  // namespace

void ResultDecoder::begin_batch(const plan::Plan& plan) {
    // Points that no tile batch answers are left to the CPU.
    words_.assign(plan.points.size(), plan::point_resolved | plan::point_doubtful);
    samples_.clear();
    fields_.begin_batch(plan);
}

void ResultDecoder::add_points(const plan::TileBatch& batch, std::span<const std::uint32_t> words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        words_[batch.point_index[i]] = words[i];
    }
}

void ResultDecoder::add_found(const plan::PointSearch& search,
                              std::span<const plan::FoundPointData> found,
                              std::span<const float> depths, plan::Plan& plan) {
    for (std::size_t i = 0; i < found.size();) {
        const std::uint32_t direction = found[i].direction;
        const std::size_t first = i;
        plan::PlannedQuery& query = plan.queries[search.queries[direction]];
        plan::PlannedPoints& points = query.points();
        points.first = static_cast<std::uint32_t>(plan.points.size());
        const auto unit = static_cast<float>(plan::unit_length_of(*query.b));  // a power of two
        plan::FoundPlaces place_of(query);
        for (; i < found.size() && found[i].direction == direction; ++i) {
            plan::FoundPointData point = found[i];
            points.left_out += point.number >> plan::left_out_shift;
            point.number &= (1U << plan::left_out_shift) - 1U;
            plan.points.push_back({place_of(point), plan::PlannedPoint::no_tile, unit * depths[i]});
            words_.push_back(point.word);
        }
        points.count += static_cast<std::uint32_t>(i - first);
    }
}

void ResultDecoder::add_summaries(const plan::Plan& plan, const plan::TileBatch& batch,
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

void ResultDecoder::add_samples(const plan::Plan& plan, const plan::TileBatch& batch,
                                std::span<const plan::SampleData> samples) {
    const auto run_of = [&](const plan::SampleData& sample) -> plan::EdgeRun {
        if (batch.by_compute) {
            return {sample.run, 1};
        }
        return batch.runs.empty() ? plan::EdgeRun{} : batch.runs[sample.run];
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

void ResultDecoder::write_drawn_samples(std::vector<AnyResult>& results) {
    // The device lists samples in no particular order; results are ordered.
    std::sort(samples_.begin(), samples_.end(), [](const FoundSample& i, const FoundSample& j) {
        return std::tie(i.query, i.region, i.row, i.column) <
               std::tie(j.query, j.region, j.row, j.column);
    });
    for (const FoundSample& sample : samples_) {
        std::get<IntersectionResult>(results[sample.query]).samples.push_back(sample.sample);
    }
}

void ResultDecoder::answer_on_cpu(const plan::Plan& plan, std::vector<AnyResult>& results) {
    left_ = results.size() - answers_->answer_on_cpu(plan, words_, fields_, results);
}

void ResultDecoder::finish(const plan::Plan& plan, std::vector<AnyResult>& results) {
    write_drawn_samples(results);
    if (left_ > 0) {
        answers_->finish(plan, words_, fields_, results);
    }
}

}  // namespace nearfield::results
