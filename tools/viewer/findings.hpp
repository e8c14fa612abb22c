#pragma once

#include <nearfield/context.hpp>
#include <nearfield/tile.hpp>

#include <tools/rendering/pictures.hpp>
#include <tools/viewer/simulation.hpp>

#include <string>
#include <vector>

namespace nearfield::viewer {

/// The layers over and under the bodies.
struct Overlays {
    tools::FieldOverlay field = tools::FieldOverlay::none;
    bool contacts = true;
    bool depths = true;
    bool regions = false;
    bool tiles = false;
    bool samples = false;  ///< in the intersection of the bodies of a pair
    IntersectionStrategy strategy = IntersectionStrategy::stencil;  ///< how the samples are found

    friend bool operator==(const Overlays&, const Overlays&) = default;
};

/// The results of the queries on a scene's current state.
struct Findings {
    tools::Observations observations;
    std::vector<Region> regions;
    std::vector<TileReport> tiles;  ///< if the overlays show them
    std::vector<IntersectionSample> samples;
    double sample_cell = 0.0;
    Timings timings;      ///< of the single batch for all findings
    std::string refusal;  ///< the library's reason if it rejected a query
};

/// Runs all queries that the overlays need in one batch.
[[nodiscard]] Findings find(Simulation& simulation, const Overlays& overlays);

/// Draws everything except the panel.
void draw(tools::Drawing& drawing, Simulation& simulation, const Overlays& overlays,
          const Findings& findings, const tools::View& view);

}  // namespace nearfield::viewer
