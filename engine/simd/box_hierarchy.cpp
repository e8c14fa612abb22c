#include <engine/geometry/hilbert_curve.hpp>
#include <engine/simd/box_hierarchy.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nearfield::simd {
namespace {

using geometry::Box;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Extent nothing{infinity, infinity, -infinity, -infinity};

bool is_empty(const Extent& box) {
    return !(box.low_x <= box.high_x && box.low_y <= box.high_y);
}

}  // namespace

void BoxHierarchy::Node::clear() {
    low_x.fill(infinity);
    low_y.fill(infinity);
    high_x.fill(-infinity);
    high_y.fill(-infinity);
}

void BoxHierarchy::Node::set(std::uint32_t box, const Extent& extent) {
    low_x[box] = extent.low_x;
    low_y[box] = extent.low_y;
    high_x[box] = extent.high_x;
    high_y[box] = extent.high_y;
}

Extent BoxHierarchy::Node::at(std::uint32_t box) const {
    return {low_x[box], low_y[box], high_x[box], high_y[box]};
}

void BoxHierarchy::set(std::uint32_t name, const Box& box) {
    if (name >= leaves_.size()) {
        boxes_.resize(name + 1, nothing);
        leaves_.resize(name + 1, nowhere);
    }
    boxes_[name] = box.isEmpty() ? nothing : geometry::extent_of(box);
    if (levels_.empty()) {
        return;  // it will be built
    }
    if (leaves_[name] == nowhere) {
        if (free_.empty()) {
            levels_.clear();
            return;
        }
        leaves_[name] = free_.back();
        names_[free_.back()] = name;
        free_.pop_back();
    }
    set_box(0, leaves_[name], boxes_[name]);
    refit(leaves_[name]);
}

void BoxHierarchy::remove(std::uint32_t name) {
    if (name >= leaves_.size()) {
        return;
    }
    boxes_[name] = nothing;
    const std::uint32_t leaf = std::exchange(leaves_[name], nowhere);
    if (levels_.empty() || leaf == nowhere) {
        return;
    }
    set_box(0, leaf, nothing);
    refit(leaf);
    names_[leaf] = nowhere;
    free_.push_back(leaf);
}

void BoxHierarchy::prepare() {
    if (is_outdated()) {
        try {
            build();
        } catch (...) {
            levels_.clear();  // to be built again
            throw;
        }
    }
}

void BoxHierarchy::trim() {
    levels_ = {};
    names_ = {};
    free_ = {};
    on_curve_ = {};
}

void BoxHierarchy::set_box(std::size_t level, std::uint32_t box, const Extent& extent) {
    levels_[level][box / fan_out].set(box % fan_out, extent);
}

double BoxHierarchy::size_of_node(std::uint32_t node) const {
    if (levels_.size() < 2) {
        return 0.0;
    }
    const Extent box = levels_[1][node / fan_out].at(node % fan_out);
    return is_empty(box) ? 0.0 : box.high_x - box.low_x + box.high_y - box.low_y;
}

void BoxHierarchy::join(std::size_t level, std::uint32_t node) {
    set_box(level + 1, node, kernels::join_boxes(levels_[level][node].boxes(), 0));
}

void BoxHierarchy::refit(std::uint32_t leaf) {
    std::uint32_t node = leaf / fan_out;
    for (std::size_t level = 0; level + 1 < levels_.size(); ++level, node /= fan_out) {
        const double before = level == 0 ? size_of_node(node) : 0.0;
        join(level, node);
        if (level == 0) {
            size_ += size_of_node(node) - before;
        }
    }
}

void BoxHierarchy::build() {
    Extent all = nothing;
    std::uint32_t count = 0;
    for (const Extent& box : boxes_) {
        if (!is_empty(box)) {
            ++count;
            all = {std::min(all.low_x, box.low_x), std::min(all.low_y, box.low_y),
                   std::max(all.high_x, box.high_x), std::max(all.high_y, box.high_y)};
        }
    }
    const geometry::HilbertCurve curve(all);
    leaves_.assign(boxes_.size(), nowhere);
    on_curve_.clear();
    for (std::uint32_t name = 0; name < boxes_.size(); ++name) {
        const Extent& box = boxes_[name];
        if (!is_empty(box)) {
            on_curve_.emplace_back(
                curve.at(0.5 * (box.low_x + box.high_x), 0.5 * (box.low_y + box.high_y)), name);
        }
    }
    std::sort(on_curve_.begin(), on_curve_.end());
    // Room for as much as a quarter more, so that additions do not start over each time.
    const auto leaves = static_cast<std::uint32_t>(padded(count + count / 4 + fan_out));
    names_.assign(leaves, nowhere);
    free_.clear();
    free_.reserve(leaves);  // so that removing never fails
    for (std::uint32_t leaf = leaves; leaf-- > count;) {
        free_.push_back(leaf);
    }
    std::size_t level = 0;
    for (std::uint32_t nodes = leaves / fan_out;; nodes = AabbTree::boxes_over(nodes)) {
        if (level == levels_.size()) {
            levels_.emplace_back();
        }
        levels_[level].resize(nodes);
        for (Node& node : levels_[level]) {
            node.clear();
        }
        ++level;
        if (nodes == 1) {
            break;
        }
    }
    levels_.resize(level);
    for (std::uint32_t leaf = 0; leaf < count; ++leaf) {
        const std::uint32_t name = on_curve_[leaf].second;
        names_[leaf] = name;
        leaves_[name] = leaf;
        set_box(0, leaf, boxes_[name]);
    }
    size_ = 0.0;
    for (std::size_t below = 0; below + 1 < levels_.size(); ++below) {
        for (std::uint32_t node = 0; node < levels_[below].size(); ++node) {
            join(below, node);
            size_ += below == 0 ? size_of_node(node) : 0.0;
        }
    }
    size_when_built_ = size_;
}

std::size_t BoxHierarchy::bytes() const {
    std::size_t bytes =
        sizeof(Extent) * boxes_.capacity() +
        sizeof(std::uint32_t) * (names_.capacity() + leaves_.capacity() + free_.capacity()) +
        sizeof(on_curve_[0]) * on_curve_.capacity();
    for (const Level& level : levels_) {
        bytes += sizeof(Node) * level.capacity();
    }
    return bytes;
}

}  // namespace nearfield::simd
