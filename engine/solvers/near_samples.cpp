#include <engine/base/interruption.hpp>
#include <engine/narrowphase/located_points.hpp>
#include <engine/queries/edge_sampler.hpp>
#include <engine/solvers/near_samples.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::solvers {

using geometry::Vector;
using simd::Extent;
using simd::ParameterInterval;
using simd::TransformedEdges;

std::span<const std::uint32_t> NearSamples::find_edges() {
    const simd::Extent box = geometry::extent_of(near_b_);
    if (edges_.size() < simd::padded(a_->count)) {
        edges_.resize(simd::padded(a_->count));
    }
    const std::uint32_t count =
        is_small(*a_)
            ? simd::kernels::find_edges_in(*a_, box, edges_.data())
            : simd::kernels::find_edges_near(a_->tree(), box, b_->tree(), reach_, edges_.data());
    return {edges_.data(), count};
}

std::span<const simd::ParameterInterval> NearSamples::find_intervals(std::uint32_t edge) {
    const std::uint32_t count = is_small(*b_)
                                    ? simd::kernels::find_intervals_near(*a_, edge, picked_.edges(),
                                                                         reach_, intervals_.data())
                                    : find_intervals_by_tree(edge);
    if (count > 1) {
        std::sort(intervals_.begin(), intervals_.begin() + count,
                  [](const simd::ParameterInterval& i, const simd::ParameterInterval& j) {
                      return i.from < j.from;
                  });
    }
    return {intervals_.data(), count};
}

std::uint32_t NearSamples::find_intervals_by_tree(std::uint32_t edge) {
    if (!trials_.skip()) {
        // Several times what a tree takes that divides the edges well.
        constexpr std::uint32_t many_visits = 32;
        simd::VisitsLeft left{many_visits};
        const std::uint32_t count =
            simd::kernels::find_intervals_near(*a_, edge, *tree_, reach_, left, intervals_.data());
        trials_.record(left.count == 0);
        if (left.count > 0) {
            return count;
        }
    }
    // Any part of the edge may be near.
    intervals_.front() = {};
    return 1;
}

void NearSamples::begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                        double distance) {
    a_ = &a;
    b_ = &b;
    // Several times the rounding of the transformed vertices: measured distances are rounded too.
    reach_ = distance + 8.0 * (a.rounding + b.rounding);
    near_b_ = geometry::grown(b.box, reach_);
    at_once_ = narrowphase::points_at_once(b.count);
    points_.clear();
    places_.clear();
}

double NearSamples::max_samples(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                double distance, double spacing) {
    begin(a, b, distance);
    queries::EdgeSampler sampler(a.placed.polygon(), spacing);
    double count = 0.0;
    SparseCheckpoint<256> checkpoint;
    for (const std::uint32_t edge : find_edges()) {
        checkpoint.step();
        const queries::PartRange range =
            queries::parts_within(a.placed, edge, sampler.parts_of(edge), near_b_);
        count += range.end - range.first;
    }
    return count;
}

void NearSamples::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                       double distance, double spacing, FunctionRef<void()> use) {
    begin(a, b, distance);
    use_ = &use;
    if (is_small(b)) {
        picked_.pick(b, geometry::extent_of(geometry::grown(a_->box, reach_)));
        if (picked_.empty()) {
            return;
        }
    } else {
        tree_.emplace(b.tree());
        trials_ = {};
    }
    queries::EdgeSampler sampler(a_->placed.polygon(), spacing);
    SparseCheckpoint<16> checkpoint;
    for (const std::uint32_t edge : find_edges()) {
        checkpoint.step();
        const double parts = sampler.parts_of(edge);
        if (parts > 0.0) {
            add(edge, parts);
        }
    }
    if (points_.size() > 0) {
        hand_over();
    }
}

void NearSamples::hand_over() {
    (*use_)();
    points_.clear();
    places_.clear();
}

void NearSamples::add(std::uint32_t edge, double parts) {
    // If there are many intervals, one may cover all of a long edge.
    const queries::PartRange near = queries::parts_roughly_within(a_->placed, edge, parts, near_b_);
    auto part = static_cast<Part>(near.first);
    for (const simd::ParameterInterval& interval : find_intervals(edge)) {
        part = std::max(part, static_cast<Part>(interval.from * parts));
        const auto end =
            static_cast<Part>(std::min(std::floor(interval.to * parts) + 1.0, near.end));
        while (part < end) {
            const Part stop = std::min(end, part + static_cast<Part>(at_once_ - points_.size()));
            points_.reserve(points_.size() + static_cast<std::size_t>(stop - part));
            for (; part < stop; ++part) {
                const double parameter = static_cast<double>(part) / parts;
                const Vector point = a_->at(edge, parameter);
                points_.push(point.x(), point.y());
                places_.push_back({edge, parameter});
            }
            if (points_.size() == at_once_) {
                checkpoint();
                hand_over();
            }
        }
    }
}

}  // namespace nearfield::solvers
