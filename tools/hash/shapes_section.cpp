#include <nearfield/curve.hpp>
#include <nearfield/fill.hpp>

#include <embedded/austria_50m.hpp>
#include <embedded/cuba_50m.hpp>
#include <embedded/iceland_10m.hpp>
#include <embedded/ireland_10m.hpp>
#include <embedded/sri_lanka_10m.hpp>
#include <embedded/sweden_50m.hpp>
#include <tools/common/library_error.hpp>
#include <tools/hash/answer_hash.hpp>
#include <tools/hash/pairs.hpp>
#include <tools/hash/questions.hpp>
#include <tools/hash/sections.hpp>
#include <tools/io/geojson.hpp>

#include <algorithm>

namespace nearfield::hash {
namespace {

/// Runs a batch and adds its answers.
void add_answers(Context& context, const Batch& batch, Results& results, AnswerHash& hash) {
    tools::require(context.run(batch, results));
    for (const AnyResult& result : results.results) {
        hash.add(result);
    }
}

ShapeHandle add_shape(Context& context, std::span<const Ring> rings, double deviation = 0.0) {
    return tools::take(context.add_shape(rings, deviation));
}

/// Curves of every kind, as rings.
std::vector<Ring> curves(double deviation) {
    CurvePath path;
    path.move_to({-1.0, 0.0})
        .cubic_to({-1.5, 1.0}, {0.0, 1.2}, {0.1, 0.6})
        .quadratic_to({1.0, 1.5}, {1.2, 0.1})
        .arc_to({.radius_x = 0.9, .radius_y = 0.4, .rotation = 0.7, .large = true}, {0.3, -0.8})
        .arc_about({-0.2, -0.7}, 2.5)
        .close()
        .circle({0.1, 0.2}, 0.25)
        .ellipse({-0.5, 0.1}, 0.3, 0.1, 1.1);
    return tools::take(tessellate(path, deviation));
}

/// The rings of a GeoJSON text, scaled to a width of 2 around the origin.
std::vector<Ring> outline(const char* text) {
    std::vector<Ring> rings = tools::parse_geojson(text, "outline");
    Vector2 low = rings.front().front();
    Vector2 high = low;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
            high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
        }
    }
    const double scale = 2.0 / (high.x - low.x);
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex = {scale * (vertex.x - 0.5 * (low.x + high.x)),
                      scale * (vertex.y - 0.5 * (low.y + high.y))};
        }
    }
    return rings;
}

}  // namespace

std::uint64_t hash_pairs(const MakeContext& make_context, std::uint32_t first,
                         std::uint32_t count) {
    constexpr std::uint32_t pairs_of_batch = 25;
    AnswerHash hash;
    Context context = make_context({});
    Results results;
    Batch batch;
    std::vector<ShapeHandle> shapes;
    const std::vector<Vector2> points{{0.1, 0.2}, {-0.4, 0.3}, {0.5, -0.6}};
    std::vector<std::vector<Vector2>> moved(pairs_of_batch);
    for (std::uint32_t begin = first; begin < first + count; begin += pairs_of_batch) {
        batch.clear();
        shapes.clear();
        const std::uint32_t end = std::min(begin + pairs_of_batch, first + count);
        for (std::uint32_t i = begin; i < end; ++i) {
            Integers integers(i);
            const Pair pair = any_pair(integers);
            const ShapeHandle a = shapes.emplace_back(add_shape(context, pair.a));
            const ShapeHandle b = shapes.emplace_back(add_shape(context, pair.b));
            std::vector<Vector2>& around = moved[i - begin];
            around = points;
            for (Vector2& point : around) {
                point = {point.x + pair.pose_b.translation.x, point.y + pair.pose_b.translation.y};
            }
            ask_everything({{a, pair.pose_a}, {b, pair.pose_b}, pair.tolerance}, around, 5'000,
                           batch);
        }
        add_answers(context, batch, results, hash);
        for (const ShapeHandle shape : shapes) {
            tools::require(context.remove_shape(shape));
        }
    }
    return hash.value();
}

std::uint64_t hash_outlines(const MakeContext& make_context) {
    constexpr double deviation = 1e-3;
    AnswerHash hash;
    const std::vector<Vector2> points{{0.1, 0.2}, {-0.4, 0.3}, {0.5, -0.6}};
    for (const BoundingVolume volume : {BoundingVolume::axis_aligned, BoundingVolume::oriented}) {
        Context context = make_context({.bounding_volume = volume});
        std::vector<ShapeHandle> shapes;
        for (const char* text :
             {embedded::iceland_10m, embedded::ireland_10m, embedded::sri_lanka_10m,
              embedded::austria_50m, embedded::cuba_50m, embedded::sweden_50m}) {
            shapes.push_back(add_shape(context, outline(text)));
        }
        const std::vector<Ring> rings = curves(deviation);
        for (const Ring& ring : rings) {
            hash.add(std::span<const Vector2>(ring));
        }
        shapes.push_back(add_shape(context, rings, deviation));
        Batch batch;
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const Instance a{shapes[i], {{0.3, -0.1}, 0.4}};
            const Instance b{shapes[(i + 1) % shapes.size()], {{-0.2, 0.1}, -1.3}};
            ask_everything({a, b, 0.02}, points, 20'000, batch);
            ask_everything({b, b, 0.02}, points, 20'000, batch);
        }
        Results results;
        add_answers(context, batch, results, hash);
    }
    Integers integers(3);
    for (int i = 0; i < 200; ++i) {
        const ResolvedFill filled =
            tools::take(resolve_fill(any_shape(integers), FillRule::nonzero));
        for (const Ring& ring : filled.rings) {
            hash.add(std::span<const Vector2>(ring));
        }
    }
    return hash.value();
}

}  // namespace nearfield::hash
