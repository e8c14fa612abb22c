#pragma once

#include <nearfield/shape.hpp>

#include <tests/oracle/plane.hpp>

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace nearfield::test {

/// A grid of points that finds whether one is near a position.
class PointIndex {
public:
    explicit PointIndex(double radius) : radius_(radius) {}

    void add(const Vector2& point) {
        if (squares_.empty()) {
            origin_ = point;
        }
        squares_[key(column(point), row(point))].push_back(point);
    }

    /// True if an added point is no farther from `point` than the radius.
    [[nodiscard]] bool has_near(const Vector2& point) const {
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                const auto square = squares_.find(key(column(point) + dx, row(point) + dy));
                if (square == squares_.end()) {
                    continue;
                }
                for (const Vector2& candidate : square->second) {
                    if (oracle::distance(candidate, point) <= radius_) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

private:
    [[nodiscard]] std::int64_t column(const Vector2& p) const {
        return static_cast<std::int64_t>(std::floor((p.x - origin_.x) / radius_));
    }
    [[nodiscard]] std::int64_t row(const Vector2& p) const {
        return static_cast<std::int64_t>(std::floor((p.y - origin_.y) / radius_));
    }
    /// Modulo 2^64: squares far apart may share one.
    static std::uint64_t key(std::int64_t column, std::int64_t row) {
        return static_cast<std::uint64_t>(column) * 0x100000000 + static_cast<std::uint64_t>(row);
    }

    double radius_;
    Vector2 origin_;
    std::unordered_map<std::uint64_t, std::vector<Vector2>> squares_;
};

}  // namespace nearfield::test
