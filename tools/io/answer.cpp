#include <tools/io/answer.hpp>
#include <tools/io/world_report.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>
#include <utility>
#include <variant>

namespace nearfield::tools {
namespace {

void write_regions(JsonWriter& json, const ResultSummary& summary) {
    json.list("regions", summary.regions, [&json](const Region& region) {
        json.begin_object();
        json.member("min", region.min).member("max", region.max);
        json.member("width", region.width).member("height", region.height).end_object();
    });
}

void write_tiles(JsonWriter& json, const std::vector<TileReport>& tiles) {
    json.list("tiles", tiles, [&json](const TileReport& tile) {
        json.begin_object().member("technique", to_string(tile.technique));
        json.member("side", tile.side == Side::a ? "a" : "b");
        json.member("min", tile.min).member("max", tile.max);
        json.member("width", tile.width).member("height", tile.height);
        json.member("tile_batch", tile.tile_batch);
        json.member("x", tile.x).member("y", tile.y).end_object();
    });
}

void write_result(JsonWriter& json, const PenetrationResult& result) {
    json.member("count", result.count).key("deepest");
    if (result.count == 0) {
        json.null();
    } else {
        json.begin_object().member("point", result.deepest.position);
        json.member("depth", result.deepest.depth);
        json.member("direction", result.deepest.direction).end_object();
    }
    json.list("records", result.points, [&json](const PenetratingPoint& record) {
        json.begin_object().member("point", record.position);
        json.member("depth", record.depth).member("direction", record.direction);
        json.member("nearest", record.nearest).member("feature", record.feature);
        json.member("unique", record.unique).end_object();
    });
}

void write_result(JsonWriter& json, const IntersectionResult& result) {
    json.member("kind", name_of(result.kind)).member("strategy", name_of(result.strategy));
    json.member("count", result.count).member("area", result.area).key("box");
    if (result.count == 0) {
        json.null();
    } else {
        json.begin_object().member("min", result.box.min);
        json.member("max", result.box.max).end_object();
    }
    json.list("samples", result.samples,
              [&json](const IntersectionSample& sample) { json.value(sample.position); });
    if (result.kind == IntersectionKind::volume_volume) {
        return;
    }
    json.key("edges").begin_array();
    for (const IntersectionSample& sample : result.samples) {
        const bool has_edge = sample.edge != IntersectionSample::no_edge;
        json.value(has_edge ? std::optional(sample.edge) : std::nullopt);
    }
    json.end_array();
}

void write_result(JsonWriter& json, const DistanceFieldResult& result) {
    json.member("origin", result.origin);
    json.member("width", result.width).member("height", result.height);
    if (result.points.empty()) {
        return;
    }
    json.list("points", result.points, [&json](const FieldPoint& point) {
        json.begin_object().member("point", point.position);
        json.member("distance", point.distance).member("error_bound", point.error_bound);
        json.member("inside", point.inside).member("gradient", point.gradient);
        json.member("feature", point.feature).member("unique", point.unique).end_object();
    });
}

/// The methods that made a field, if they were requested.
void write_methods(JsonWriter& json, const QueryRequest& request,
                   const DistanceFieldResult& result) {
    json.member("sign", name_of(request.sign.value_or(SignEncoding::stencil)));
    if (request.gradients || !request.at.empty()) {
        const GradientMethod method = request.gradient.value_or(GradientMethod::analytic);
        json.member("gradient", name_of(method));
        json.member("gradient_error_bound", result.gradient_error_bound);
        if (method == GradientMethod::blended) {
            json.member("gradient_format", result.gradient_format);
        }
    }
}

void write_contact(JsonWriter& json, const ContactPoint& contact) {
    json.begin_object().member("point", contact.position);
    json.member("normal", contact.normal).member("distance", contact.distance);
    json.member("nearest", contact.nearest).member("feature", contact.feature);
    json.member("on", contact.on == Side::a ? "a" : "b");
    json.member("inside", contact.inside).member("unique", contact.unique).end_object();
}

void write_result(JsonWriter& json, const ContactResult& result) {
    json.member("count", result.count);
    json.list("manifold", result.manifold, [&json](const ContactCluster& cluster) {
        json.begin_object().member("first", cluster.first).member("last", cluster.last);
        json.member("normal", cluster.normal).member("count", cluster.count).key("extreme");
        write_contact(json, cluster.extreme);
        json.end_object();
    });
    json.list("contacts", result.points,
              [&json](const ContactPoint& contact) { write_contact(json, contact); });
}

/// Writes the direction and the features of a pair of points, which are null at distance 0.
template <class Result>
void write_pair(JsonWriter& json, const Result& result, double distance) {
    json.member("direction", result.direction, distance > 0.0);
    json.member("feature_a", result.feature_a, distance > 0.0);
    json.member("feature_b", result.feature_b, distance > 0.0);
}

void write_result(JsonWriter& json, const ClosestPointResult& result) {
    json.member("point", result.point).member("distance", result.distance);
    json.member("nearest", result.nearest);
    write_pair(json, result, result.distance);
    json.member("unique", result.unique).member("sampled_distance", result.sampled_distance);
}

void write_result(JsonWriter& json, const SeparationResult& result) {
    json.member("distance", result.distance);
    json.member("point_a", result.point_a).member("point_b", result.point_b);
    write_pair(json, result, result.distance);
    json.member("unique", result.unique).member("sampled_distance", result.sampled_distance);
}

/// Only the members common to all answers.
void write_result(JsonWriter& /*json*/, const IntersectionTestResult& /*result*/) {}

void write_pose(JsonWriter& json, std::string_view key, const Pose& pose) {
    constexpr double degrees = 180.0 / std::numbers::pi;
    json.key(key).begin_object().member("translation", pose.translation);
    json.member("degrees", pose.angle * degrees).end_object();
}

void write_result(JsonWriter& json, const TimeOfImpactResult& result) {
    json.member("state", name_of(result.state));
    json.member("time", result.time);
    json.member("time_error_bound", result.time_error_bound);
    write_pose(json, "pose_a", result.pose_a);
    write_pose(json, "pose_b", result.pose_b);
    json.member("distance", result.distance);
    json.member("least_distance", result.min_distance);
    json.member("point_a", result.point_a).member("point_b", result.point_b);
    write_pair(json, result, result.distance);
    json.member("steps", result.steps);
}

void write_result(JsonWriter& json, const SeparationVectorResult& result) {
    json.member("vector", result.vector);
    json.member("length", result.length);
    json.member("lower_bound", result.lower_bound);
    json.member("work", result.work);
}

void write_result(JsonWriter& json, const ContainmentResult& result) {
    json.member("inside", result.inside).member("clearance", result.clearance);
    json.member("point_a", result.point_a, result.inside);
    json.member("point_b", result.point_b, result.inside);
    write_pair(json, result, result.clearance);
    json.member("unique", result.unique);
}

}  // namespace

void write_timings(JsonWriter& json, const Timings& timings) {
    json.key("timings_ms").begin_object();
    for (const auto& [name, milliseconds] :
         {std::pair{"localize", timings.localize}, std::pair{"plan", timings.plan},
          std::pair{"record", timings.record}, std::pair{"device", timings.device},
          std::pair{"decode", timings.decode}}) {
        if (milliseconds != 0.0) {
            json.member(name, milliseconds);
        }
    }
    json.member("total", timings.total);
    if (!timings.passes.empty()) {
        write_passes(json, "passes", timings.passes);
    }
    json.end_object();
}

void write_passes(JsonWriter& json, std::string_view name, std::span<const PassTime> passes) {
    json.key(name).begin_object();
    for (const PassTime& pass : passes) {
        json.member(pass.name, pass.milliseconds);
    }
    json.end_object();
}

namespace {

void write_localization(JsonWriter& json, const LocalizationStatistics& statistics) {
    json.key("localization").begin_object();
    json.member("nodes_evaluated", statistics.nodes_evaluated);
    json.member("pairs_rejected", statistics.pairs_rejected);
    json.member("edges_kept", statistics.edges_kept).end_object();
}

/// Writes the time of one query of a scene.
void write_time(JsonWriter& json, const QueryTime& time) {
    json.key("time_ms").begin_object();
    json.member("plan", time.plan).member("answer", time.answer);
    json.member("device", time.device).end_object();
}

/// Writes the members of an answer, alone or in a scene, except device and timings.
void write_answer(JsonWriter& json, const QueryRequest& request, const AnyResult& result) {
    const ResultSummary& summary = summary_of(result);
    json.member("query", name_of(request.type));
    if (has_tolerance(request.type)) {
        json.member("tolerance", summary.tolerance);
    }
    json.member("error_bound", summary.error_bound);
    if (is_sampled(request.type)) {
        json.member("cell", summary.cell);
    }
    json.member("intersects", summary.intersects);
    json.member("technique", to_string(summary.technique));
    write_localization(json, summary.localization);
    if (const auto* field = std::get_if<DistanceFieldResult>(&result)) {
        write_methods(json, request, *field);
    }
    write_regions(json, summary);
    std::visit([&json](const auto& any) { write_result(json, any); }, result);
}

}  // namespace

void write_query_json(std::ostream& stream, const Answer& answer) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.member("device", answer.device, !answer.device.empty());
    write_timings(json, answer.timings);
    write_answer(json, answer.request, answer.result);
    if (answer.tiles != nullptr) {
        write_tiles(json, *answer.tiles);
    }
    json.end_object();
    stream << '\n';
}

