#include <nearfield/diagnostics.hpp>

#include <tools/common/library.hpp>
#include <tools/drawing/canvas.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/viewer/findings.hpp>

#include <type_traits>
#include <variant>

namespace nearfield::viewer {
namespace {

using simulation::operator+;
using simulation::operator-;

constexpr tools::Color region_color = tools::rgb(0x0B5CAD);
constexpr tools::Color tile_color = tools::palette::tile;
constexpr tools::Color sample_color = tools::rgb(0x7B3FA0);
constexpr tools::Color drag_color = tools::rgb(0xD9480F);

/// Adds the queries of the overlays to those for the pairs' penetrations, which are in the batch
/// already.
void add_queries(Batch& batch, Simulation& simulation, const Overlays& overlays) {
    simulation::Proximity& proximity = simulation.world().proximity();
    const double tolerance = simulation.scene().tolerance;
    const Technique technique = simulation.choices().technique;
    if (overlays.samples) {
        IntersectionQuery query;
        query.tolerance = tolerance;
        query.strategy = overlays.strategy;
        query.technique = technique;
        for (const InstancePair& pair : proximity.near_pairs(0.0)) {
            query.a = proximity.instances()[pair.first];
            query.b = proximity.instances()[pair.second];
            batch.add(query);
        }
    }
    if (overlays.contacts) {
        ContactQuery query;
        query.tolerance = tolerance;
        query.contact_distance = 2.0 * tolerance;
        query.technique = technique;
        for (const InstancePair& pair : proximity.near_pairs(query.contact_distance)) {
            query.a = proximity.instances()[pair.first];
            query.b = proximity.instances()[pair.second];
            batch.add(query);
        }
    }
}

template <class Record>
void append(std::vector<Record>& to, const std::vector<Record>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Draws the outline of a region or a tile.
template <class Box>
void draw_rectangle(tools::Drawing& drawing, const tools::View& view, const Box& box,
                    const tools::Color& color) {
    const Vector2 low = view.to_page(box.min);
    const Vector2 high = view.to_page(box.max);
    drawing.line({low, {high.x, low.y}, high, {low.x, high.y}}, color, 1.2, true);
}

void draw_tile(tools::Drawing& drawing, const tools::View& view, const TileReport& tile) {
    const Vector2 low = view.to_page(tile.min);
    const Vector2 high = view.to_page(tile.max);
    drawing.fill({{low, {high.x, low.y}, high, {low.x, high.y}}}, tile_color.with_alpha(0.15));
    draw_rectangle(drawing, view, tile, tile_color);
}

/// Draws the grid of a region if its cells are large enough to distinguish.
void draw_grid(tools::Drawing& drawing, const tools::View& view, const Region& region) {
    constexpr double min_pixels = 4.0;
    const Vector2 low = view.to_page(region.min);
    const Vector2 high = view.to_page(region.max);
    const double w = (high.x - low.x) / region.width;
    const double h = (high.y - low.y) / region.height;
    if (w < min_pixels) {
        return;
    }
    const tools::Color color = region_color.with_alpha(0.3);
    for (std::uint32_t column = 1; column < region.width; ++column) {
        drawing.line({{low.x + w * column, low.y}, {low.x + w * column, high.y}}, color, 0.6);
    }
    for (std::uint32_t row = 1; row < region.height; ++row) {
        drawing.line({{low.x, low.y + h * row}, {high.x, low.y + h * row}}, color, 0.6);
    }
}

void draw_sample(tools::Drawing& drawing, const tools::View& view, Vector2 center, double cell) {
    const Vector2 half{0.5 * cell, 0.5 * cell};
    const Vector2 low = view.to_page(center - half);
    const Vector2 high = view.to_page(center + half);
    drawing.fill({{low, {high.x, low.y}, high, {low.x, high.y}}}, sample_color.with_alpha(0.6));
}

}  // namespace

Findings find(Simulation& simulation, const Overlays& overlays) {
    Batch batch;
    simulation.world().proximity().fill_with_overlaps(batch);
    add_queries(batch, simulation, overlays);
    Results results;
    tools::require(simulation.context().run(batch, results));
    Findings findings;
    findings.timings = results.timings;
    if (overlays.tiles) {
        findings.tiles = tools::take(list_tiles(simulation.context()));
    }
    for (const AnyResult& any : results.results) {
        std::visit(
            [&findings](const auto& result) {
                using Result = std::decay_t<decltype(result)>;
                if (!result.status.ok()) {
                    findings.refusal = result.status.text();
                    return;
                }
                append(findings.regions, result.regions);
                if constexpr (std::is_same_v<Result, PenetrationResult>) {
                    append(findings.observations.penetrating, result.points);
                } else if constexpr (std::is_same_v<Result, ContactResult>) {
                    append(findings.observations.contacts, result.points);
                } else if constexpr (std::is_same_v<Result, IntersectionResult>) {
                    append(findings.samples, result.samples);
                    findings.sample_cell = result.cell;
                }
            },
            any);
    }
    return findings;
}

void draw(tools::Drawing& drawing, Simulation& simulation, const Overlays& overlays,
          const Findings& findings, const tools::View& view) {
    if (overlays.field != tools::FieldOverlay::none) {
        drawing.cells(
            tools::field_overlay(simulation.context(), simulation.world(), view, overlays.field));
    }
    tools::draw_bodies(drawing, simulation.scene(), view);
    for (const IntersectionSample& sample : findings.samples) {
        draw_sample(drawing, view, sample.position, findings.sample_cell);
    }
    if (overlays.regions) {
        for (const Region& region : findings.regions) {
            draw_grid(drawing, view, region);
            draw_rectangle(drawing, view, region, region_color);
        }
    }
    for (const TileReport& tile : findings.tiles) {
        draw_tile(drawing, view, tile);
    }
    tools::Observations shown;
    if (overlays.contacts) {
        shown.contacts = findings.observations.contacts;
    }
    if (overlays.depths) {
        shown.penetrating = findings.observations.penetrating;
    }
    tools::draw_observations(drawing, shown, view);
    if (const std::optional<Drag::Line> line = simulation.drag().line(simulation.scene())) {
        const Vector2 from = view.to_page(line->from);
        drawing.line({from, view.to_page(line->to)}, drag_color, 2.0);
        drawing.dot(from, 4.0, drag_color);
    }
}

}  // namespace nearfield::viewer
