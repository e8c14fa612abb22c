#pragma once

#include <engine/simd/edge_kernels.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::simd {

/// Points as a structure of arrays, with the padding that kernels need. Reuses its memory.
class PointList {
public:
    void clear() { count_ = 0; }
    /// Allocates space for `count` points in all; present points stay.
    void reserve(std::size_t count) {
        // Sizes are checked separately: they differ if memory ran out between the two.
        const std::size_t room = padded(count) + max_lanes;
        if (x_.size() < room) {
            x_.resize(room);
        }
        if (y_.size() < room) {
            y_.resize(room);
        }
    }
    /// Precondition: reserve() has allocated the space.
    void push(double x, double y) {
        x_[count_] = x;
        y_[count_] = y;
        ++count_;
    }
    /// Sets the size after points were written to found().
    void resize(std::uint32_t count) { count_ = count; }

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] FoundPoints found() { return {x_.data(), y_.data()}; }
    [[nodiscard]] PointArrays arrays() const { return {count_, x_.data(), y_.data()}; }

private:
    std::vector<double> x_;
    std::vector<double> y_;
    std::uint32_t count_ = 0;
};

}  // namespace nearfield::simd
