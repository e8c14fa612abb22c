#include <engine/base/interruption.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/vertices_inside.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::narrowphase {
namespace {

using geometry::Vector;
using simd::AabbTree;

constexpr std::uint32_t fan_out = AabbTree::fan_out;

/// The edges, and the vertices where they start, of a box of a level.
simd::EdgeRange edges_of(std::uint32_t level, std::uint32_t box, std::uint32_t count) {
    const std::uint64_t together = std::uint64_t{fan_out} << (3 * level);
    const std::uint64_t first = together * box;
    return {static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(std::min<std::uint64_t>(first + together, count))};
}

/// The order of a heap.
constexpr auto is_less_deep = [](const auto& one, const auto& other) {
    return one.most < other.most;
};

}  // namespace

void VerticesInside::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                          double touching, simd::PointList& vertices) {
    a_ = &a;
    b_ = &b;
    tree_a_.emplace(a.tree());
    tree_b_.emplace(b.tree());
    // Slightly more, as boxes and distances are rounded.
    clear_ = (1.0 + 1e-12) * touching + 4.0 * (a.rounding + b.rounding);
    left_out_ = 0;
    found_.clear();
    inside_.clear();
    deep_.clear();
    listed_.clear();
    divide(tree_a_->top_level(), 0);
    find_deepest();
    list(vertices);
}

void VerticesInside::divide(std::uint32_t level, std::uint32_t first) {
    checkpoint();
    const std::uint32_t end = std::min(first + fan_out, tree_a_->count(level));
    for (std::uint32_t box = first; box < end; ++box) {
        const geometry::Box own = geometry::box_of(tree_a_->box(level, box));
        if (!own.intersects(b_->box)) {
            continue;
        }
        const simd::EdgeRange vertices = edges_of(level, box, a_->count);
        if (!simd::kernels::meets(*tree_b_, geometry::extent_of(geometry::grown(own, clear_)))) {
            const Vector any = a_->start(vertices.first);
            if (simd::kernels::contain(*tree_b_, any.x(), any.y())) {
                left_out_ += vertices.end - vertices.first;
                found_.push_back({level, box});
            }
        } else if (level > 0) {
            divide(level - 1, fan_out * box);
        } else {
            for (std::uint32_t i = vertices.first; i < vertices.end; ++i) {
                listed_.push_back(i);
            }
        }
    }
}

bool VerticesInside::may_be_deepest(double most) const {
    return (1.0 + 1e-12) * most + 4.0 * (a_->rounding + b_->rounding) >= deepest_;
}

std::uint32_t VerticesInside::measure(std::uint32_t vertex, std::uint32_t guess) {
    const Vector at = a_->start(vertex);
    const auto squared = [&](std::uint32_t edge) {
        return geometry::nearest_on_segment(at, b_->start(edge), b_->end(edge)).squared_distance;
    };
    const std::uint32_t edge =
        simd::kernels::find_nearer(*tree_b_, at.x(), at.y(), {guess, squared(guess)}).edge;
    deepest_ = std::max(deepest_, std::sqrt(squared(edge)));
    return edge;
}

double VerticesInside::farthest(const Inside& inside) const {
    // The distance from an edge is convex, so it is largest at a corner.
    const Vector start = b_->start(inside.edge);
    const Vector end = b_->end(inside.edge);
    double squared = 0.0;
    for (const Vector& corner : tree_a_->corners(inside.level, inside.box)) {
        squared =
            std::max(squared, geometry::nearest_on_segment(corner, start, end).squared_distance);
    }
    return std::sqrt(squared);
}

void VerticesInside::add(const Inside& inside) {
    if (may_be_deepest(inside.most)) {
        inside_.push_back(inside);
        std::push_heap(inside_.begin(), inside_.end(), is_less_deep);
    }
}

void VerticesInside::find_deepest() {
    deepest_ = 0.0;
    std::uint32_t near = 0;
    for (Inside& inside : found_) {
        near = inside.edge = measure(edges_of(inside.level, inside.box, a_->count).first, near);
        inside.most = farthest(inside);
        inside.is_measured = true;
    }
    for (const Inside& inside : found_) {
        add(inside);
    }
    while (!inside_.empty() && may_be_deepest(inside_.front().most)) {
        checkpoint();
        std::pop_heap(inside_.begin(), inside_.end(), is_less_deep);
        Inside inside = inside_.back();
        inside_.pop_back();
        if (inside.is_measured) {
            open(inside);
            continue;
        }
        const double most = inside.most;
        inside.edge = measure(edges_of(inside.level, inside.box, a_->count).first, inside.edge);
        inside.most = std::min(most, farthest(inside));
        inside.is_measured = true;
        add(inside);
    }
    // Those of the boxes that were opened before a deeper vertex was known.
    for (const Vertex& vertex : deep_) {
        if (may_be_deepest(vertex.most)) {
            listed_.push_back(vertex.index);
            --left_out_;
        }
    }
    std::sort(listed_.begin(), listed_.end());
}

void VerticesInside::open(const Inside& inside) {
    if (inside.level > 0) {
        const std::uint32_t level = inside.level - 1;
        const std::uint32_t first = fan_out * inside.box;
        const std::uint32_t end = std::min(first + fan_out, tree_a_->count(level));
        for (std::uint32_t box = first; box < end; ++box) {
            Inside inner{level, box, inside.edge};
            inner.most = farthest(inner);
            add(inner);
        }
        return;
    }
    const simd::EdgeRange vertices = edges_of(0, inside.box, a_->count);
    const Vector start = b_->start(inside.edge);
    const Vector end = b_->end(inside.edge);
    Vertex deepest;
    for (std::uint32_t i = vertices.first; i < vertices.end; ++i) {
        const double most =
            std::sqrt(geometry::nearest_on_segment(a_->start(i), start, end).squared_distance);
        if (may_be_deepest(most)) {
            deep_.push_back({most, i});
            deepest = most > deepest.most ? deep_.back() : deepest;
        }
    }
    if (deepest.most > deepest_) {
        static_cast<void>(measure(deepest.index, inside.edge));
    }
}

void VerticesInside::list(simd::PointList& vertices) {
    vertices.clear();
    vertices.reserve(listed_.size());
    for (const std::uint32_t i : listed_) {
        const Vector vertex = a_->start(i);
        if (b_->box.contains(vertex)) {
            vertices.push(vertex.x(), vertex.y());
        }
    }
}

}  // namespace nearfield::narrowphase
