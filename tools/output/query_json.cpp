#include <tools/output/query_json.hpp>

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

void write_result(JsonWriter& json, const PenetrationResult& result) {
    json.key("count").value(std::uint64_t{result.count});
    json.key("deepest");
    if (result.count == 0) {
        json.null();
    } else {
        json.begin_object().key("point").value(result.deepest.point);
        json.key("depth").value(result.deepest.depth);
        json.key("direction").value(result.deepest.direction).end_object();
    }
    json.key("records").begin_array(JsonWriter::Layout::lines);
    for (const PenetrationRecord& record : result.records) {
        json.begin_object().key("point").value(record.point);
        json.key("depth").value(record.depth).key("direction").value(record.direction);
        json.key("nearest").value(record.nearest).key("feature");
        write_feature(json, record.feature);
        json.key("unique").value(record.unique).end_object();
    }
    json.end_array();
}

void write_result(JsonWriter& json, const IntersectionResult& result) {
    json.key("kind").value(name_of(result.kind));
    json.key("count").value(result.count);
    json.key("area").value(result.area);
    json.key("samples").begin_array(JsonWriter::Layout::lines);
    for (const IntersectionSample& sample : result.samples) {
        json.value(sample.point);
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
        json.begin_object().key("point").value(point.point);
        json.key("distance").value(point.distance).key("error_bound").value(point.error_bound);
        json.key("inside").value(point.inside).key("gradient").value(point.gradient);
        json.key("feature");
        write_feature(json, point.feature);
        json.key("unique").value(point.unique).end_object();
    }
    json.end_array();
}

/// How a field was made, as far as it was asked for.
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

}  // namespace

void write_timings(JsonWriter& json, const Timings& timings) {
    json.key("timings_ms").begin_object();
    json.key("localize").value(timings.localize).key("plan").value(timings.plan);
    json.key("record").value(timings.record).key("device").value(timings.device);
    json.key("decode").value(timings.decode).key("total").value(timings.total);
    json.key("passes").begin_object();
    for (const PassTime& pass : timings.passes) {
        json.key(pass.name).value(pass.milliseconds);
    }
    json.end_object().end_object();
}

void write_query_json(std::ostream& stream, const Answer& answer) {
    const ResultSummary& summary = summary_of(answer.result);
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.key("query").value(name_of(answer.request.type));
    json.key("tolerance").value(summary.tolerance);
    json.key("error_bound").value(summary.error_bound);
    json.key("cell").value(summary.cell);
    json.key("intersects").value(summary.intersects);
    json.key("device").value(std::string_view(answer.device));
    json.key("technique").value("raster");
    if (const auto* field = std::get_if<DistanceFieldResult>(&answer.result)) {
        write_methods(json, answer.request, *field);
    }
    write_regions(json, summary);
    write_timings(json, answer.timings);
    std::visit([&json](const auto& result) { write_result(json, result); }, answer.result);
    json.end_object();
    stream << '\n';
}

}  // namespace nearfield::tools
