#pragma once

#include <nearfield/cost.hpp>

#include <algorithm>

namespace nearfield::select {

/// The weights of the device's and the CPU's work in a weighted time.
struct LoadWeights {
    double device = 1.0;
    double cpu = 1.0;
};

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
