#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::world {

/// An edge of an instance and how far away it is; a negative distance is that of an instance from
/// inside. Of equally near ones, the instance added first, then the edge of lower index comes
/// first.
struct NearInstanceEdge {
    double distance;
    std::uint64_t number;  // of the instance
    std::uint32_t instance;
    std::uint32_t edge;

    [[nodiscard]] bool operator<(const NearInstanceEdge& other) const {
        return distance != other.distance ? distance < other.distance
               : number != other.number   ? number < other.number
                                          : edge < other.edge;
    }
};

/// The nearest of what is offered. Keeps its memory. `Found` is a NearInstanceEdge.
template <class Found>
class NearestList {
public:
    /// Starts anew. `wanted`: how many are kept, at least 1, of those within `max_distance`.
    void begin(std::size_t wanted, double max_distance) {
        found_.clear();
        wanted_ = wanted;
        max_distance_ = max_distance;
    }

    /// In ascending order.
    [[nodiscard]] const std::vector<Found>& found() const { return found_; }

    /// The square of the distance beyond which nothing is of interest, or slightly more, so that
    /// what is exactly as near is not left out.
    [[nodiscard]] double squared_reach(double rounding) const {
        const double most =
            reach() * (1.0 + 8.0 * std::numeric_limits<double>::epsilon()) + rounding;
        return most * most;
    }
    /// The distance beyond which nothing is of interest.
    [[nodiscard]] double reach() const {
        const double farthest = found_.size() == wanted_ ? found_.back().distance
                                                         : std::numeric_limits<double>::infinity();
        return std::max(std::min(farthest, max_distance_), 0.0);
    }

    void offer(const Found& found) {
        if (found.distance > max_distance_) {
            return;
        }
        if (found_.size() == wanted_) {
            if (!(found < found_.back())) {
                return;
            }
            found_.pop_back();
        }
        found_.insert(std::upper_bound(found_.begin(), found_.end(), found), found);
    }

private:
    std::size_t wanted_ = 0;
    double max_distance_ = 0.0;
    std::vector<Found> found_;
};

}  // namespace nearfield::world
