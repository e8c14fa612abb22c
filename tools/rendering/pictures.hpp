#pragma once

#include <tools/drawing/view.hpp>
#include <tools/rendering/drawing.hpp>
#include <tools/simulation/clearance_scenes.hpp>
#include <tools/simulation/scene.hpp>
#include <tools/simulation/world.hpp>

#include <vector>

namespace nearfield::tools {

/// The results of proximity queries on a scene at one moment.
struct Observations {
    std::vector<PenetratingPoint> penetrating;
    std::vector<ContactPoint> contacts;
};

/// Runs the queries, between two frames.
[[nodiscard]] Observations observe(simulation::World& world);

/// The part of the bodies' distance fields that is shown.
enum class FieldOverlay {
    none,
    distance,  ///< signed distance to the nearest body, positive outside all
    features,  ///< the nearest feature of the nearest body: the Voronoi diagram
    gradient,  ///< the direction away from there, as a hue
};

/// A field layer over the view, as colours. Precondition: the layer is not `none`.
[[nodiscard]] ColoredCells field_overlay(Context& context, simulation::World& world,
                                         const View& view, FieldOverlay layer);

/// Adds the bodies, as flat plates or, if they have a height, as solids seen from above at a slant.
void draw_bodies(Drawing& drawing, const simulation::Scene& scene, const View& view);

/// Adds contact points with their normals, and penetrating points with arrows along the way out.
/// The arrows are longer than the depth of the point, so that they are visible.
void draw_observations(Drawing& drawing, const Observations& observations, const View& view);

/// Adds a scene of clearances: its obstacles, the paths and the shape that moves, coloured by their
/// least clearances, the two nearest points, and below them the scale of the colours.
void draw_clearances(Drawing& drawing, const simulation::ClearanceScene& scene, const View& view);

}  // namespace nearfield::tools
