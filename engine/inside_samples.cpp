#include <engine/inside_samples.hpp>

#include <algorithm>

namespace nearfield {

using exact::Crossing;
using exact::PlacedEdges;
using geometry::Vector;

std::span<const std::uint32_t> InsideSamples::edges_near(const PlacedEdges& a,
                                                         const PlacedEdges& b) {
    if (near_.size() < exact::padded(a.count)) {
        near_.resize(exact::padded(a.count));
    }
    const exact::Extent box = exact::extent_of(b.box);
    const std::uint32_t count = exact::is_small(a)
                                    ? exact::kernels::find_edges_in(a, box, near_.data())
                                    : exact::kernels::find_edges_in(a.tree(), box, near_.data());
    return {near_.data(), count};
}

void InsideSamples::find(const PlacedEdges& a, const PlacedEdges& b, bool reversed, double spacing,
                         PointList& inside) {
    a_ = &a;
    b_ = &b;
    inside_ = &inside;
    std::span<const Crossing> crossings =
        reversed ? crossings_.find_reversed(a, b) : crossings_.find(a, b);
    const geometry::Polygon& polygon = a.placed.polygon();
    plan::EdgeSampler sampler(polygon, spacing);
    std::uint32_t ring = 0;
    std::uint32_t after_last = 0;  // edge
    for (const std::uint32_t edge : edges_near(a, b)) {
        while (edge >= polygon.ring_end(ring)) {
            ++ring;
        }
        if (edge == polygon.ring_begin(ring)) {
            side_ = Side::unknown;
        } else if (edge != after_last) {
            side_ = Side::outside;  // the edge before does not even meet B's box
        }
        after_last = edge + 1;
        const auto first = std::find_if(crossings.begin(), crossings.end(),
                                        [edge](const Crossing& one) { return one.edge >= edge; });
        crossings = {first, crossings.end()};
        const auto end = std::find_if(crossings.begin(), crossings.end(),
                                      [edge](const Crossing& one) { return one.edge != edge; });
        const std::span<const Crossing> of_edge(crossings.begin(), end);
        if (of_edge.empty() && side_ == Side::unknown) {
            side_ = side_of(a.start(edge));
        }
        if (!of_edge.empty() || side_ == Side::inside) {
            follow(edge, sampler.parts_of(edge), of_edge);
        }
    }
}

void InsideSamples::follow(std::uint32_t edge, double parts, std::span<const Crossing> crossings) {
    // Of a long edge little may be in the box, and all of it along an edge of B.
    const plan::PartRange in_box = plan::parts_roughly_within(a_->placed, edge, parts, b_->box);
    if (in_box.first > 0.0) {
        side_ = Side::outside;
    }
    auto part = static_cast<std::uint32_t>(in_box.first);
    const auto end = static_cast<std::uint32_t>(in_box.end);
    const auto part_at = [&](double parameter) {
        return static_cast<std::uint32_t>(
            std::clamp(parameter * parts, static_cast<double>(part), in_box.end));
    };
    for (const Crossing& crossing : crossings) {
        // Parts that begin where the edge may cross, and one before or behind them.
        const std::uint32_t from = part_at(crossing.from);
        const std::uint32_t to = std::min(part_at(crossing.to) + 1, end);
        add_stretch(edge, parts, part, from);
        add_one_by_one(edge, parts, from, to);
        part = std::max(part, to);
        side_ = Side::unknown;
    }
    add_stretch(edge, parts, part, end);
    if (in_box.end < parts) {
        side_ = Side::outside;
    }
}

void InsideSamples::add_stretch(std::uint32_t edge, double parts, std::uint32_t part,
                                std::uint32_t end) {
    if (part >= end) {
        return;
    }
    if (side_ == Side::unknown) {
        side_ = side_of(a_->at(edge, part / parts));
    }
    if (side_ == Side::outside) {
        return;
    }
    inside_->reserve(inside_->size() + (end - part));
    for (; part < end; ++part) {
        const Vector point = a_->at(edge, part / parts);
        inside_->push(point.x(), point.y());
    }
}

void InsideSamples::add_one_by_one(std::uint32_t edge, double parts, std::uint32_t part,
                                   std::uint32_t end) {
    inside_->reserve(inside_->size() + (end - part));
    for (; part < end; ++part) {
        const Vector point = a_->at(edge, part / parts);
        if (side_of(point) == Side::inside) {
            inside_->push(point.x(), point.y());
        }
    }
}

InsideSamples::Side InsideSamples::side_of(const Vector& point) const {
    return b_->box.contains(point) && contains(*b_, point) ? Side::inside : Side::outside;
}

}  // namespace nearfield
