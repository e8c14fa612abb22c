#include <tools/io/query_json.hpp>
#include <tools/io/world_report.hpp>

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

}  // namespace nearfield::tools
