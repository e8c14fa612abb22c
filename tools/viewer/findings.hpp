#pragma once

#include <nearfield/context.hpp>

#include <tools/render/scene_picture.hpp>
#include <tools/viewer/simulation.hpp>

#include <string>
#include <vector>

namespace nearfield::viewer {

/// What is drawn over, and under, the bodies.
struct Overlays {
    tools::FieldLayer field = tools::FieldLayer::none;
    bool contacts = true;
    bool depths = true;
    bool regions = false;
    bool tiles = false;
    bool samples = false;  ///< of what both bodies of a pair cover
    IntersectionStrategy strategy = IntersectionStrategy::stencil;  ///< how these are found

    friend bool operator==(const Overlays&, const Overlays&) = default;
};

/// What the library says about a scene as it stands.
struct Findings {
    tools::Observations observations;
    std::vector<Region> regions;
    std::vector<TileReport> tiles;  ///< where the overlays show them
    std::vector<IntersectionSample> samples;
    double sample_cell = 0.0;
    Timings timings;      ///< of the one batch that all of it is
    std::string refusal;  ///< the library's reason, where it refused some of it
};

/// Asks all that the overlays show in one batch.
[[nodiscard]] Findings find(Simulation& simulation, const Overlays& overlays);

/// Everything but the panel.
void draw(tools::Drawing& drawing, Simulation& simulation, const Overlays& overlays,
          const Findings& findings, const tools::View& view);

}  // namespace nearfield::viewer
