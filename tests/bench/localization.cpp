// The effect of the hierarchies' height and bounding volumes on a whole penetration query: two
// outlines whose boxes overlap by part of their width, at rest or deformed by a wave of their
// vertices in every frame.

#include <nearfield/nearfield.hpp>

#include <tests/bench/bench.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace nearfield::bench {
namespace {

struct Extent {
    double low = INFINITY;
    double high = -INFINITY;
};

Extent width_of(const std::vector<Ring>& rings) {
    Extent extent;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            extent.low = std::min(extent.low, vertex.x);
            extent.high = std::max(extent.high, vertex.x);
        }
    }
    return extent;
}

std::vector<Ring> waved(std::vector<Ring> rings, double amplitude, int frame) {
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex.y += amplitude * std::sin(vertex.x / (6.0 * amplitude) + 0.3 * frame);
        }
    }
    return rings;
}

/// `overlap`: fraction of the boxes' widths.
void measure(State& state, const Settings& settings, double overlap, bool deforming) {
    const std::filesystem::path data(NEARFIELD_TEST_DATA);
    const std::vector<Ring> rings_a = test::read_outline(data / "iceland_10m.geojson").rings;
    const std::vector<Ring> rings_b = test::read_outline(data / "ireland_10m.geojson").rings;
    const Extent a = width_of(rings_a);
    const Extent b = width_of(rings_b);
    const double shared = overlap * std::min(a.high - a.low, b.high - b.low);
    Context context = take(Context::create_headless({}, settings));
    PenetrationQuery query;
    query.technique = Technique::raster;
    query.a = {take(context.add_shape(rings_a)), {}};
    query.b = {take(context.add_shape(rings_b)), {{a.high - shared - b.low, 0.0}, 0.0}};
    query.tolerance = (a.high - a.low) / 500.0;
    Results results;
    Batch batch;
    int frame = 0;
    run(state, [&]() -> Numbers {
        if (deforming) {
            const double amplitude = 5.0 * query.tolerance;
            require(context.update_shape(query.a.shape, waved(rings_a, amplitude, frame)));
            require(context.update_shape(query.b.shape, waved(rings_b, amplitude, frame)));
        }
        ++frame;
        batch.clear();
        const auto handle = batch.add(query);
        require(context.run(batch, results));
        require(results[handle].status);
        const LocalizationStatistics& statistics = results[handle].localization;
        return {{"localize ms", results.timings.localize},
                {"rest ms", results.timings.total - results.timings.localize},
                {"nodes", static_cast<double>(statistics.nodes_evaluated)},
                {"pairs rejected", static_cast<double>(statistics.pairs_rejected)},
                {"edges kept", static_cast<double>(statistics.edges_kept)}};
    });
}

const bool localizations_are_added = [] {
    for (const std::uint32_t height : {0U, 2U, 4U, 6U, 8U, 10U, 12U, 16U}) {
        for (const int percent : {1, 10, 50}) {
            for (const bool deforming : {false, true}) {
                for (const bool oriented : {false, true}) {
                    Settings settings;
                    settings.bounding_volume =
                        oriented ? BoundingVolume::oriented : BoundingVolume::axis_aligned;
                    settings.hierarchy_height = height;
                    add("localize/" + std::to_string(percent) + " % " +
                            (deforming ? "deforming" : "rigid") + ", height " +
                            std::to_string(height) + (oriented ? "/oriented" : "/axis-aligned"),
                        60,
                        [=](State& state) { measure(state, settings, 0.01 * percent, deforming); });
                }
            }
        }
    }
    return true;
}();

}  // namespace
}  // namespace nearfield::bench
