#pragma once

#include "placed_rings.hpp"

#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>
#include <tests/support/random_cases.hpp>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// \file Worlds of which the test knows what is in them.

namespace nearfield::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// What is to be in a world, in the order of adding.
struct Placement {
    std::string name;
    Rings rings;
    Pose pose;
    std::uint32_t category = 1;
    std::uint32_t mask = UINT32_MAX;
};

/// Kinds of scenes, each hard in its own way.
enum class SceneKind {
    ordinary,      ///< any shapes, scattered
    every_family,  ///< each family once, ordinary and degenerate, overlapping a little
    far_away,      ///< ordinary, at 10^6
    far_origin,    ///< the rings far from the origin of their own coordinates, the poses back
    tiny_and_big,  ///< sizes from 10^-6 to 10^3
    grid,          ///< squares of whole numbers that share edges and corners, some twice
    holes,         ///< many holes and islands, and shapes inside them
    extreme,       ///< as large and as small as shapes can be
};
inline constexpr int scene_kinds = 8;

[[nodiscard]] const char* to_string(SceneKind kind);
[[nodiscard]] std::vector<Placement> make_scene(SceneKind kind, std::uint64_t seed);
/// The box around all of them.
[[nodiscard]] Rectangle box_of(const std::vector<Placement>& placements);
/// Unit squares with their low corners at these places.
[[nodiscard]] std::vector<Placement> unit_squares(std::initializer_list<Vector2> corners);
/// What tolerances are relative to that double precision resolves at the coordinates of a scene.
[[nodiscard]] double size_of(SceneKind kind, const Rectangle& box);
/// The same everywhere, moved by a pose.
[[nodiscard]] Pose moved_by(const Pose& motion, const Pose& pose);
[[nodiscard]] Vector2 moved_by(const Pose& motion, const Vector2& point);

/// Another context and world, and all placements in it.
class Scene {
public:
    explicit Scene(std::vector<Placement> placements, const Settings& settings = {});

    Context& context() { return *context_; }
    World& world() { return *world_; }
    [[nodiscard]] const std::vector<Placement>& placements() const { return placements_; }
    [[nodiscard]] std::size_t size() const { return placements_.size(); }
    [[nodiscard]] Rectangle box() const { return box_of(placements_); }
    [[nodiscard]] InstanceHandle handle(std::size_t i) const { return handles_[i]; }
    [[nodiscard]] ShapeHandle shape(std::size_t i) const { return shapes_[i]; }
    [[nodiscard]] Instance instance(std::size_t i) const { return {shapes_[i], poses_[i]}; }
    [[nodiscard]] const PlacedRings& truth(std::size_t i) const { return truths_[i]; }
    /// The position of an instance in the order of adding; nothing if there is none of this handle.
    [[nodiscard]] std::optional<std::size_t> position(InstanceHandle handle) const;
    /// True if a filter lets instance i pass, as the interface states it.
    [[nodiscard]] bool passes(std::size_t i, const WorldFilter& filter) const;
    /// A shape that is in the context and not in the world.
    ShapeHandle add_shape(const Rings& rings);

private:
    std::vector<Placement> placements_;
    std::vector<Pose> poses_;
    std::optional<Context> context_;
    std::optional<World> world_;
    std::vector<ShapeHandle> shapes_;
    std::vector<InstanceHandle> handles_;
    std::vector<PlacedRings> truths_;
};

/// Laws of what is asked about a kind of scene.
class ScenesTest : public testing::TestWithParam<SceneKind> {
protected:
    /// Calls `check(scene, random)` for scenes of the kind, which are random by `seed`, until one
    /// fails.
    template <class Check>
    static void for_each_scene(int usual, std::uint64_t seed, const Check& check) {
        const int first = first_case();
        for (int number = first; number < first + random_cases(usual); ++number) {
            const std::uint64_t own = 1000U * static_cast<std::uint64_t>(number) + seed;
            SCOPED_TRACE(std::string(to_string(GetParam())) + ", seed " + std::to_string(own));
            Scene scene(make_scene(GetParam(), own));
            Random random(own + 1);
            check(scene, random);
            if (HasFailure()) {
                return;
            }
        }
    }
};
[[nodiscard]] std::vector<SceneKind> all_scene_kinds();

/// A shape to ask with.
struct Asked {
    ShapeHandle shape;
    Rings rings;
};
/// Any, or one that is in the world already.
[[nodiscard]] Asked any_asked(Random& random, Scene& scene);
/// A random filter: mostly one that lets everything pass.
[[nodiscard]] WorldFilter any_filter(Random& random, const Scene& scene);
/// A point in the neighbourhood of a scene: anywhere, on a vertex, on an edge, far away.
[[nodiscard]] Vector2 any_point(Random& random, const Scene& scene, const Rectangle& box);
/// A segment in the neighbourhood of a scene, of any kind: through vertices, along edges, without
/// length, from inside, and from very far away.
[[nodiscard]] Segment any_segment(Random& random, const Scene& scene, const Rectangle& box);

}  // namespace nearfield::test
