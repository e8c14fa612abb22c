#pragma once

#include <nearfield/cost.hpp>

#include <algorithm>
#include <limits>

namespace nearfield::select {

/// What a technique takes that cannot answer.
inline constexpr double never = std::numeric_limits<double>::infinity();

/// The weights of the device's and the CPU's work in a weighted time.
struct LoadWeights {
    double device = 1.0;
    double cpu = 1.0;
};

/// What the device's and the CPU's time count at a price of the device's, from 0 (the device's
/// work is hidden) to 1 (the CPU's is). A batch takes as long as its weighted time at 0 or at 1,
/// whichever is longer.
[[nodiscard]] inline LoadWeights weights_at(double price, double overlap) {
    return {1.0 - (1.0 - price) * overlap, 1.0 - price * overlap};
}

/// The microseconds of a query or a batch, by who spends them.
struct Load {
    double alone = 0.0;   ///< the calling thread, while the device has nothing to do
    double device = 0.0;  ///< the device
    double cpu = 0.0;     ///< the calling thread, while the device works: answers

    Load& operator+=(const Load& other) {
        alone += other.alone;
        device += other.device;
        cpu += other.cpu;
        return *this;
    }
    Load& operator-=(const Load& other) {
        alone -= other.alone;
        device -= other.device;
        cpu -= other.cpu;
        return *this;
    }

    /// Of a batch, by CostModel::overlap.
    [[nodiscard]] double time(double overlap) const {
        return alone + device + cpu - overlap * std::min(device, cpu);
    }
    [[nodiscard]] double weighted(const LoadWeights& weights) const {
        return alone + weights.device * device + weights.cpu * cpu;
    }
};

}  // namespace nearfield::select
