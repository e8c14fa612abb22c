#include "font.hpp"

#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/oracle/filled_region.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/shape_rings.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

using oracle::Edge;
using oracle::FilledRegion;

/// A glyph's rings as its font has them.
struct Glyph {
    tools::Outline outline;
    std::vector<Ring> contours;  ///< off the curves by `deviation`
    double deviation = 0.0;
};

Glyph glyph_of(const Font& font, unsigned long character) {
    Glyph glyph{tools::parse_outline({"glyph.path", font.path({character})}), {}, 0.0};
    glyph.deviation = font.em() / 4000.0;
    glyph.contours = tools::tessellate_outline(glyph.outline, glyph.deviation).rings;
    return glyph;
}

Rectangle box_of(const std::vector<Ring>& rings) {
    Rectangle box{rings.front().front(), rings.front().front()};
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            box.min = {std::min(box.min.x, vertex.x), std::min(box.min.y, vertex.y)};
            box.max = {std::max(box.max.x, vertex.x), std::max(box.max.y, vertex.y)};
        }
    }
    return box;
}

/// The signed field of rings over a glyph, and at points.
DistanceFieldResult field_of(Context& context, const std::vector<Ring>& rings, double deviation,
                             const Rectangle& box, const std::vector<Vector2>& points) {
    const Expected<ShapeHandle> shape = context.add_shape(rings, deviation);
    EXPECT_TRUE(shape.has_value()) << shape.error().text();
    DistanceFieldQuery query;
    query.b = {*shape, {}};
    query.rectangle = box;
    query.tolerance = std::max(box.max.x - box.min.x, box.max.y - box.min.y) / 60.0;
    query.points = points;
    query.technique = Technique::cpu;
    Batch batch;
    const auto handle = batch.add(query);
    Results results;
    EXPECT_TRUE(context.run(batch, results).ok());
    EXPECT_TRUE(context.remove_shape(*shape).ok());
    EXPECT_TRUE(results[handle].status.ok()) << results[handle].status.text();
    return results[handle];
}

/// The largest amount by which a field is off beyond its bound.
double excess(const DistanceFieldResult& field, const FilledRegion& region) {
    double most = 0.0;
    for (std::size_t i = 0; i < field.values.size(); ++i) {
        const Vector2 at{
            field.origin.x + (static_cast<double>(i % field.width) + 0.5) * field.cell,
            field.origin.y + (static_cast<double>(i / field.width) + 0.5) * field.cell};
        const double off =
            std::abs(static_cast<double>(field.values[i]) - region.signed_distance(at));
        most = std::max(most, off - field.error_bound * (1 + 1e-6));
    }
    for (const FieldPoint& point : field.points) {
        const double off = std::abs(point.distance - region.signed_distance(point.position));
        most = std::max(most, off - point.error_bound * (1 + 1e-6));
    }
    return most;
}

class Glyphs : public testing::Test {
protected:
    /// Checks up to `most` of the glyphs with overlapping contours; returns how many there were.
    void check(const char* file, std::size_t least, std::size_t most) {
        const Font font(file);
        std::size_t overlapping = 0;
        std::size_t cut_open = 0;
        for (const unsigned long character : font.characters()) {
            const std::string path = font.path({character});
            if (overlapping == most || path.empty()) {
                continue;
            }
            const Glyph glyph = glyph_of(font, character);
            const FilledRegion region(glyph.contours, FillRule::nonzero);
            if (region.inner_edges().empty()) {
                continue;
            }
            SCOPED_TRACE(std::string(file) + ", character " + std::to_string(character));
            ++overlapping;
            cut_open += check_glyph(glyph, region, font.em()) ? 1U : 0U;
            if (HasFailure()) {
                return;
            }
        }
        EXPECT_GE(overlapping, least);
        // Otherwise nothing would be tested here.
        EXPECT_GE(cut_open, overlapping / 2);
    }

    /// Returns true if the odd-even rule, with inner edges as boundary, gives another field.
    bool check_glyph(const Glyph& glyph, const FilledRegion& region, double em) {
        const Rectangle box = box_of(glyph.contours);
        std::vector<Vector2> on_inner_edges;
        for (const Edge& edge : region.inner_edges()) {
            on_inner_edges.push_back(
                {0.5 * (edge.from.x + edge.to.x), 0.5 * (edge.from.y + edge.to.y)});
        }
        const tools::ShapeRings rings = tools::make_shape_rings(glyph.outline, glyph.deviation,
                                                                {.fill_rule = FillRule::nonzero});
        EXPECT_LE(rings.deviation, glyph.deviation);
        const DistanceFieldResult field =
            field_of(context_, rings.rings, rings.deviation, box, on_inner_edges);
        EXPECT_LE(excess(field, region), 1e-9 * em);
        // The result's edges are the outer outline, all of it and nothing else.
        for (const Ring& ring : rings.rings) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vector2& a = ring[i];
                const Vector2& b = ring[(i + 1) % ring.size()];
                EXPECT_LE(region.distance({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}), glyph.deviation);
            }
        }
        const tools::ShapeRings as_they_are =
            tools::make_shape_rings(glyph.outline, glyph.deviation, {});
        const DistanceFieldResult odd_even =
            field_of(context_, as_they_are.rings, as_they_are.deviation, box, on_inner_edges);
        return excess(odd_even, region) > 1e-3 * em;
    }

    Context context_ = *Context::create_cpu();
};

TEST_F(Glyphs, OfDejaVuSansHaveNoInnerEdges) {
    check(NEARFIELD_DEJAVU, 40, 50);
}

TEST_F(Glyphs, OfInterHaveNoInnerEdges) {
    check(NEARFIELD_INTER, 60, 60);
}

TEST_F(Glyphs, OfEBGaramondHaveNoInnerEdges) {
    check(NEARFIELD_EBGARAMOND, 10, 60);
}

}  // namespace
}  // namespace nearfield::test
