#include <engine/base/interruption.hpp>
#include <engine/narrowphase/located_points.hpp>
#include <engine/solvers/inside_samples.hpp>

#include <algorithm>

namespace nearfield::solvers {

using geometry::Vector;
using narrowphase::Crossing;
using simd::TransformedEdges;

double InsideSamples::max_samples(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                  double spacing) {
    queries::EdgeSampler sampler(a.placed.polygon(), spacing);
    double count = 0.0;
    SparseCheckpoint<256> checkpoint;
    for (const std::uint32_t edge : find_edges_in(a, b.box, near_)) {
        checkpoint.step();
        const queries::PartRange range =
            queries::parts_within(a.placed, edge, sampler.parts_of(edge), b.box);
        count += range.end - range.first;
    }
    return count;
}

void InsideSamples::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                         bool reversed, double spacing, simd::PointList& inside,
                         FunctionRef<void()> use) {
    a_ = &a;
    b_ = &b;
    inside_ = &inside;
    inside_->clear();
    at_once_ = narrowphase::points_at_once(b.count);
    use_ = &use;
    doubtful_.clear();
    side_.reset();
    if (!is_small(b)) {
        sides_.begin(b.tree());
    }
    std::span<const narrowphase::Crossing> crossings =
        reversed ? crossings_.find_reversed(a, b) : crossings_.find(a, b);
    const geometry::Polygon& polygon = a.placed.polygon();
    queries::EdgeSampler sampler(polygon, spacing);
    std::uint32_t ring = 0;
    std::uint32_t after_last = 0;  // index of the last edge plus 1
    SparseCheckpoint<64> checkpoint;
    for (const std::uint32_t edge : find_edges_in(a, b.box, near_)) {
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
    decide();
}

void InsideSamples::follow(std::uint32_t edge, double parts,
                           std::span<const narrowphase::Crossing> crossings) {
    // Only a small part of a long edge may be in the box, and it may run along an edge of B.
    const queries::PartRange in_box =
        queries::parts_roughly_within(a_->placed, edge, parts, b_->box);
    if (in_box.first > 0.0) {
        side_ = is_outside;
    }
    auto part = static_cast<Part>(in_box.first);
    const auto end = static_cast<Part>(in_box.end);
    const auto part_at = [&](double parameter) {
        return static_cast<Part>(
            std::clamp(parameter * parts, static_cast<double>(part), in_box.end));
    };
    for (const narrowphase::Crossing& crossing : crossings) {
        // The parts that begin where the edge may cross, and the one before them.
        const Part from = part_at(crossing.from);
        const Part to = std::min(part_at(crossing.to) + 1, end);
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

InsideSamples::Part InsideSamples::end_of_space(Part part, Part end) {
    const Part stop = std::min(end, part + static_cast<Part>(at_once_ - inside_->size()));
    inside_->reserve(inside_->size() + static_cast<std::size_t>(stop - part));
    return stop;
}

void InsideSamples::add_interval(std::uint32_t edge, double parts, Part part, Part end) {
    if (part >= end) {
        return;
    }
    if (!side_) {
        side_ = side_of(a_->at(edge, static_cast<double>(part) / parts));
    }
    while (part < end && side_ != is_outside) {
        for (const Part stop = end_of_space(part, end); part < stop; ++part) {
            add(a_->at(edge, static_cast<double>(part) / parts), *side_);
        }
        hand_over();
    }
}

void InsideSamples::add_one_by_one(std::uint32_t edge, double parts, Part part, Part end) {
    SparseCheckpoint<64> checkpoint;
    while (part < end) {
        for (const Part stop = end_of_space(part, end); part < stop; ++part) {
            checkpoint.step();
            const Vector point = a_->at(edge, static_cast<double>(part) / parts);
            add(point, side_of(point));
        }
        hand_over();
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

void InsideSamples::hand_over() {
    if (inside_->size() < at_once_) {
        return;
    }
    checkpoint();
    decide();
    if (inside_->size() > at_once_ / 2) {
        (*use_)();
        inside_->clear();
    }
}

void InsideSamples::decide() {
    if (doubtful_.empty()) {
        return;
    }
    sides_.answer();
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
    doubtful_.clear();
    if (side_) {
        side_ = narrowphase::RayParities::known(sides_.is_odd(*side_));
    }
}

}  // namespace nearfield::solvers