void write_scene_json(std::ostream& stream, std::span<const SceneAnswer> answers,
                      const Timings& timings, const std::string& device,
                      std::string_view technique) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.member("device", device, !device.empty());
    json.member("technique", technique);
    write_timings(json, timings);
    json.list("results", answers, [&json](const SceneAnswer& answer) {
        json.begin_object(JsonWriter::Layout::lines);
        if (!find_named<WorldQueryType>(answer.kind)) {
            json.member("a", answer.a, !answer.a.empty());
            json.member("b", answer.b, !answer.b.empty());
        }
        const Status& status = summary_of(answer.result).status;
        json.member("status", to_string(status.code()));
        if (answer.world != nullptr) {
            write_world_answer(json, *answer.world);
        } else if (status.ok()) {
            write_answer(json, answer.request, answer.result);
            if (answer.time != nullptr) {
                write_time(json, *answer.time);
            }
        } else {
            json.member("query", answer.kind, !answer.kind.empty());
            json.member("message", full_message(status));
        }
        json.end_object();
    });
    json.end_object();
    stream << '\n';
}

namespace {

/// Nine digits, because points may be far from the origin.
std::string point_text(Vector2 point) {
    char text[64];
    std::snprintf(text, sizeof text, "(%.9g, %.9g)", point.x + 0.0, point.y + 0.0);
    return text;
}

/// Calls `write` for the first few of many, and says how many more there are.
template <class Value, class Write>
void write_first(std::ostream& stream, const std::vector<Value>& all, Write write) {
    constexpr std::size_t max_shown = 8;
    for (const Value& value : std::span(all).first(std::min(all.size(), max_shown))) {
        write(value);
    }
    if (all.size() > max_shown) {
        write_item(stream, "", "and " + std::to_string(all.size() - max_shown) + " more");
    }
}

std::string feature_text(Feature feature) {
    return (feature.kind == Feature::Kind::edge ? "edge " : "vertex ") +
           std::to_string(feature.index);
}

void write_result(std::ostream& stream, const PenetrationResult& result) {
    write_item(stream, "count", std::to_string(result.count) + " penetrating points");
    if (result.count == 0) {
        return;
    }
    const PenetratingPoint& deepest = result.deepest;
    const double degrees =
        std::atan2(deepest.direction.y, deepest.direction.x) * (180.0 / std::numbers::pi);
    write_item(stream, "deepest", point_text(deepest.position));
    write_item(stream, "depth", short_number(deepest.depth));
    write_item(stream, "direction",
               point_text(deepest.direction) + ", " + short_number(degrees) + " degrees");
    write_item(stream, "nearest",
               point_text(deepest.nearest) + " on " + feature_text(deepest.feature) + " of B" +
                   (deepest.unique ? "" : ", one of several"));
}

void write_result(std::ostream& stream, const IntersectionResult& result) {
    write_item(stream, "kind", std::string(name_of(result.kind)));
    write_item(stream, "strategy", std::string(name_of(result.strategy)));
    write_item(stream, "count", std::to_string(result.count) + " samples");
    write_item(stream, "area", short_number(result.area));
    if (result.count > 0) {
        write_item(stream, "box", point_text(result.box.min) + " to " + point_text(result.box.max));
    }
}

void write_result(std::ostream& stream, const DistanceFieldResult& result) {
    write_item(stream, "origin", point_text(result.origin));
    write_item(stream, "grid",
               std::to_string(result.width) + " x " + std::to_string(result.height) + " cells of " +
                   short_number(result.cell));
    if (result.gradient_error_bound > 0.0) {
        const std::string format = result.gradient_format;
        write_item(stream, "gradient",
                   "error bound " + short_number(result.gradient_error_bound) +
                       (format.empty() ? "" : ", blended in " + format));
    }
    write_first(stream, result.points, [&stream](const FieldPoint& point) {
        write_item(stream, "at " + point_text(point.position),
                   short_number(point.distance) + " within " + short_number(point.error_bound) +
                       ", inside " + short_number(point.inside) + ", gradient " +
                       point_text(point.gradient) + ", " + feature_text(point.feature) +
                       (point.unique ? "" : ", one of several"));
    });
}

void write_result(std::ostream& stream, const ContactResult& result) {
    write_item(stream, "count",
               std::to_string(result.count) + " contact points in " +
                   std::to_string(result.manifold.size()) + " stretches");
    write_first(stream, result.manifold, [&stream](const ContactCluster& cluster) {
        write_item(stream, "",
                   point_text(cluster.first) + " to " + point_text(cluster.last) + ", normal " +
                       point_text(cluster.normal) +
                       (cluster.extreme.inside ? ", depth " : ", distance ") +
                       short_number(cluster.extreme.distance));
    });
}

void write_pair(std::ostream& stream, Vector2 on_a, Vector2 on_b, Feature feature_a,
                Feature feature_b, bool unique) {
    write_item(stream, "point of A", point_text(on_a) + " on " + feature_text(feature_a));
    write_item(stream, "point of B",
               point_text(on_b) + " on " + feature_text(feature_b) +
                   (unique ? "" : ", one of several pairs"));
}

void write_closest(std::ostream& stream, double distance, Vector2 on_a, Vector2 on_b,
                   Feature feature_a, Feature feature_b, bool unique) {
    write_item(stream, "distance", short_number(distance));
    if (distance > 0.0) {
        write_pair(stream, on_a, on_b, feature_a, feature_b, unique);
    } else {
        write_item(stream, "common point", point_text(on_a));
    }
}

void write_result(std::ostream& stream, const ClosestPointResult& result) {
    write_closest(stream, result.distance, result.point, result.nearest, result.feature_a,
                  result.feature_b, result.unique);
}

void write_result(std::ostream& stream, const SeparationResult& result) {
    write_closest(stream, result.distance, result.point_a, result.point_b, result.feature_a,
                  result.feature_b, result.unique);
}

void write_result(std::ostream& stream, const IntersectionTestResult& result) {
    write_item(stream, "share a point", result.intersects ? "yes" : "no");
}

std::string pose_text(const Pose& pose) {
    constexpr double degrees = 180.0 / std::numbers::pi;
    return point_text(pose.translation) + ", " + short_number(pose.angle * degrees) + " degrees";
}

/// Nine digits, with the uncertainty that remains.
std::string time_text(const TimeOfImpactResult& result) {
    char text[64];
    std::snprintf(text, sizeof text, "%.9g", result.time);
    return text + (result.time_error_bound > 0.0
                       ? ", or up to " + short_number(result.time_error_bound) + " later"
                       : std::string());
}

void write_result(std::ostream& stream, const TimeOfImpactResult& result) {
    write_item(stream, "state", std::string(name_of(result.state)));
    write_item(stream, "time", time_text(result));
    write_item(stream, "pose of A then", pose_text(result.pose_a));
    write_item(stream, "pose of B then", pose_text(result.pose_b));
    if (result.state == ImpactState::intersecting_at_start && result.distance == 0.0) {
        write_item(stream, "common point", point_text(result.point_a));
    } else {
        write_item(stream, "distance then",
                   short_number(result.distance) + ", before it never less than " +
                       short_number(result.min_distance));
        write_item(stream, "point of A",
                   point_text(result.point_a) + " on " + feature_text(result.feature_a));
        write_item(stream, "point of B",
                   point_text(result.point_b) + " on " + feature_text(result.feature_b));
        write_item(stream, "direction", point_text(result.direction));
    }
    write_item(stream, "steps", std::to_string(result.steps));
}

void write_result(std::ostream& stream, const SeparationVectorResult& result) {
    write_item(stream, "vector", point_text(result.vector));
    write_item(
        stream, "length",
        short_number(result.length) + "; none is shorter than " + short_number(result.lower_bound));
}

void write_result(std::ostream& stream, const ContainmentResult& result) {
    write_item(stream, "A inside B", result.inside ? "yes" : "no");
    if (!result.inside) {
        return;
    }
    write_item(stream, "clearance", short_number(result.clearance));
    if (result.clearance > 0.0) {
        write_pair(stream, result.point_a, result.point_b, result.feature_a, result.feature_b,
                   result.unique);
    } else {
        write_item(stream, "touching at", point_text(result.point_a));
    }
}

void write_regions(std::ostream& stream, const ResultSummary& summary) {
    write_item(stream, "regions", std::to_string(summary.regions.size()));
    write_first(stream, summary.regions, [&stream](const Region& region) {
        write_item(stream, "",
                   point_text(region.min) + " to " + point_text(region.max) + ", " +
                       std::to_string(region.width) + " x " + std::to_string(region.height) +
                       " cells");
    });
}

}  // namespace

