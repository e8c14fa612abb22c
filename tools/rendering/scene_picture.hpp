#pragma once

#include <tools/drawing/view.hpp>
#include <tools/rendering/drawing.hpp>
#include <tools/simulation/scene.hpp>
#include <tools/simulation/world.hpp>

#include <vector>

namespace nearfield::tools {

/// Adds the ground and the bodies of a scene as solids on it: convex outlines with a height, wheels
/// and a cabin, seen from the south and above. Ground positions are those of the flat picture, so
/// contacts and normals drawn over it fit.
void draw_solids(Drawing& drawing, const simulation::Scene& scene, const View& view);

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

/// The outlines of a shape at a pose, in pixels of the page.
[[nodiscard]] std::vector<Ring> on_page(const std::vector<Ring>& rings, const Pose& pose,
                                        const View& view);

/// Adds the bodies, as flat plates or, if they have a height, as solids seen from above at a slant.
void draw_bodies(Drawing& drawing, const simulation::Scene& scene, const View& view);

/// Adds contact points with their normals, and penetrating points with arrows along the way out.
/// The arrows are longer than the depth of the point, so that they are visible.
void draw_observations(Drawing& drawing, const Observations& observations, const View& view);

}  // namespace nearfield::tools
