#pragma once

#include <engine/exact/placed_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::exact {

/// How deep a point lies inside edges by the odd-even rule: the distance to the nearest, negative
/// outside.
[[nodiscard]] double depth_in(const PlacedEdges& edges, const geometry::Vector& point);

/// A disc that lies in a shape; one of no radius is a point of it.
struct Witness {
    geometry::Vector centre;
    double radius = 0.0;
};

/// A segment that lies in a shape.
struct Chord {
    geometry::Vector start;
    geometry::Vector end;
    geometry::Vector normal;  ///< of length 1
};

/// How far one of two chords can be moved, whichever way, while they cross each other: as far as
/// the nearest end is from the other's line. Negative where they do not cross.
[[nodiscard]] double crossing_depth(const Chord& a, const geometry::Vector& shift_of_a,
                                    const Chord& b);

/// Discs in a shape that tell how deep it is in another one: the disc's radius and the depth of its
/// centre in the other shape are together no more than how far the shape can be moved, whichever
/// way, without being apart from the other. And chords, which tell the same of thin shapes that
/// cross. Keeps its memory from shape to shape.
class Witnesses {
public:
    /// Some vertices, and discs that touch the middle of some edges and are as large as fit in; the
    /// longest of some chords.
    void choose(const PlacedEdges& edges);

    [[nodiscard]] const std::vector<Witness>& all() const { return all_; }
    [[nodiscard]] const std::vector<Chord>& chords() const { return chords_; }

private:
    void add_largest_disc(const PlacedEdges& edges, std::uint32_t edge);
    void choose_chords(const PlacedEdges& edges);

    std::vector<Witness> all_;
    std::vector<Chord> chords_;
};

}  // namespace nearfield::exact
