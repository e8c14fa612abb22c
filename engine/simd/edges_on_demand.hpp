#pragma once

#include <engine/geometry/edge_boxes.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace nearfield::simd {

/// The edges of a polygon at a pose, and the boxes over them, in arrays that a search fills where
/// it looks at them: eight edges, or eight boxes, at a time. The boxes are those of the polygon,
/// turned, and so somewhat larger than boxes over the edges as they lie. Any number of threads may
/// search.
class EdgesOnDemand {
public:
    /// The arrays of edges, each `edge_stride` after the one before, and those of boxes, as in an
    /// AabbTree without pieces.
    struct Arrays {
        double* edges = nullptr;  ///< start x, start y, end x, end y
        std::size_t edge_stride = 0;
        double* boxes = nullptr;  ///< from the lowest level on: low x, low y, high x, high y
    };

    /// Forgets what was placed. The polygon and its boxes must outlive this, or the next begin().
    void begin(const geometry::TransformedPolygon& placed, const geometry::EdgeBoxes& boxes,
               const Arrays& arrays);

    /// Places the edges of a lowest box.
    void place_edges(std::uint32_t lowest) const {
        if (states_[lowest].load(std::memory_order_acquire) != placed_state_) {
            place_run(lowest);
        }
    }
    /// Places the eight boxes of a group.
    void place_boxes(std::uint32_t level, std::uint32_t group) const {
        if (states_[levels_[level].states + group].load(std::memory_order_acquire) !=
            placed_state_) {
            place_group(level, group);
        }
    }
    /// Places all edges.
    void place_all() const;

    /// The corners of a box, oriented as that of the polygon.
    [[nodiscard]] std::array<geometry::Vector, 4> corners(std::uint32_t level,
                                                          std::uint32_t box) const;
    /// The boxes of the polygon, with which placement and allowance they were placed.
    [[nodiscard]] const geometry::EdgeBoxes::Group& group(std::uint32_t level,
                                                          std::uint32_t number) const {
        return boxes_->group(level, number);
    }
    [[nodiscard]] geometry::Placement placement() const { return polygon_->placement(); }
    [[nodiscard]] double allowance() const { return allowance_; }

    /// The first edge, placed, of the ring that the first edge of a lowest box belongs to.
    [[nodiscard]] std::uint32_t ring_begin(std::uint32_t lowest) const;

    [[nodiscard]] std::size_t bytes() const { return room_ * sizeof(states_[0]); }

private:
    struct Level {
        std::size_t states = 0;  // of its groups
        double* low_x = nullptr;
        std::size_t stride = 0;  // from low x to low y, and so on
    };

    void place_run(std::uint32_t lowest) const;
    void write_run(std::uint32_t lowest) const;
    void place_group(std::uint32_t level, std::uint32_t group) const;
    /// Calls `place` unless another thread does, or did; returns once it is placed.
    template <class Place>
    void place_once(std::size_t state, const Place& place) const;

    std::optional<geometry::TransformedPolygon> polygon_;
    const geometry::EdgeBoxes* boxes_ = nullptr;
    Arrays arrays_;
    std::array<Level, 10> levels_;
    double allowance_ = 0.0;
    // By lowest box, then by group of each level.
    std::unique_ptr<std::atomic<std::uint32_t>[]> states_;
    std::size_t room_ = 0;
    std::uint32_t placed_state_ = 0;  // one less: being placed; others: of an earlier pose
};

namespace kernels {

/// Writes eight boxes as they lie, each enlarged by an allowance.
void place_boxes(const geometry::EdgeBoxes::Group& group, const geometry::Placement& placement,
                 double allowance, double* low_x, std::size_t stride);

/// Writes the eight edges between nine vertices, as geometry::kernels::place_points() does.
void place_edges(const geometry::Vector* vertices, const geometry::Placement& placement,
                 double* start_x, std::size_t stride);

}  // namespace kernels

}  // namespace nearfield::simd
