#pragma once

#include <engine/geometry/vector.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace nearfield::geometry {

class Polygon;
class TransformedPolygon;

/// Oriented boxes over every eight edges of a polygon, over every eight of those boxes, and so on
/// up to one group, in the polygon's own coordinates. They hold at every pose: a search turns those
/// that it looks at, and needs no other. Each lies along the chord from the first of its vertices
/// to the last: over a smooth piece of a ring it is hardly wider than the piece.
class EdgeBoxes {
public:
    static constexpr std::uint32_t fan_out = 8;

    /// Eight boxes; what is left over holds nothing.
    struct alignas(64) Group {
        double x[fan_out];  ///< of the centre
        double y[fan_out];
        double along_x[fan_out];  ///< a unit vector along the box
        double along_y[fan_out];
        double half_along[fan_out];   ///< half the extent in its direction ...
        double half_across[fan_out];  ///< ... and across

        /// Sets box i by a unit vector along it and by what it spans along and across that.
        void set(std::uint32_t i, const double* unit, double low_along, double high_along,
                 double low_across, double high_across) {
            const double along = 0.5 * (low_along + high_along);
            const double across = 0.5 * (low_across + high_across);
            x[i] = along * unit[0] - across * unit[1];
            y[i] = along * unit[1] + across * unit[0];
            along_x[i] = unit[0];
            along_y[i] = unit[1];
            half_along[i] = 0.5 * (high_along - low_along);
            half_across[i] = 0.5 * (high_across - low_across);
        }
    };

    /// Makes those of a polygon. Reuses memory.
    void make(const Polygon& polygon);

    /// Level 0, the lowest, has the boxes over edges.
    [[nodiscard]] std::uint32_t top_level() const {
        return static_cast<std::uint32_t>(first_groups_.size()) - 1;
    }
    [[nodiscard]] const Group& group(std::uint32_t level, std::uint32_t number) const {
        return groups_[first_groups_[level] + number];
    }

private:
    std::vector<Group> groups_;
    std::vector<std::uint32_t> first_groups_;  // by level
};

/// By how much a box of EdgeBoxes is enlarged at a pose, so that it holds its vertices however they
/// were rounded.
[[nodiscard]] double box_allowance(const TransformedPolygon& placed);

/// What edge boxes are asked for: the bounding box, edges, or many vertices at once.
enum class BoxSearch : std::uint8_t { extent, edges, vertices };

/// The boxes of one polygon, made when the same is asked for twice: for rings that change from one
/// question to the next they would take longer to make than they save.
class KeptEdgeBoxes {
public:
    KeptEdgeBoxes() = default;
    // A copy of a polygon makes its own.
    KeptEdgeBoxes(const KeptEdgeBoxes& /*other*/) noexcept {}
    KeptEdgeBoxes& operator=(const KeptEdgeBoxes& other) noexcept {
        if (this != &other) {
            forget();
        }
        return *this;
    }
    ~KeptEdgeBoxes() = default;

    /// Null if there are none, or if they are so large that a search gains nothing by them, as
    /// those over spikes are. Any number of threads may ask at the same time.
    [[nodiscard]] const EdgeBoxes* find(const Polygon& polygon, BoxSearch search) const;
    /// The rings have changed.
    void forget() noexcept;

private:
    enum class State : std::uint8_t { unknown, made, useless };

    mutable std::atomic<State> state_ = State::unknown;
    mutable std::array<std::atomic<bool>, 3> is_asked_ = {};  // by search
    mutable EdgeBoxes boxes_;
    mutable std::mutex making_;
};

namespace kernels {

/// Writes the boxes of runs of eight edges, each between nine vertices that follow each other:
/// those from `first` up to, but not including, `end`, into the groups of the lowest level.
void bound_runs(const Vector* vertices, std::uint32_t first, std::uint32_t end,
                EdgeBoxes::Group* groups);

/// Returns the bounding box of a polygon's transformed vertices, as find_extent() does, from those
/// that can lie farthest out by their boxes.
[[nodiscard]] Box find_box(const TransformedPolygon& placed, const EdgeBoxes& boxes);

}  // namespace kernels

}  // namespace nearfield::geometry
