#pragma once

#include <engine/exact/edge_kernels.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield {

/// Points, an array for each coordinate, with the room behind them that kernels need. Keeps its
/// memory.
class PointList {
public:
    void clear() { count_ = 0; }
    /// Room for so many in all; what is there stays.
    void reserve(std::size_t count) {
        // Each by itself: where memory ran out between the two, they differ.
        const std::size_t room = exact::padded(count) + exact::most_lanes;
        if (x_.size() < room) {
            x_.resize(room);
        }
        if (y_.size() < room) {
            y_.resize(room);
        }
    }
    /// There has to be room.
    void push(double x, double y) {
        x_[count_] = x;
        y_[count_] = y;
        ++count_;
    }
    /// Takes on points that were written to found().
    void resize(std::uint32_t count) { count_ = count; }

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] exact::FoundPoints found() { return {x_.data(), y_.data()}; }
    [[nodiscard]] exact::PointArrays arrays() const { return {count_, x_.data(), y_.data()}; }

private:
    std::vector<double> x_;
    std::vector<double> y_;
    std::uint32_t count_ = 0;
};

}  // namespace nearfield
