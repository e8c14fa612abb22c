#pragma once

#include <engine/geometry/placed_polygon.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::exact {

/// A polygon at a pose with all its edges placed in the world, a contiguous array for each
/// coordinate, so that several are worked on at once. For polygons of few edges (see
/// most_edges_one_by_one) that is faster than any tree. Every array goes on, up to whole lanes
/// (lanes.hpp), with edges of no length at the last edge's end.
struct PlacedEdges {
    geometry::PlacedPolygon placed;
    geometry::Box box;
    double rounding = 0.0;  ///< of the vertices: localize::placement_rounding
    std::uint32_t count = 0;
    const double* start_x = nullptr;  ///< by edge; also vertex i
    const double* start_y = nullptr;
    const double* end_x = nullptr;
    const double* end_y = nullptr;
    const double* low_x = nullptr;  ///< by edge: its box
    const double* low_y = nullptr;
    const double* high_x = nullptr;
    const double* high_y = nullptr;
    const double* inverse_length = nullptr;  ///< by edge: 1 / squared length, 0 for no length

    [[nodiscard]] geometry::Vector start(std::uint32_t edge) const {
        return {start_x[edge], start_y[edge]};
    }
    [[nodiscard]] geometry::Vector end(std::uint32_t edge) const {
        return {end_x[edge], end_y[edge]};
    }
};

/// So many edges are looked at one by one for a single point.
inline constexpr std::uint32_t most_edges_one_by_one = 64;

/// Some of the edges, or vertices, of a polygon, by index and in order.
class Selection {
public:
    void add(std::uint32_t index, bool selected) {
        indices_[count_] = index;
        count_ += selected ? 1U : 0U;
    }
    /// Drops what fills up the last lanes.
    void cut_off(std::uint32_t end) {
        while (count_ > 0 && indices_[count_ - 1] >= end) {
            --count_;
        }
    }
    [[nodiscard]] std::span<const std::uint32_t> indices() const {
        return {indices_.data(), count_};
    }

private:
    // One more: the next is written before it is known whether it counts.
    std::array<std::uint32_t, most_edges_one_by_one + 1> indices_;
    std::uint32_t count_ = 0;
};

/// Of the vertices first, first + 1, ..., at most most_edges_one_by_one of them, those in a box.
/// `first` is a multiple of that number.
[[nodiscard]] Selection vertices_in(const PlacedEdges& edges, std::uint32_t first,
                                    const geometry::Box& box);

/// By the odd-even rule, as Boundary::contains.
[[nodiscard]] bool contains(const PlacedEdges& edges, const geometry::Vector& point);

/// Writes the squared distance of a point to every edge, up to rounding, and returns the edge with
/// the least. `squared` has room for whole lanes.
std::uint32_t find_nearest(const PlacedEdges& edges, const geometry::Vector& point,
                           std::span<double> squared);

/// True where the two closed shapes share a point, as localize::intersects, but for shapes of which
/// no vertex of A lies in B.
[[nodiscard]] bool meet_without_vertex_inside(const PlacedEdges& a, const PlacedEdges& b);

/// The instances of a batch, each placed once, however many pairs it is in. Keeps its memory.
class PlacedInstances {
public:
    void clear();
    /// The index of an instance, which is placed where it is new.
    [[nodiscard]] std::uint32_t place(const geometry::Polygon& polygon, const Pose& pose);
    /// Valid until the next place().
    [[nodiscard]] PlacedEdges operator[](std::uint32_t index) const;

private:
    struct Entry {
        Pose pose;
        geometry::PlacedPolygon placed;
        geometry::Box box;
        double rounding;
        std::size_t first;  // of its arrays, which follow one another
    };

    [[nodiscard]] std::size_t slot_of(const geometry::Polygon& polygon, const Pose& pose) const;
    void add(const geometry::Polygon& polygon, const Pose& pose);
    void rehash();

    std::vector<Entry> entries_;
    std::vector<double> coordinates_;
    std::vector<std::uint32_t> slots_;  // a hash table of entries, a power of two
};

}  // namespace nearfield::exact
