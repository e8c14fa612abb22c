#include <engine/geometry/morton.hpp>
#include <engine/outline/box_pairs.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace nearfield::outline {
namespace {

std::vector<std::uint32_t> morton_order(std::span<const geometry::Box> boxes) {
    geometry::Box all;
    for (const geometry::Box& box : boxes) {
        all.extend(box.center());
    }
    const geometry::Vector scale = all.sizes().cwiseMax(1e-300).cwiseInverse();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> codes;
    codes.reserve(boxes.size());
    for (const geometry::Box& box : boxes) {
        const geometry::Vector place = (box.center() - all.min()).cwiseProduct(scale);
        codes.emplace_back(geometry::on_morton_curve(place.x(), place.y()),
                           static_cast<std::uint32_t>(codes.size()));
    }
    std::sort(codes.begin(), codes.end());
    std::vector<std::uint32_t> order;
    order.reserve(codes.size());
    for (const auto& [code, index] : codes) {
        order.push_back(index);
    }
    return order;
}

}  // namespace

BoxPairs::BoxPairs(std::span<const geometry::Box> boxes) : order_(morton_order(boxes)) {
    std::vector<geometry::Box>& leaves = levels_.emplace_back();
    leaves.reserve(boxes.size());
    for (const std::uint32_t index : order_) {
        leaves.push_back(boxes[index]);
    }
    while (levels_.back().size() > 1) {
        const std::vector<geometry::Box>& below = levels_.back();
        std::vector<geometry::Box> level;
        level.reserve(below.size() / children + 1);
        for (std::size_t first = 0; first < below.size(); first += children) {
            geometry::Box box;
            for (std::size_t i = first; i < std::min(first + children, below.size()); ++i) {
                box.extend(below[i]);
            }
            level.push_back(box);
        }
        levels_.push_back(std::move(level));
    }
}

}  // namespace nearfield::outline
