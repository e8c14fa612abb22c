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

void TranslationFinder::begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                              double longest) {
    const auto list = [](const simd::TransformedEdges& edges, const geometry::Box& reach,
                         std::vector<std::uint32_t>& in_reach) {
        in_reach.clear();
        for (std::uint32_t i = 0; i < edges.count; ++i) {
            const Vector start = edges.start(i);
            const Vector end = edges.end(i);
            if (reach.intersects(geometry::Box(start.cwiseMin(end), start.cwiseMax(end)))) {
                in_reach.push_back(i);
            }
        }
    };
    const double reach = longest + 2.0 * (a.rounding + b.rounding);
    list(a, geometry::grown(b.box, reach), in_reach_of_b_);
    list(b, geometry::grown(a.box, reach), in_reach_of_a_);
}

void TranslationFinder::project(const simd::TransformedEdges& edges,
                                const std::vector<std::uint32_t>& in_reach,
                                const geometry::Box& other, const Vector& direction, double way,
                                double rounding, std::vector<Level>& levels) {
    const Vector across(-direction.y(), direction.x());
    const Vector centre = other.center();
    const Vector half = 0.5 * other.diagonal();
    const double level = across.dot(centre);
    const double height = across.cwiseAbs().dot(half) + rounding;
    const double along = direction.dot(centre);
    const double length = direction.cwiseAbs().dot(half) + rounding;
    const double first = along - length - std::max(way, 0.0);
    const double last = along + length - std::min(way, 0.0);
    levels.clear();
    for (const std::uint32_t i : in_reach) {
        const Vector start = edges.start(i);
        const Vector end = edges.end(i);
        Level edge{geometry::cross(direction, start), geometry::cross(direction, end),
                   direction.dot(start), direction.dot(end), i};
        if (edge.low > edge.high) {
            std::swap(edge.low, edge.high);
            std::swap(edge.along_low, edge.along_high);
        }
        if (edge.low <= level + height && edge.high >= level - height &&
            std::min(edge.along_low, edge.along_high) <= last &&
            std::max(edge.along_low, edge.along_high) >= first) {
            levels.push_back(edge);
        }
    }
}

/// The position of an edge along the direction at two levels; both ends if the edge runs along it.
std::pair<double, double> TranslationFinder::range_at(const Level& edge, double low, double high,
                                                      double rounding) {
    const double height = edge.high - edge.low;
    if (height <= rounding) {
        return {edge.along_low, edge.along_high};
    }
    const auto at = [&](double level) {
        const double part = std::clamp((level - edge.low) / height, 0.0, 1.0);
        return (1.0 - part) * edge.along_low + part * edge.along_high;
    };
    return {at(low), at(high)};
}

TranslationFinder::Interval TranslationFinder::interval_between(const Level& a, const Level& b,
                                                                double rounding) {
    const double low = std::max(a.low, b.low);
    const double high = std::max(low, std::min(a.high, b.high));
    const auto on_a = range_at(a, low, high, rounding);
    const auto on_b = range_at(b, low, high, rounding);
    if (a.high - a.low <= rounding || b.high - b.low <= rounding) {
        return {std::min(on_b.first, on_b.second) - std::max(on_a.first, on_a.second),
                std::max(on_b.first, on_b.second) - std::min(on_a.first, on_a.second),
                {a.edge, b.edge}};
    }
    // Both are straight: their distance is linear in the level.
    const double at_low = on_b.first - on_a.first;
    const double at_high = on_b.second - on_a.second;
    return {std::min(at_low, at_high), std::max(at_low, at_high), {a.edge, b.edge}};
}

bool TranslationFinder::add_intervals(double most, double rounding, WorkBudget& work) {
    std::sort(of_b_.begin(), of_b_.end(),
              [](const Level& i, const Level& j) { return i.low < j.low; });
    double highest = 0.0;
    for (const Level& b : of_b_) {
        highest = std::max(highest, b.high - b.low);
    }
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
            const Interval interval = interval_between(a, *b, rounding);
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
    const double rounding = a.rounding + b.rounding;
    project(a, in_reach_of_b_, b.box, direction, most, rounding, of_a_);
    project(b, in_reach_of_a_, a.box, direction, -most, rounding, of_b_);
    work.add(in_reach_of_a_.size() + in_reach_of_b_.size());
    gaps_.clear();
    if (!add_intervals(most, rounding, work)) {
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
