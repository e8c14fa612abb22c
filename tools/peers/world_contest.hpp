#pragma once

#include <nearfield/world.hpp>

#include <tools/benchmark/measuring.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

/// \file Questions that name a world, for nearfield and for libraries that keep an index too.

namespace nearfield::peers {

/// A shape and where it is.
struct WorldShape {
    std::vector<Ring> rings;
    Pose pose;
};

/// What a row asks about. Only one kind is given.
struct WorldInputs {
    std::vector<Pose> poses;  ///< of an item
    std::vector<Vector2> points;
    std::vector<Segment> segments;
};

/// What a row asks, and of which world.
struct WorldProblem : WorldInputs {
    std::string name;
    std::vector<WorldShape> shapes;
    std::vector<Ring> item;       ///< the shape at the poses
    bool asks_distances = false;  ///< of the poses: the least distances, not only whether it is 0
};

/// Another library with an index of its own over the world, built once.
class WorldPeer {
public:
    WorldPeer() = default;
    virtual ~WorldPeer() = default;
    WorldPeer(const WorldPeer&) = delete;
    WorldPeer& operator=(const WorldPeer&) = delete;

    [[nodiscard]] virtual std::string name() const = 0;
    /// The functions that answer a problem; empty if it cannot.
    [[nodiscard]] virtual std::string how(const WorldProblem& problem) const = 0;
    /// How far the library's rounding displaces coordinates, if it computes in float; else 0. Its
    /// answers are compared with nearfield's answers to inputs displaced that far.
    [[nodiscard]] virtual double rounding() const { return 0.0; }
    /// Builds the index.
    virtual void build(const WorldProblem& problem) = 0;
    /// One number per pose (distance, or 0 and 1 for apart and intersecting), point (distance from
    /// the nearest shape) or segment (parameter of the first hit, 2 if there is none).
    virtual void answer(const WorldProblem& problem, std::vector<double>& answers) = 0;
};

[[nodiscard]] std::unique_ptr<WorldPeer> make_geos_world();
[[nodiscard]] std::unique_ptr<WorldPeer> make_cgal_world();
[[nodiscard]] std::unique_ptr<WorldPeer> make_box2d_world();

/// A point of a shape at a pose, in world coordinates.
[[nodiscard]] Vector2 at_pose(const Vector2& point, const Pose& pose);

/// The problems of all rows.
[[nodiscard]] std::vector<WorldProblem> world_problems();

/// How long a peer takes.
struct WorldPeerTimes {
    std::string name;
    std::string how;
    std::size_t apart = 0;  ///< answers that differ by more than its rounding
    benchmark::Spread ms = {};
};
/// A measured row.
struct WorldTimes {
    std::string name;
    benchmark::Spread nearfield_ms = {};
    std::vector<WorldPeerTimes> peers = {};
};

/// Measures nearfield and all peers that answer a problem. Throws std::runtime_error if their
/// answers differ by more than rounding explains.
[[nodiscard]] WorldTimes race(const WorldProblem& problem);

}  // namespace nearfield::peers
