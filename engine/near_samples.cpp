#include <engine/near_samples.hpp>
#include <engine/plan/edge_sampler.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield {

using exact::Extent;
using exact::PlacedEdges;
using exact::Stretch;
using geometry::Vector;

std::span<const std::uint32_t> NearSamples::find_edges() {
    const Extent box = exact::extent_of(near_b_);
    if (edges_.size() < exact::padded(a_->count)) {
        edges_.resize(exact::padded(a_->count));
    }
    const std::uint32_t count =
        exact::is_small(*a_)
            ? exact::kernels::find_edges_in(*a_, box, edges_.data())
            : exact::kernels::find_edges_near(a_->tree(), box, b_->tree(), reach_, edges_.data());
    return {edges_.data(), count};
}

std::span<const Stretch> NearSamples::find_stretches(std::uint32_t edge) {
    const std::uint32_t count =
        exact::is_small(*b_)
            ? exact::kernels::find_stretches_near(*a_, edge, picked_.edges(), reach_,
                                                  stretches_.data())
            : exact::kernels::find_stretches_near(*a_, edge, *tree_, reach_, stretches_.data());
    if (count > 1) {
        std::sort(stretches_.begin(), stretches_.begin() + count,
                  [](const Stretch& i, const Stretch& j) { return i.from < j.from; });
    }
    return {stretches_.data(), count};
}

void NearSamples::find(const PlacedEdges& a, const PlacedEdges& b, double distance,
                       double spacing) {
    a_ = &a;
    b_ = &b;
    // Several times what the placed vertices are off by: what is measured rounds as well.
    reach_ = distance + 8.0 * (a.rounding + b.rounding);
    near_b_ = geometry::grown(b.box, reach_);
    points_.clear();
    places_.clear();
    if (exact::is_small(b)) {
        picked_.pick(b, exact::extent_of(geometry::grown(a.box, reach_)));
        if (picked_.empty()) {
            return;
        }
    } else {
        tree_.emplace(b.tree());
    }
    plan::EdgeSampler sampler(a.placed.polygon(), spacing);
    for (const std::uint32_t edge : find_edges()) {
        const double parts = sampler.parts_of(edge);
        if (parts > 0.0) {
            add(edge, parts);
        }
    }
}

void NearSamples::add(std::uint32_t edge, double parts) {
    // Where there are many stretches they may be told as one, of all of a long edge.
    const plan::PartRange near = plan::parts_roughly_within(a_->placed, edge, parts, near_b_);
    auto part = static_cast<std::uint32_t>(near.first);
    for (const Stretch& stretch : find_stretches(edge)) {
        part = std::max(part, static_cast<std::uint32_t>(stretch.from * parts));
        const auto end =
            static_cast<std::uint32_t>(std::min(std::floor(stretch.to * parts) + 1.0, near.end));
        points_.reserve(points_.size() + (end - std::min(part, end)));
        for (; part < end; ++part) {
            const double parameter = part / parts;
            const Vector point = a_->at(edge, parameter);
            points_.push(point.x(), point.y());
            places_.push_back({edge, parameter});
        }
    }
}

}  // namespace nearfield
