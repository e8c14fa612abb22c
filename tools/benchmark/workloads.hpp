#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/input_error.hpp>
#include <tools/io/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::benchmark {

/// A seeded random number generator that is identical with every standard library, so that a row of
/// the table is the same work everywhere.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [low, high).
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
    }

private:
    std::mt19937_64 engine_;
};

// Outlines for the scenes of the table. None touches or crosses itself. Unless noted, each
// is centred on the origin with a radius of about 1.

/// A coast of n >= 8 vertices, determined by the seed. Coasts with the same seed share their large
/// bays; more vertices add smaller ones.
[[nodiscard]] Ring coast(std::uint64_t seed, std::size_t n);

/// A gear with 4 vertices per tooth.
[[nodiscard]] Ring gear(std::size_t teeth);

/// The distance in x at which the hooks of two links just hold each other.
inline constexpr double link_pitch = 3.62;

/// An S of n vertices, 4.2 long and 2.4 high: two hooks, one open at the top and one open at the
/// bottom.
[[nodiscard]] Ring link(std::size_t n);

/// A convex car body seen from above: n vertices, 2 x 1.
[[nodiscard]] Ring car(std::size_t n);

/// A bar from x = 0 to 4 with n vertices. One side follows the wave that both bars of the scene
/// share, moved up by `shift`; the other is straight, its two corners at y = `back`.
[[nodiscard]] Ring wavy_bar(std::size_t n, double back, double shift);

/// A star of n vertices with radii between 0.6 and 1.
[[nodiscard]] Ring star(Random& random, std::size_t n);

/// Replaces every edge by `factor` edges that deviate from it by at most a twentieth of its length,
/// and by at most six degrees seen from its ends.
[[nodiscard]] Ring refined(Random& random, const Ring& ring, std::size_t factor);

/// The position of an object in rows of `columns`, with this spacing.
[[nodiscard]] inline Vector2 in_rows(std::size_t index, std::size_t columns, Vector2 spacing) {
    const std::size_t row = index / columns;
    return {spacing.x * static_cast<double>(index % columns), spacing.y * static_cast<double>(row)};
}

/// Adds an object with its own shape to a scene.
inline void add_object(tools::Scene& scene, std::vector<Ring> rings, const Pose& pose) {
    const std::size_t number = scene.shapes.size();
    scene.shapes.push_back({"s" + std::to_string(number), std::move(rings), 0.0});
    scene.instances.push_back({"o" + std::to_string(number), number, pose});
}

/// The number of vertices of all shapes, which equals their number of edges.
[[nodiscard]] inline std::size_t vertex_count(const tools::Scene& scene) {
    std::size_t count = 0;
    for (const tools::SceneShape& shape : scene.shapes) {
        for (const Ring& ring : shape.rings) {
            count += ring.size();
        }
    }
    return count;
}

// Scenes of many small objects: shapes and poses, no queries.

/// Stars of 50 vertices side by side; the boxes of about 2.4 times as many pairs overlap.
[[nodiscard]] tools::Scene crowd_scene(std::size_t objects = 1000);

/// Overlapping pairs of 50-vertex stars, objects 2 i and 2 i + 1; no pair is near another.
[[nodiscard]] tools::Scene small_pairs_scene(std::size_t pairs);

/// Real outlines in kilometres, compiled into the program: 3,056 and 2,250 vertices.
[[nodiscard]] std::vector<Ring> iceland();
[[nodiscard]] std::vector<Ring> ireland();

/// How far `b`, which lies to the right of `a`, can move in the direction -x before it touches `a`;
/// infinite if it passes above or below.
[[nodiscard]] double gap_along_x(const std::vector<Ring>& a, const std::vector<Ring>& b);

/// Iceland and, to the right of it, Ireland. `overlap`: how far they are pushed into each other
/// from first touch, as a fraction of Iceland's width; if negative, the gap between them.
[[nodiscard]] tools::Scene coast_lines_scene(double overlap);

// Scenes like the five in Table 2 of the paper, with the same numbers of objects and lines:
// shapes and poses, no queries. `scale` multiplies the number of vertices and keeps the outlines
// about the same.

/// 6 large non-convex objects close together, 719 lines.
[[nodiscard]] tools::Scene map_scene(std::size_t scale);
/// 13 meshing gears, one on a shaft with three sides, 391 lines.
[[nodiscard]] tools::Scene gears_scene(std::size_t scale);
/// 15 non-convex links that hold each other by their hooks, 440 lines: three chains side by side.
[[nodiscard]] tools::Scene links_scene(std::size_t scale);
/// 18 convex cars, 266 lines, some bumper to bumper.
[[nodiscard]] tools::Scene cars_scene(std::size_t scale);
/// 2 bars pressed into each other along a wave, 200 lines.
[[nodiscard]] tools::Scene wavy_scene(std::size_t scale);

// The queries that the rows of the table run on the scenes, at tolerance d.

/// The pairs that are queried.
enum class Pairs {
    all,        ///< every pair whose boxes overlap (or are within reach), found anew each frame
    neighbors,  ///< each pair of objects 2 i and 2 i + 1 once
};

/// The minimum a host needs: which vertices are inside and the greatest depth; no records.
[[nodiscard]] tools::QueryRequest vertex_penetration(double tolerance);
/// Samples along the boundary, at most a cell apart, with depth and direction each.
[[nodiscard]] tools::QueryRequest boundary_penetration(double tolerance);
/// Contact points within 2 d.
[[nodiscard]] tools::QueryRequest contacts(double tolerance);
[[nodiscard]] tools::QueryRequest separation(double tolerance);
/// Whether shapes share a point; exact at any tolerance.
[[nodiscard]] tools::QueryRequest intersection_test(double tolerance);
/// Volume against volume: the number of samples and the area; no list of samples.
[[nodiscard]] tools::QueryRequest intersection(double tolerance);
/// Distances at `cells` x `cells` cell centres of a square centred on `middle`.
[[nodiscard]] tools::QueryRequest square_field(Vector2 middle, double side, std::size_t cells);

/// The scene with this query added for these pairs of its objects.
[[nodiscard]] tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request,
                                 Pairs pairs);

/// The scene with this query added for two of its objects.
[[nodiscard]] tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request,
                                 std::size_t a, std::size_t b);

/// A row of the standard table: work done once per frame.
struct Row {
    std::string name;                     ///< "gears x10, contacts"
    std::function<tools::Scene()> scene;  ///< called when the row is measured
};

/// All rows in table order. Names are unique.
[[nodiscard]] std::vector<Row> standard_table();

/// The rows of a table whose names hold a text. Throws InputError, with all names, if there is
/// none.
template <class AnyRow>
[[nodiscard]] std::vector<AnyRow> rows_with(const std::string& filter, std::vector<AnyRow> rows) {
    std::string names;
    for (const AnyRow& row : rows) {
        names += "\n  " + row.name;
    }
    std::erase_if(rows,
                  [&](const AnyRow& row) { return row.name.find(filter) == std::string::npos; });
    if (rows.empty()) {
        throw tools::InputError("--filter: no row of the table has \"" + filter +
                                "\" in its name; there are:" + names);
    }
    return rows;
}

}  // namespace nearfield::benchmark
