#pragma once

#include <engine/geometry/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::outline {

/// A hierarchy of boxes over boxes that are neighbours in the plane, for all pairs among them.
class BoxPairs {
public:
    explicit BoxPairs(std::span<const geometry::Box> boxes);

    /// Calls `visit(i, j)` once for each pair of different boxes that share a point, by index.
    template <class Visit>
    void for_pairs(const Visit& visit) const {
        if (!levels_.front().empty()) {
            visit_within(levels_.size() - 1, 0, visit);
        }
    }

    /// Calls `visit(i)` for each box that shares a point with another one.
    template <class Visit>
    void for_boxes_at(const geometry::Box& box, const Visit& visit) const {
        if (!levels_.front().empty() && levels_.back().front().intersects(box)) {
            visit_at(levels_.size() - 1, 0, box, visit);
        }
    }

private:
    static constexpr std::size_t children = 4;

    [[nodiscard]] std::size_t end_of_children(std::size_t level, std::size_t node) const {
        return std::min(children * (node + 1), levels_[level - 1].size());
    }

    template <class Visit>
    void visit_within(std::size_t level, std::size_t node, const Visit& visit) const {
        if (level == 0) {
            return;
        }
        const std::size_t end = end_of_children(level, node);
        for (std::size_t first = children * node; first < end; ++first) {
            visit_within(level - 1, first, visit);
            for (std::size_t second = first + 1; second < end; ++second) {
                visit_between(level - 1, first, second, visit);
            }
        }
    }

    template <class Visit>
    void visit_between(std::size_t level, std::size_t first, std::size_t second,
                       const Visit& visit) const {
        if (!levels_[level][first].intersects(levels_[level][second])) {
            return;
        }
        if (level == 0) {
            visit(order_[first], order_[second]);
            return;
        }
        for (std::size_t i = children * first; i < end_of_children(level, first); ++i) {
            if (levels_[level - 1][i].intersects(levels_[level][second])) {
                for (std::size_t j = children * second; j < end_of_children(level, second); ++j) {
                    visit_between(level - 1, i, j, visit);
                }
            }
        }
    }

    template <class Visit>
    void visit_at(std::size_t level, std::size_t node, const geometry::Box& box,
                  const Visit& visit) const {
        if (level == 0) {
            visit(order_[node]);
            return;
        }
        for (std::size_t i = children * node; i < end_of_children(level, node); ++i) {
            if (levels_[level - 1][i].intersects(box)) {
                visit_at(level - 1, i, box, visit);
            }
        }
    }

    std::vector<std::uint32_t> order_;  // in Morton order of their centres
    std::vector<std::vector<geometry::Box>>
        levels_;  // the boxes in this order, then around four of them ...
};

}  // namespace nearfield::outline