void write_item(std::ostream& stream, std::string_view name, const std::string& text) {
    constexpr std::size_t column = 18;
    stream << name << std::string(name.size() < column ? column - name.size() : 1, ' ') << text
           << '\n';
}

std::string short_number(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", number + 0.0);  // + 0.0: no negative zero
    return text;
}

void write_timings_summary(std::ostream& stream, const Timings& timings) {
    const auto write_time = [&stream](std::string_view name, double milliseconds) {
        char text[32];
        std::snprintf(text, sizeof text, "%10.3f ms", milliseconds);
        write_item(stream, name, text);
    };
    const auto write_stage = [&](std::string_view name, double milliseconds) {
        if (milliseconds != 0.0) {  // it took place
            write_time(name, milliseconds);
        }
    };
    write_stage("localize", timings.localize);
    write_stage("plan", timings.plan);
    write_stage("record", timings.record);
    write_stage("device", timings.device);
    for (const PassTime& pass : timings.passes) {
        write_time("  " + pass.name, pass.milliseconds);
    }
    write_stage("decode", timings.decode);
    write_time("total", timings.total);
}

void write_summary(std::ostream& stream, const Answer& answer) {
    const ResultSummary& summary = summary_of(answer.result);
    write_item(stream, "query", std::string(name_of(answer.request.type)));
    write_item(stream, "device", device_text(answer.device));
    write_item(stream, "technique", to_string(summary.technique));
    const std::string bound = short_number(summary.error_bound);
    if (!has_tolerance(answer.request.type)) {
        write_item(stream, "error bound", bound);
    } else {
        write_item(stream, "tolerance", short_number(summary.tolerance) + ", error bound " + bound);
    }
    write_item(stream, "intersects", summary.intersects ? "yes" : "no");
    if (is_sampled(answer.request.type)) {
        write_regions(stream, summary);
    }
    std::visit([&stream](const auto& result) { write_result(stream, result); }, answer.result);
    write_timings_summary(stream, answer.timings);
}

void write_scene_summary(std::ostream& stream, std::span<const SceneAnswer> answers,
                         const Timings& timings, const std::string& device,
                         std::string_view technique) {
    write_item(stream, "device", device_text(device));
    write_item(stream, "technique", std::string(technique));
    write_item(stream, "queries", std::to_string(answers.size()));
    for (const SceneAnswer& answer : answers) {
        stream << '\n';
        if (answer.world != nullptr) {
            write_world_summary(stream, *answer.world);
            continue;
        }
        const Status& status = summary_of(answer.result).status;
        const std::string_view many =
            find_named<WorldQueryType>(answer.kind) ? "all instances" : "all pairs";
        write_item(
            stream, "query",
            std::string(answer.kind) + " of " +
                (answer.a.empty() ? std::string(many)
                                  : std::string(answer.a) + " and " + std::string(answer.b)));
        if (!status.ok()) {
            write_item(stream, "status", status.text());
            continue;
        }
        std::visit([&stream](const auto& result) { write_result(stream, result); }, answer.result);
    }
    stream << '\n';
    write_timings_summary(stream, timings);
}

}  // namespace nearfield::tools
