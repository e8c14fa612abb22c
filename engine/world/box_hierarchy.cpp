#include <engine/world/box_hierarchy.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nearfield::world {
namespace {

using geometry::Box;
using simd::Extent;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Extent nothing{infinity, infinity, -infinity, -infinity};

bool is_empty(const Extent& box) {
    return !(box.low_x <= box.high_x && box.low_y <= box.high_y);
}

/// The position of a cell on a Hilbert curve through 2^16 x 2^16 cells.
std::uint32_t hilbert_index(std::uint32_t x, std::uint32_t y) {
    std::uint32_t index = 0;
    for (std::uint32_t side = 1U << 15U; side > 0; side /= 2) {
        const std::uint32_t right = (x & side) != 0 ? 1 : 0;
        const std::uint32_t upper = (y & side) != 0 ? 1 : 0;
        index += side * side * ((3 * right) ^ upper);
        if (upper == 0) {
            if (right == 1) {
                x = ~x;
                y = ~y;
            }
            std::swap(x, y);
        }
    }
    return index;
}

}  // namespace

simd::BoxArrays BoxHierarchy::Level::arrays() const {
    const std::size_t length = sides.size() / 4;
    const double* const first = sides.data();
    return {count, first, first + length, first + 2 * length, first + 3 * length};
}

void BoxHierarchy::Level::resize(std::uint32_t boxes) {
    count = boxes;
    const std::size_t length = simd::padded(boxes);
    sides.resize(4 * length);
    std::fill_n(sides.begin(), 2 * length, infinity);
    std::fill(sides.begin() + static_cast<std::ptrdiff_t>(2 * length), sides.end(), -infinity);
}

void BoxHierarchy::Level::set(std::uint32_t box, const Extent& extent) {
    const std::size_t length = sides.size() / 4;
    sides[box] = extent.low_x;
    sides[length + box] = extent.low_y;
    sides[2 * length + box] = extent.high_x;
    sides[3 * length + box] = extent.high_y;
}

Extent BoxHierarchy::Level::at(std::uint32_t box) const {
    const std::size_t length = sides.size() / 4;
    return {sides[box], sides[length + box], sides[2 * length + box], sides[3 * length + box]};
}

void BoxHierarchy::set(std::uint32_t name, const Box& box) {
    if (name >= leaves_.size()) {
        leaves_.resize(name + 1, nowhere);
        boxes_.resize(name + 1, nothing);
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
    levels_.front().set(leaves_[name], boxes_[name]);
    refit(leaves_[name]);
}

void BoxHierarchy::remove(std::uint32_t name) {
    if (name >= boxes_.size()) {
        return;
    }
    boxes_[name] = nothing;
    const std::uint32_t leaf = std::exchange(leaves_[name], nowhere);
    if (levels_.empty() || leaf == nowhere) {
        return;
    }
    levels_.front().set(leaf, nothing);
    refit(leaf);
    names_[leaf] = nowhere;
    free_.push_back(leaf);
}

void BoxHierarchy::prepare() {
    constexpr double too_large = 2.0;
    if (levels_.empty() || size_ > too_large * size_when_built_) {
        build();
    }
}

void BoxHierarchy::clear() {
    *this = {};
}

double BoxHierarchy::size_of_node(std::uint32_t node) const {
    if (levels_.size() < 2) {
        return 0.0;
    }
    const Extent box = levels_[1].at(node);
    return is_empty(box) ? 0.0 : box.high_x - box.low_x + box.high_y - box.low_y;
}

void BoxHierarchy::refit(std::uint32_t leaf) {
    std::uint32_t node = leaf;
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        node /= fan_out;
        const double before = level == 1 ? size_of_node(node) : 0.0;
        levels_[level].set(node,
                           simd::kernels::join_boxes(levels_[level - 1].arrays(), fan_out * node));
        if (level == 1) {
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
    const auto cell_of = [](double low, double high, double from, double to) {
        constexpr double cells = 65535.0;
        const double part = to > from ? (0.5 * (low + high) - from) / (to - from) : 0.0;
        return static_cast<std::uint32_t>(std::clamp(cells * part, 0.0, cells));
    };
    on_curve_.clear();
    for (std::uint32_t name = 0; name < boxes_.size(); ++name) {
        leaves_[name] = nowhere;
        const Extent& box = boxes_[name];
        if (!is_empty(box)) {
            on_curve_.emplace_back(
                hilbert_index(cell_of(box.low_x, box.high_x, all.low_x, all.high_x),
                              cell_of(box.low_y, box.high_y, all.low_y, all.high_y)),
                name);
        }
    }
    std::sort(on_curve_.begin(), on_curve_.end());
    // Room for as much as a quarter more, so that additions do not start over each time.
    std::uint32_t leaves = static_cast<std::uint32_t>(simd::padded(count + count / 4 + fan_out));
    names_.assign(leaves, nowhere);
    free_.clear();
    for (std::uint32_t leaf = leaves; leaf-- > count;) {
        free_.push_back(leaf);
    }
    std::size_t level = 0;
    for (;; ++level, leaves = simd::AabbTree::boxes_over(leaves)) {
        if (level == levels_.size()) {
            levels_.emplace_back();
        }
        levels_[level].resize(leaves);
        if (leaves <= fan_out) {
            break;
        }
    }
    levels_.resize(level + 1);
    for (std::uint32_t leaf = 0; leaf < count; ++leaf) {
        const std::uint32_t name = on_curve_[leaf].second;
        names_[leaf] = name;
        leaves_[name] = leaf;
        levels_.front().set(leaf, boxes_[name]);
    }
    for (std::size_t upper = 1; upper < levels_.size(); ++upper) {
        for (std::uint32_t node = 0; node < levels_[upper].count; ++node) {
            levels_[upper].set(
                node, simd::kernels::join_boxes(levels_[upper - 1].arrays(), fan_out * node));
        }
    }
    size_ = 0.0;
    for (std::uint32_t node = 0; levels_.size() > 1 && node < levels_[1].count; ++node) {
        size_ += size_of_node(node);
    }
    size_when_built_ = size_;
}

std::size_t BoxHierarchy::bytes() const {
    std::size_t bytes =
        sizeof(Extent) * boxes_.capacity() +
        sizeof(std::uint32_t) * (names_.capacity() + leaves_.capacity() + free_.capacity()) +
        sizeof(on_curve_[0]) * on_curve_.capacity();
    for (const Level& level : levels_) {
        bytes += sizeof(double) * level.sides.capacity();
    }
    return bytes;
}

}  // namespace nearfield::world
