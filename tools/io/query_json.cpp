#include <tools/io/query_json.hpp>
#include <tools/io/world_report.hpp>

#include <numbers>
#include <string_view>
#include <utility>
#include <variant>

namespace nearfield::tools {
namespace {

void write_feature(JsonWriter& json, Feature feature) {
    json.begin_object();
    json.key(feature.kind == Feature::Kind::edge ? "edge" : "vertex");
    json.value(std::uint64_t{feature.index}).end_object();
}

void write_regions(JsonWriter& json, const ResultSummary& summary) {
    json.key("regions").begin_array(JsonWriter::Layout::lines);
    for (const Region& region : summary.regions) {
        json.begin_object();
        json.key("min").value(region.min).key("max").value(region.max);
        json.key("width").value(std::uint64_t{region.width});
        json.key("height").value(std::uint64_t{region.height});
        json.end_object();
    }
    json.end_array();
}

void write_tiles(JsonWriter& json, const std::vector<TileReport>& tiles) {
    json.key("tiles").begin_array(JsonWriter::Layout::lines);
    for (const TileReport& tile : tiles) {
        json.begin_object();
        json.key("technique").value(to_string(tile.technique));
        json.key("side").value(tile.side == Side::a ? "a" : "b");
        json.key("min").value(tile.min).key("max").value(tile.max);
        json.key("width").value(std::uint64_t{tile.width});
        json.key("height").value(std::uint64_t{tile.height});
        json.key("tile_batch").value(std::uint64_t{tile.tile_batch});
        json.key("x").value(std::uint64_t{tile.x}).key("y").value(std::uint64_t{tile.y});
        json.end_object();
    }
    json.end_array();
}

void write_result(JsonWriter& json, const PenetrationResult& result) {
    json.key("count").value(std::uint64_t{result.count});
    json.key("deepest");
    if (result.count == 0) {
        json.null();
    } else {
        json.begin_object().key("point").value(result.deepest.position);
        json.key("depth").value(result.deepest.depth);
        json.key("direction").value(result.deepest.direction).end_object();
    }
    json.key("records").begin_array(JsonWriter::Layout::lines);
    for (const PenetratingPoint& record : result.points) {
        json.begin_object().key("point").value(record.position);
        json.key("depth").value(record.depth).key("direction").value(record.direction);
        json.key("nearest").value(record.nearest).key("feature");
        write_feature(json, record.feature);
        json.key("unique").value(record.unique).end_object();
    }
    json.end_array();
}

void write_result(JsonWriter& json, const IntersectionResult& result) {
    json.key("kind").value(name_of(result.kind));
    json.key("strategy").value(name_of(result.strategy));
    json.key("count").value(result.count);
    json.key("area").value(result.area);
    json.key("box");
    if (result.count == 0) {
        json.null();
    } else {
        json.begin_object().key("min").value(result.box.min);
        json.key("max").value(result.box.max).end_object();
    }
    json.key("samples").begin_array(JsonWriter::Layout::lines);
    for (const IntersectionSample& sample : result.samples) {
        json.value(sample.position);
    }
    json.end_array();
    if (result.kind == IntersectionKind::volume_volume) {
        return;
    }
    json.key("edges").begin_array();
    for (const IntersectionSample& sample : result.samples) {
        if (sample.edge == IntersectionSample::no_edge) {
            json.null();
        } else {
            json.value(std::uint64_t{sample.edge});
        }
    }
    json.end_array();
}

void write_result(JsonWriter& json, const DistanceFieldResult& result) {
    json.key("origin").value(result.origin);
    json.key("width").value(std::uint64_t{result.width});
    json.key("height").value(std::uint64_t{result.height});
    if (result.points.empty()) {
        return;
    }
    json.key("points").begin_array(JsonWriter::Layout::lines);
    for (const FieldPoint& point : result.points) {
        json.begin_object().key("point").value(point.position);
        json.key("distance").value(point.distance).key("error_bound").value(point.error_bound);
        json.key("inside").value(point.inside).key("gradient").value(point.gradient);
        json.key("feature");
        write_feature(json, point.feature);
        json.key("unique").value(point.unique).end_object();
    }
    json.end_array();
}

/// The methods that made a field, if they were requested.
void write_methods(JsonWriter& json, const QueryRequest& request,
                   const DistanceFieldResult& result) {
    json.key("sign").value(name_of(request.sign));
    if (request.gradients || !request.at.empty()) {
        json.key("gradient").value(name_of(request.gradient));
        json.key("gradient_error_bound").value(result.gradient_error_bound);
        if (request.gradient == GradientMethod::blended) {
            json.key("gradient_format").value(result.gradient_format);
        }
    }
}

void write_contact(JsonWriter& json, const ContactPoint& contact) {
    json.begin_object().key("point").value(contact.position);
    json.key("normal").value(contact.normal).key("distance").value(contact.distance);
    json.key("nearest").value(contact.nearest).key("feature");
    write_feature(json, contact.feature);
    json.key("on").value(contact.on == Side::a ? "a" : "b");
    json.key("inside").value(contact.inside).key("unique").value(contact.unique).end_object();
}

void write_result(JsonWriter& json, const ContactResult& result) {
    json.key("count").value(std::uint64_t{result.count});
    json.key("manifold").begin_array(JsonWriter::Layout::lines);
    for (const ContactCluster& cluster : result.manifold) {
        json.begin_object().key("first").value(cluster.first).key("last").value(cluster.last);
        json.key("normal").value(cluster.normal);
        json.key("count").value(std::uint64_t{cluster.count}).key("extreme");
        write_contact(json, cluster.extreme);
        json.end_object();
    }
    json.end_array();
    json.key("contacts").begin_array(JsonWriter::Layout::lines);
    for (const ContactPoint& contact : result.points) {
        write_contact(json, contact);
    }
    json.end_array();
}

/// Writes null at distance 0, because then there is no direction.
void write_direction(JsonWriter& json, double distance, Vector2 direction) {
    json.key("direction");
    if (distance > 0.0) {
        json.value(direction);
    } else {
        json.null();
    }
}

/// Writes null at distance 0.
template <class Result>
void write_feature_pair(JsonWriter& json, const Result& result, double distance) {
    for (const auto& [key, feature] :
         {std::pair{"feature_a", result.feature_a}, std::pair{"feature_b", result.feature_b}}) {
        json.key(key);
        if (distance > 0.0) {
            write_feature(json, feature);
        } else {
            json.null();
        }
    }
}

template <class Result>
void write_features(JsonWriter& json, const Result& result) {
    write_feature_pair(json, result, result.distance);
    json.key("unique").value(result.unique);
    json.key("sampled_distance").value(result.sampled_distance);
}

void write_result(JsonWriter& json, const ClosestPointResult& result) {
    json.key("point").value(result.point);
    json.key("distance").value(result.distance);
    json.key("nearest").value(result.nearest);
    write_direction(json, result.distance, result.direction);
    write_features(json, result);
}

void write_result(JsonWriter& json, const SeparationResult& result) {
    json.key("distance").value(result.distance);
    json.key("point_a").value(result.point_a).key("point_b").value(result.point_b);
    write_direction(json, result.distance, result.direction);
    write_features(json, result);
}

/// Only the members common to all answers.
void write_result(JsonWriter& /*json*/, const IntersectionTestResult& /*result*/) {}

void write_pose(JsonWriter& json, std::string_view key, const Pose& pose) {
    constexpr double degrees = 180.0 / std::numbers::pi;
    json.key(key).begin_object().key("translation").value(pose.translation);
    json.key("degrees").value(pose.angle * degrees).end_object();
}

void write_result(JsonWriter& json, const TimeOfImpactResult& result) {
    json.key("state").value(name_of(result.state));
    json.key("time").value(result.time);
    json.key("time_error_bound").value(result.time_error_bound);
    write_pose(json, "pose_a", result.pose_a);
    write_pose(json, "pose_b", result.pose_b);
    json.key("distance").value(result.distance);
    json.key("least_distance").value(result.min_distance);
    json.key("point_a").value(result.point_a).key("point_b").value(result.point_b);
    write_direction(json, result.distance, result.direction);
    write_feature_pair(json, result, result.distance);
    json.key("steps").value(std::uint64_t{result.steps});
}

void write_result(JsonWriter& json, const SeparationVectorResult& result) {
    json.key("vector").value(result.vector);
    json.key("length").value(result.length);
    json.key("lower_bound").value(result.lower_bound);
    json.key("work").value(result.work);
}

void write_result(JsonWriter& json, const ContainmentResult& result) {
    json.key("inside").value(result.inside);
    json.key("clearance").value(result.clearance);
    for (const auto& [key, point] :
         {std::pair{"point_a", result.point_a}, std::pair{"point_b", result.point_b}}) {
        json.key(key);
        if (result.inside) {
            json.value(point);
        } else {
            json.null();
        }
    }
    write_direction(json, result.clearance, result.direction);
    write_feature_pair(json, result, result.clearance);
    json.key("unique").value(result.unique);
}

}  // namespace

void write_timings(JsonWriter& json, const Timings& timings) {
    json.key("timings_ms").begin_object();
    for (const auto& [name, milliseconds] :
         {std::pair{"localize", timings.localize}, std::pair{"plan", timings.plan},
          std::pair{"record", timings.record}, std::pair{"device", timings.device},
          std::pair{"decode", timings.decode}}) {
        if (milliseconds != 0.0) {
            json.key(name).value(milliseconds);
        }
    }
    json.key("total").value(timings.total);
    if (!timings.passes.empty()) {
        json.key("passes").begin_object();
        for (const PassTime& pass : timings.passes) {
            json.key(pass.name).value(pass.milliseconds);
        }
        json.end_object();
    }
    json.end_object();
}

namespace {

void write_localization(JsonWriter& json, const LocalizationStatistics& statistics) {
    json.key("localization").begin_object();
    json.key("nodes_evaluated").value(statistics.nodes_evaluated);
    json.key("pairs_rejected").value(statistics.pairs_rejected);
    json.key("edges_kept").value(statistics.edges_kept).end_object();
}

/// Writes the time of one query of a scene.
void write_time(JsonWriter& json, const QueryTime& time) {
    json.key("time_ms").begin_object();
    json.key("plan").value(time.plan);
    json.key("answer").value(time.answer);
    json.key("device");
    if (time.device) {
        json.value(*time.device);
    } else {
        json.null();
    }
    json.end_object();
}

/// Writes the members of an answer, alone or in a scene, except device and timings.
void write_answer(JsonWriter& json, const QueryRequest& request, const AnyResult& result) {
    const ResultSummary& summary = summary_of(result);
    json.key("query").value(name_of(request.type));
    if (has_tolerance(request.type)) {
        json.key("tolerance").value(summary.tolerance);
    }
    json.key("error_bound").value(summary.error_bound);
    if (is_sampled(request.type)) {
        json.key("cell").value(summary.cell);
    }
    json.key("intersects").value(summary.intersects);
    json.key("technique").value(to_string(summary.technique));
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
    json.key("device").value_or_null(answer.device);
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
    json.key("device").value_or_null(device);
    json.key("technique").value(technique);
    write_timings(json, timings);
    json.key("results").begin_array(JsonWriter::Layout::lines);
    for (const SceneAnswer& answer : answers) {
        json.begin_object(JsonWriter::Layout::lines);
        if (!find_world_query_type(answer.kind)) {
            json.key("a").value_or_null(answer.a);
            json.key("b").value_or_null(answer.b);
        }
        const Status& status = summary_of(answer.result).status;
        json.key("status").value(to_string(status.code()));
        if (answer.world != nullptr) {
            write_world_answer(json, *answer.world);
        } else if (status.ok()) {
            write_answer(json, answer.request, answer.result);
            if (answer.time != nullptr) {
                write_time(json, *answer.time);
            }
        } else {
            json.key("query").value_or_null(answer.kind);
            json.key("message").value(std::string_view(full_message(status)));
        }
        json.end_object();
    }
    json.end_array().end_object();
    stream << '\n';
}

}  // namespace nearfield::tools
