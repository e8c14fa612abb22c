#include <engine/base/interruption.hpp>
#include <engine/cpu/inside_samples.hpp>

#include <algorithm>

namespace nearfield::cpu {

using geometry::Vector;
using narrowphase::Crossing;
using simd::TransformedEdges;

std::span<const std::uint32_t> InsideSamples::edges_near(const simd::TransformedEdges& a,
                                                         const simd::TransformedEdges& b) {
    if (near_.size() < simd::padded(a.count)) {
        near_.resize(simd::padded(a.count));
    }
    const simd::Extent box = geometry::extent_of(b.box);
    const std::uint32_t count = is_small(a)
                                    ? simd::kernels::find_edges_in(a, box, near_.data())
                                    : simd::kernels::find_edges_in(a.tree(), box, near_.data());
    return {near_.data(), count};
}

void InsideSamples::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                         bool reversed, double spacing, simd::PointList& inside) {
    a_ = &a;
    b_ = &b;
    inside_ = &inside;
    doubtful_.clear();
    if (!is_small(b)) {
        sides_.begin(b.tree());
    }
    std::span<const narrowphase::Crossing> crossings =
        reversed ? crossings_.find_reversed(a, b) : crossings_.find(a, b);
    const geometry::Polygon& polygon = a.placed.polygon();
    plan::EdgeSampler sampler(polygon, spacing);
    std::uint32_t ring = 0;
    std::uint32_t after_last = 0;  // index of the last edge plus 1
    SparseCheckpoint<64> checkpoint;
    for (const std::uint32_t edge : edges_near(a, b)) {
        checkpoint.step();
        while (edge >= polygon.ring_end(ring)) {
            ++ring;
        }
        if (edge == polygon.ring_begin(ring)) {
            side_.reset();
        } else if (edge != after_last) {
            side_ = is_outside;  // the edge before is outside B's box
        }
        after_last = edge + 1;
        const auto first =
            std::find_if(crossings.begin(), crossings.end(),
                         [edge](const narrowphase::Crossing& one) { return one.edge >= edge; });
        crossings = {first, crossings.end()};
        const auto end =
            std::find_if(crossings.begin(), crossings.end(),
                         [edge](const narrowphase::Crossing& one) { return one.edge != edge; });
        const std::span<const narrowphase::Crossing> of_edge(crossings.begin(), end);
        if (of_edge.empty() && !side_) {
            side_ = side_of(a.start(edge));
        }
        if (!of_edge.empty() || side_ != is_outside) {
            follow(edge, sampler.parts_of(edge), of_edge);
        }
    }
    if (!doubtful_.empty()) {
        sides_.answer();
        remove_outside();
    }
}

void InsideSamples::follow(std::uint32_t edge, double parts,
                           std::span<const narrowphase::Crossing> crossings) {
    // Only a small part of a long edge may be in the box, and it may run along an edge of B.
    const plan::PartRange in_box = plan::parts_roughly_within(a_->placed, edge, parts, b_->box);
    if (in_box.first > 0.0) {
        side_ = is_outside;
    }
    auto part = static_cast<std::uint32_t>(in_box.first);
    const auto end = static_cast<std::uint32_t>(in_box.end);
    const auto part_at = [&](double parameter) {
        return static_cast<std::uint32_t>(
            std::clamp(parameter * parts, static_cast<double>(part), in_box.end));
    };
    for (const narrowphase::Crossing& crossing : crossings) {
        // The parts that begin where the edge may cross, and the one before them.
        const std::uint32_t from = part_at(crossing.from);
        const std::uint32_t to = std::min(part_at(crossing.to) + 1, end);
        add_interval(edge, parts, part, from);
        add_one_by_one(edge, parts, from, to);
        part = std::max(part, to);
        side_.reset();
    }
    add_interval(edge, parts, part, end);
    if (in_box.end < parts) {
        side_ = is_outside;
    }
}

void InsideSamples::add_interval(std::uint32_t edge, double parts, std::uint32_t part,
                                 std::uint32_t end) {
    if (part >= end) {
        return;
    }
    if (!side_) {
        side_ = side_of(a_->at(edge, part / parts));
    }
    if (side_ == is_outside) {
        return;
    }
    inside_->reserve(inside_->size() + (end - part));
    for (; part < end; ++part) {
        add(a_->at(edge, part / parts), *side_);
    }
}

void InsideSamples::add_one_by_one(std::uint32_t edge, double parts, std::uint32_t part,
                                   std::uint32_t end) {
    inside_->reserve(inside_->size() + (end - part));
    SparseCheckpoint<64> checkpoint;
    for (; part < end; ++part) {
        checkpoint.step();
        const Vector point = a_->at(edge, part / parts);
        add(point, side_of(point));
    }
}

InsideSamples::Ticket InsideSamples::side_of(const Vector& point) {
    if (!b_->box.contains(point)) {
        return is_outside;
    }
    return is_small(*b_) ? narrowphase::RayParities::known(contains(*b_, point))
                         : sides_.ask(point.x(), point.y());
}

void InsideSamples::add(const Vector& point, Ticket side) {
    if (side == is_outside) {
        return;
    }
    const auto index = static_cast<std::uint32_t>(inside_->size());
    if (side != is_inside &&
        (doubtful_.empty() || doubtful_.back().end != index || doubtful_.back().side != side)) {
        doubtful_.push_back({index, index, side});
    }
    if (side != is_inside) {
        ++doubtful_.back().end;
    }
    inside_->push(point.x(), point.y());
}

void InsideSamples::remove_outside() {
    const simd::FoundPoints points = inside_->found();
    auto doubtful = doubtful_.begin();
    std::uint32_t kept = doubtful->first;
    for (std::uint32_t i = kept; i < inside_->size(); ++i) {
        while (doubtful != doubtful_.end() && doubtful->end <= i) {
            ++doubtful;
        }
        points.x[kept] = points.x[i];
        points.y[kept] = points.y[i];
        const bool is_doubtful = doubtful != doubtful_.end() && doubtful->first <= i;
        kept += !is_doubtful || sides_.is_odd(doubtful->side) ? 1U : 0U;
    }
    inside_->resize(kept);
}

}  // namespace nearfield::cpu
