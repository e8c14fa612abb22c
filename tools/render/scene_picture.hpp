#pragma once

#include <tools/dynamics/world.hpp>
#include <tools/picture/view.hpp>
#include <tools/render/drawing.hpp>

#include <vector>

namespace nearfield::tools {

/// What proximity queries say about a scene at one moment.
struct Observations {
    std::vector<PenetrationRecord> penetrating;
    std::vector<ContactRecord> contacts;
};

/// Asks anew, between two frames.
[[nodiscard]] Observations observe(dynamics::World& world);

/// The signed distance to the nearest body over the view, as colours: positive outside all.
[[nodiscard]] ColoredCells field_overlay(Context& context, dynamics::World& world,
                                         const View& view);

/// Adds the bodies, as plates or, where they have a height, as solids seen from above at a slant.
void draw_bodies(Drawing& drawing, const dynamics::Scene& scene, const View& view);

/// Adds contact points with their normals, and penetrating points with arrows along the way out.
/// These are as long as the point is deep, and then some, so that they can be seen.
void draw_observations(Drawing& drawing, const Observations& observations, const View& view);

}  // namespace nearfield::tools
