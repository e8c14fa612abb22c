#include "edge_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nearfield::oracle {
namespace {

constexpr std::uint32_t max_in_leaf = 4;

bool boxes_meet(const Rectangle& a, const Rectangle& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

double distance_to_box(const Rectangle& box, const Vector2& point) {
    const double x = std::max({box.min.x - point.x, 0.0, point.x - box.max.x});
    const double y = std::max({box.min.y - point.y, 0.0, point.y - box.max.y});
    return std::hypot(x, y);
}

}  // namespace

EdgeTree::EdgeTree(std::vector<Edge> edges) : edges_(std::move(edges)), order_(edges_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(edges_.size() + 1);
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(edges_.size()));
}

void EdgeTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Rectangle box{{infinity, infinity}, {-infinity, -infinity}};
    for (std::uint32_t i = first; i < last; ++i) {
        for (const Vector2& end : {edges_[order_[i]].from, edges_[order_[i]].to}) {
            box.min = {std::min(box.min.x, end.x), std::min(box.min.y, end.y)};
            box.max = {std::max(box.max.x, end.x), std::max(box.max.y, end.y)};
        }
    }
    nodes_[node].box = box;
    if (last - first <= max_in_leaf) {
        nodes_[node].first = first;
        nodes_[node].count = last - first;
        return;
    }
    const bool wide = box.max.x - box.min.x > box.max.y - box.min.y;
    const auto centre = [&](std::uint32_t edge) {
        const Edge& e = edges_[edge];
        return wide ? e.from.x + e.to.x : e.from.y + e.to.y;
    };
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = child;
    nodes_.resize(nodes_.size() + 2);
    build(child, first, middle);
    build(child + 1, middle, last);
}

void EdgeTree::visit_box(const Rectangle& box,
                         const std::function<void(std::uint32_t)>& visit) const {
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (!boxes_meet(node.box, box)) {
            continue;
        }
        if (node.count == 0) {
            open.push_back(node.first);
            open.push_back(node.first + 1);
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const auto& [from, to] = edges_[order_[i]];
            const Rectangle around{{std::min(from.x, to.x), std::min(from.y, to.y)},
                                   {std::max(from.x, to.x), std::max(from.y, to.y)}};
            if (boxes_meet(around, box)) {
                visit(order_[i]);
            }
        }
    }
}

void EdgeTree::visit_nearest(const Vector2& point, double reach,
                             const std::function<double(std::uint32_t)>& visit) const {
    descend(0, point, reach, visit);
}

void EdgeTree::descend(std::uint32_t node, const Vector2& point, double& reach,
                       const std::function<double(std::uint32_t)>& visit) const {
    const Node& here = nodes_[node];
    for (std::uint32_t i = here.first; i < here.first + here.count; ++i) {
        reach = std::min(reach, visit(order_[i]));
    }
    if (here.count > 0) {
        return;
    }
    std::uint32_t near = here.first;
    std::uint32_t far = here.first + 1;
    double near_distance = distance_to_box(nodes_[near].box, point);
    double far_distance = distance_to_box(nodes_[far].box, point);
    if (far_distance < near_distance) {
        std::swap(near, far);
        std::swap(near_distance, far_distance);
    }
    if (near_distance <= reach) {
        descend(near, point, reach, visit);
    }
    if (far_distance <= reach) {
        descend(far, point, reach, visit);
    }
}

}  // namespace nearfield::oracle
