#pragma once

#include <engine/base/interruption.hpp>
#include <engine/batch/point_block.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/narrowphase/boundary.hpp>
#include <engine/narrowphase/located_points.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <engine/solvers/nearest_feature.hpp>
#include <nearfield/result.hpp>

#include <shaders/layout.h>
#include <shaders/pairs.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::batch {

/// Writes the record of a penetrating point. Field by field into its place: a copy of what has just
/// been written would wait for it.
inline void write(const solvers::ResolvedPoint& resolved, PenetratingPoint& record) {
    const geometry::Vector way = resolved.nearest - resolved.point;
    record.position = geometry::to_public(resolved.point);
    record.depth = resolved.distance;
    record.direction = geometry::to_public(way / resolved.distance);
    record.nearest = geometry::to_public(resolved.nearest);
    record.feature = resolved.feature;
    record.unique = resolved.unique;
}

/// Points of A's boundary of a query, or of one direction of it, with what the device found out
/// about each of them.
struct QueryPoints {
    std::span<const device_input::PlannedPoint> points{};
    std::span<const std::uint32_t> words{};              ///< by point: as shaders::point_inside
    std::span<const device_input::PlannedTile> tiles{};  ///< that the points name
    /// In place of all this: those that the device has found.
    std::span<const shaders::FoundPointData> found{};

    [[nodiscard]] bool empty() const { return points.empty() && found.empty(); }
};

/// How many points penetrate B, and the deepest of them, if any; the first of several.
struct PenetrationSummary {
    std::uint32_t count = 0;
    PenetratingPoint deepest;
};

/// Makes the device's answers for the points of a query, or of one direction of it, exact.
class PointResolver {
public:
    /// Query and points must stay. `a`, `b`: its shapes in their places.
    void begin(const device_input::PlannedQuery& query, const geometry::TransformedPolygon& a,
               const geometry::TransformedPolygon& b, const QueryPoints& points);

    /// Calls `use(index, resolved point)` for the points that are wanted, in their order.
    /// `is_wanted(word)`: whether those with this word are, which is then not zero. All that are in
    /// doubt are wanted.
    template <class IsWanted, class Use>
    void for_each(const IsWanted& is_wanted, const Use& use) {
        const auto end = static_cast<std::uint32_t>(places_.size());
        SparseCheckpoint<4> checkpoint;
        for (std::uint32_t i = 0; i < end;) {
            checkpoint.step();
            block_.clear();
            for (; i < end && !block_.is_full(); ++i) {
                if (is_wanted(words_[i])) {
                    block_.add(i, (*positions_)(places_[i].point),
                               words_[i] & shaders::point_edge_mask);
                }
            }
            resolve_block();
            for (std::uint32_t k = 0; k < block_.size(); ++k) {
                const std::uint32_t index = block_.index(k);
                const bool inside = (sides_[k] & shaders::point_inside) != 0 &&
                                    block_.distance(k) > touching(index);
                const bool unique = (sides_[k] & shaders::point_unique) != 0;
                use(index, block_.resolved(k, inside, unique));
            }
        }
    }

    /// Calls `use(resolved point)` for the points of a penetration query that penetrate B, in their
    /// order.
    template <class Use>
    void for_each_penetration(double tolerance, const Use& use) {
        const double touching = tolerance * static_cast<double>(shaders::touching_depth);
        const auto may_be_inside = [](std::uint32_t word) {
            return (word & (shaders::point_inside | shaders::point_doubtful)) != 0;
        };
        for_each(may_be_inside, [&](std::uint32_t, const solvers::ResolvedPoint& resolved) {
            if (resolved.inside && resolved.distance > touching) {
                use(resolved);
            }
        });
    }

    /// Replaces a list by the records of these points. Returns the index of the deepest, the first
    /// of several; 0 if there is none. For queries of which hardly any point does not penetrate B:
    /// the list is as long as all points at first, which spares initialising what it held before.
    std::size_t list_penetrations(double tolerance, std::vector<PenetratingPoint>& records);

    /// What for_each_penetration() tells.
    [[nodiscard]] PenetrationSummary summarize_penetration(double tolerance);
    /// The same of a query about which the device has found out enough to need none of its points.
    /// Arguments as of begin().
    [[nodiscard]] PenetrationSummary summarize_penetration(const device_input::PlannedQuery& query,
                                                           const geometry::TransformedPolygon& a,
                                                           const geometry::TransformedPolygon& b,
                                                           const shaders::PairRowData& row,
                                                           double tolerance);

    /// Where a point lies on A's boundary.
    [[nodiscard]] const queries::BoundaryPoint& place(std::uint32_t index) const {
        return places_[index].point;
    }
    [[nodiscard]] const geometry::TransformedPolygon& a() const { return *a_; }
    [[nodiscard]] const geometry::TransformedPolygon& b() const { return *b_; }
    /// For queries that the device leaves open.
    [[nodiscard]] narrowphase::Boundary& boundary_of_b();

private:
    void resolve_block();
    [[nodiscard]] std::uint32_t resolve_doubtful(std::uint32_t i);
    [[nodiscard]] std::uint32_t resolve_far(std::uint32_t i);
    void locate_doubtful(std::uint32_t first);
    /// Points nearer to the boundary than this touch it.
    [[nodiscard]] double touching(std::uint32_t index) const {
        return touching_ ? *touching_ : solvers::touching_distance(tiles_[places_[index].tile]);
    }
    void take(std::span<const shaders::FoundPointData> found);

    const device_input::PlannedQuery* query_ = nullptr;
    std::span<const device_input::PlannedPoint> places_;
    std::span<const std::uint32_t> words_;
    std::span<const device_input::PlannedTile> tiles_;
    std::vector<device_input::PlannedPoint> places_of_found_;
    std::vector<std::uint32_t> words_of_found_;
    std::optional<geometry::TransformedPolygon> a_;
    std::optional<geometry::TransformedPolygon> b_;
    std::optional<queries::BoundaryPositions> positions_;  // of points of A
    simd::TransformedInstances instances_;                 // B, if it is needed
    narrowphase::Boundary boundary_;
    bool boundary_is_set_ = false;
    simd::PointList points_;  // that the device left in doubt, some of them
    narrowphase::LocatedPoints located_;
    std::uint32_t next_ = 0;  // of those
    PointBlock block_;
    std::array<std::uint32_t, PointBlock::capacity> sides_{};  // of its points, as words
    // The device named the nearest edge or a neighbour as near in single precision.
    bool has_close_neighbours_ = false;
    // Beyond this distance, single precision may have named another edge than the nearest.
    double farthest_ = 0.0;
    std::optional<double> touching_;  // of all points; otherwise by tile
};

}  // namespace nearfield::batch
