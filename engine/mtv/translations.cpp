#include <engine/base/interruption.hpp>
#include <engine/mtv/translations.hpp>

#include <algorithm>
#include <utility>

namespace nearfield::mtv {

using geometry::Vector;

namespace {

// Projecting and sorting an edge, or sorting an interval, costs about as much as this many
// edge-edge comparisons.
constexpr std::uint64_t work_of_level = 16;
constexpr std::uint64_t work_of_interval = 8;

}  // namespace

void TranslationFinder::project(const simd::TransformedEdges& edges, const Vector& direction,
                                std::vector<Level>& levels) {
    levels.clear();
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const Vector start = edges.start(i);
        const Vector end = edges.end(i);
        Level level{geometry::cross(direction, start), geometry::cross(direction, end),
                    direction.dot(start), direction.dot(end), i};
        if (level.low > level.high) {
            std::swap(level.low, level.high);
            std::swap(level.along_low, level.along_high);
        }
        levels.push_back(level);
    }
}

bool TranslationFinder::add_intervals(double most, double rounding, WorkBudget& work) {
    std::sort(of_b_.begin(), of_b_.end(),
              [](const Level& i, const Level& j) { return i.low < j.low; });
    double highest = 0.0;
    for (const Level& b : of_b_) {
        highest = std::max(highest, b.high - b.low);
    }
    // The position of an edge along the direction at a level; both ends if the edge runs along it.
    const auto range_at = [rounding](const Level& edge, double low, double high) {
        const double height = edge.high - edge.low;
        if (height <= rounding) {
            return std::pair(edge.along_low, edge.along_high);
        }
        const auto at = [&](double level) {
            const double part = std::clamp((level - edge.low) / height, 0.0, 1.0);
            return (1.0 - part) * edge.along_low + part * edge.along_high;
        };
        return std::pair(at(low), at(high));
    };
    intervals_.clear();
    work.add(work_of_level * (of_a_.size() + of_b_.size()));
    SparseCheckpoint<16> checkpoint;
    for (const Level& a : of_a_) {
        const double min_a = std::min(a.along_low, a.along_high);
        const double max_a = std::max(a.along_low, a.along_high);
        auto b = std::lower_bound(of_b_.begin(), of_b_.end(), a.low - highest - rounding,
                                  [](const Level& level, double low) { return level.low < low; });
        checkpoint.step();
        if (work.is_used_up()) {
            return false;
        }
        std::uint64_t pairs = 0;
        for (; b != of_b_.end() && b->low <= a.high + rounding; ++b) {
            ++pairs;
            if (b->high < a.low - rounding || std::max(b->along_low, b->along_high) < min_a ||
                std::min(b->along_low, b->along_high) - max_a > most) {
                continue;
            }
            const double low = std::max(a.low, b->low);
            const double high = std::max(low, std::min(a.high, b->high));
            const auto on_a = range_at(a, low, high);
            const auto on_b = range_at(*b, low, high);
            Interval interval{0.0, 0.0, {a.edge, b->edge}};
            if (a.high - a.low <= rounding || b->high - b->low <= rounding) {
                interval.from =
                    std::min(on_b.first, on_b.second) - std::max(on_a.first, on_a.second);
                interval.to = std::max(on_b.first, on_b.second) - std::min(on_a.first, on_a.second);
            } else {
                // Both are straight: their distance is linear in the level.
                const double at_low = on_b.first - on_a.first;
                const double at_high = on_b.second - on_a.second;
                interval.from = std::min(at_low, at_high);
                interval.to = std::max(at_low, at_high);
            }
            if (interval.to >= 0.0 && interval.from <= most) {
                intervals_.push_back(interval);
                pairs += work_of_interval;
            }
        }
        work.add(pairs);
    }
    return true;
}

const std::vector<TranslationGap>& TranslationFinder::find(const simd::TransformedEdges& a,
                                                           const simd::TransformedEdges& b,
                                                           const Vector& direction, double most,
                                                           WorkBudget& work) {
    project(a, direction, of_a_);
    project(b, direction, of_b_);
    gaps_.clear();
    if (!add_intervals(most, a.rounding + b.rounding, work)) {
        return gaps_;
    }
    std::sort(intervals_.begin(), intervals_.end(),
              [](const Interval& i, const Interval& j) { return i.from < j.from; });
    TranslationGap gap{0.0, 0.0, {}, {}};
    for (const Interval& interval : intervals_) {
        if (interval.from > gap.from) {
            gap.to = interval.from;
            gap.ends_at = interval.edges;
            gaps_.push_back(gap);
        }
        if (interval.to > gap.from) {
            gap = {interval.to, 0.0, interval.edges, {}};
        }
    }
    gap.to = std::numeric_limits<double>::infinity();
    gaps_.push_back(gap);
    return gaps_;
}

TranslationGap TranslationFinder::find_first(const simd::TransformedEdges& a,
                                             const simd::TransformedEdges& b,
                                             const Vector& direction, double most,
                                             WorkBudget& work) {
    const std::vector<TranslationGap>& gaps = find(a, b, direction, most, work);
    return gaps.empty() ? TranslationGap{2.0 * most, 2.0 * most, {}, {}} : gaps.front();
}

}  // namespace nearfield::mtv
