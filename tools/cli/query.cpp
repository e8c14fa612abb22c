#include <nearfield/context.hpp>
#include <nearfield/diagnostics.hpp>
#include <nearfield/portable_math.hpp>

#include <tools/cli/query.hpp>
#include <tools/cli/settings_options.hpp>
#include <tools/common/add_shape.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library_error.hpp>
#include <tools/drawing/figure.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/npy.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/output_file.hpp>
#include <tools/io/query_json.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/summary.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nearfield::tools {
namespace {

/// An outline in a query: its source file and pose.
struct PlacedOutline {
    std::string file;
    std::vector<Ring> rings;
    double deviation = 0.0;
    Pose pose;
};

/// Adds to a distance field query what the requested outputs need.
void complete_field_request(const QueryArguments& arguments, QueryRequest& request) {
    const auto shown = [&](FieldPicture picture) {
        return arguments.image && request.picture == picture;
    };
    request.features = arguments.features || shown(FieldPicture::voronoi);
    request.gradients = arguments.gradient_field || shown(FieldPicture::gradient);
    if (request.gradient && !request.gradients && request.at.empty()) {
        throw InputError(
            "--gradient: there is no gradient asked for; add --gradient-field, --at or --show "
            "gradient");
    }
    // The values of every cell are read back if an output shows them or if there is no other
    // output.
    request.values = arguments.field || shown(FieldPicture::field) ||
                     (!request.features && !request.gradients && request.at.empty());
}

QueryRequest make_request(const QueryArguments& arguments) {
    QueryRequest request = arguments.request;
    for (const std::string& point : arguments.at) {
        request.at.push_back(parse_point(point, "--at"));
    }
    if (arguments.end_pose_a) {
        request.end_a = to_end_pose(*arguments.end_pose_a, arguments.pose_a.degrees);
    }
    if (arguments.end_pose_b) {
        request.end_b = to_end_pose(*arguments.end_pose_b, arguments.pose_b.degrees);
    }
    if (request.type == QueryType::distance_field) {
        complete_field_request(arguments, request);
    }
    return request;
}

/// Says on the standard error what of the outline was dropped.
PlacedOutline place(const Outline& outline, double deviation, const OutlineTreatment& treatment,
                    const DegreesPose& pose) {
    ShapeRings rings = make_shape_rings(outline, deviation, treatment);
    if (!rings.note.empty()) {
        std::cerr << "nearfield: " << rings.note << '\n';
    }
    return {outline.file, std::move(rings.rings), rings.deviation, to_pose(pose)};
}

/// "-" is the standard input. Says on the standard error what of a file was skipped.
Outline read_and_note(const std::string& file, LengthUnit unit) {
    Outline outline = read_outline(file, unit);
    if (!outline.skipped.empty()) {
        std::cerr << "nearfield: " << skipped_note(outline) << '\n';
    }
    return outline;
}

/// How far edges may be off the curves of A and B, each, and off those of an offset.
double choose_deviation(const QueryArguments& arguments, const QueryRequest& request,
                        const Outline& a, const Outline& b) {
    if (!arguments.deviation) {
        const bool is_needed = needs_deviation(a, arguments.treatment) || b.curved();
        if (request.tolerance == 0.0 && is_needed) {
            throw InputError(
                "--deviation: required for curves and offsets where there is no tolerance");
        }
        return usual_deviation * request.tolerance;
    }
    return *arguments.deviation;
}

void check_files(const QueryArguments& arguments) {
    std::vector<std::string> inputs;
    for (const std::string& input : {arguments.file_a, arguments.file_b}) {
        if (input != "-") {
            inputs.push_back(input);
        }
    }
    std::vector<std::string> outputs;
    for (const auto& output : {arguments.json, arguments.image, arguments.field,
                               arguments.gradient_field, arguments.features}) {
        if (output) {
            outputs.push_back(*output);
        }
    }
    require_different_files(inputs, outputs);
}

std::vector<Ring> rings_at(const PlacedOutline& outline, const Pose& pose) {
    std::vector<Ring> rings = outline.rings;
    const auto [sine, cosine] = sine_cosine(pose.angle);
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex = {cosine * vertex.x - sine * vertex.y + pose.translation.x,
                      sine * vertex.x + cosine * vertex.y + pose.translation.y};
        }
    }
    return rings;
}

FigureShape figure_shape(const PlacedOutline& outline, const Pose& pose) {
    return {std::filesystem::path(outline.file).stem().string(), rings_at(outline, pose)};
}

/// Adds the positions of a moving shape at times other than the one the picture shows.
void add_motion_traces(const PlacedOutline& outline, const Pose& end, double time, Side of,
                       Figure& figure) {
    constexpr int between = 4;
    const Pose& start = outline.pose;
    if (start.translation == end.translation && start.angle == end.angle) {
        return;
    }
    const auto at = [&](double part) {
        const auto mix = [part](double from, double to) { return (1.0 - part) * from + part * to; };
        return Pose{{mix(start.translation.x, end.translation.x),
                     mix(start.translation.y, end.translation.y)},
                    mix(start.angle, end.angle)};
    };
    figure.traces.push_back({rings_at(outline, start), of, FigureTrace::Kind::start});
    for (int i = 1; i < between; ++i) {
        figure.traces.push_back(
            {rings_at(outline, at(time * i / between)), of, FigureTrace::Kind::on_the_way});
    }
    figure.traces.push_back({rings_at(outline, end), of, FigureTrace::Kind::end});
}

/// The shapes at the time of the answer, with their other positions.
Figure make_figure(const Answer& answer, const PlacedOutline& a, const PlacedOutline& b) {
    if (const auto* impact = std::get_if<TimeOfImpactResult>(&answer.result)) {
        Figure figure{answer, figure_shape(a, impact->pose_a), figure_shape(b, impact->pose_b)};
        const QueryRequest& request = answer.request;
        add_motion_traces(a, request.end_a.value_or(a.pose), impact->time, Side::a, figure);
        add_motion_traces(b, request.end_b.value_or(b.pose), impact->time, Side::b, figure);
        return figure;
    }
    Figure figure{answer, figure_shape(a, a.pose), figure_shape(b, b.pose)};
    const auto* way = std::get_if<SeparationVectorResult>(&answer.result);
    if (way != nullptr && way->length > 0.0) {
        Pose apart = a.pose;
        apart.translation.x += way->vector.x;
        apart.translation.y += way->vector.y;
        figure.traces.push_back({rings_at(a, apart), Side::a, FigureTrace::Kind::end});
    }
    return figure;
}

/// The field of B that is drawn behind the marks of a penetration query: it covers the right panel
/// at about pixel resolution, whatever the query's own tolerance.
DistanceFieldQuery background_query(const Rectangle& detail, const Instance& b) {
    constexpr double cells = 2.5e5;
    const double area = (detail.max.x - detail.min.x) * (detail.max.y - detail.min.y);
    DistanceFieldQuery query;
    query.b = b;
    query.tolerance = std::sqrt(area / cells / 2.0);  // half the diagonal of a cell
    query.rectangle = detail;
    return query;
}

/// Runs a batch of one query until it is answered; Ctrl-C cancels it. `subject` is for the message.
void run_one(Context& context, const Batch& batch, Results& results, const std::string& subject) {
    const InterruptibleCalls calls("queries answered");
    require(context.run(batch, results, calls.limits()), subject);
    const Status& status = summary_of(results.results.front()).status;
    if (status.code() == StatusCode::cancelled) {
        stop_after_ctrl_c();
    }
    require(status, subject);
}

std::string draw_answer(Context& context, const Answer& answer, const PlacedOutline& a,
                        const PlacedOutline& b) {
    Figure figure = make_figure(answer, a, b);
    Results background;
    if (const auto* field = std::get_if<DistanceFieldResult>(&answer.result)) {
        figure.field = field;
    } else if (answer.request.type == QueryType::penetration ||
               answer.request.type == QueryType::contacts) {
        // The field uses B's rings as they are, although its finer tolerance might call for a finer
        // tessellation of the curves.
        const Instance drawn{take(context.add_shape(b.rings), b.file), b.pose};
        Batch batch;
        const auto handle =
            batch.add(background_query(detail_rectangle(answer, figure.a, figure.b), drawn));
        run_one(context, batch, background, "the field of the picture");
        figure.field = &background[handle];
    }
    return draw_figure(figure);
}

/// Features as the file format encodes them.
std::vector<std::uint32_t> encoded(const std::vector<Feature>& features) {
    constexpr std::uint32_t vertex_bit = 1U << 31U;
    std::vector<std::uint32_t> ids;
    ids.reserve(features.size());
    for (const Feature& feature : features) {
        ids.push_back(feature.index | (feature.kind == Feature::Kind::vertex ? vertex_bit : 0U));
    }
    return ids;
}

/// The arrays of a distance field, each with its opened file.
struct FieldFiles {
    std::optional<OutputFile> values;
    std::optional<OutputFile> gradients;
    std::optional<OutputFile> features;

    explicit FieldFiles(const QueryArguments& arguments) {
        if (arguments.field) {
            values.emplace(*arguments.field);
        }
        if (arguments.gradient_field) {
            gradients.emplace(*arguments.gradient_field);
        }
        if (arguments.features) {
            features.emplace(*arguments.features);
        }
    }

    void write(const DistanceFieldResult& result) {
        if (values) {
            write_npy(values->stream(), std::span<const float>(result.values), result.width,
                      result.height);
            values->commit();
        }
        if (gradients) {
            write_npy_pairs(gradients->stream(), result.gradients, result.width, result.height);
            gradients->commit();
        }
        if (features) {
            const std::vector<std::uint32_t> ids = encoded(result.features);
            write_npy(features->stream(), std::span<const std::uint32_t>(ids), result.width,
                      result.height);
            features->commit();
        }
    }
};

void check_inputs(const QueryArguments& arguments) {
    if (arguments.file_a == "-" && arguments.file_b == "-") {
        throw InputError("A and B: only one of them can be -, the standard input");
    }
    if (arguments.treatment.strict && arguments.treatment.clean_width) {
        throw InputError("--strict: drops nothing, so it cannot stand beside --clean-width");
    }
}

}  // namespace

int run_query(const QueryArguments& arguments) {
    QueryRequest request = make_request(arguments);
    const Settings settings = parse_settings(arguments.settings);
    check_inputs(arguments);
    const Outline outline_a = read_and_note(arguments.file_a, arguments.unit);
    const Outline outline_b = read_and_note(arguments.file_b, arguments.unit);
    const double deviation = choose_deviation(arguments, request, outline_a, outline_b);
    const PlacedOutline a = place(outline_a, deviation, arguments.treatment, arguments.pose_a);
    const PlacedOutline b = place(outline_b, deviation, arguments.treatment, arguments.pose_b);
    if (request.tolerance == 0.0 && has_tolerance(request.type)) {
        request.tolerance = usual_tolerance({a.rings, a.deviation, a.pose.translation},
                                            {b.rings, b.deviation, b.pose.translation});
    }
    check_files(arguments);
    catch_ctrl_c();
    ReportTarget report(arguments.json);
    std::optional<OutputFile> image;
    FieldFiles field_files(arguments);
    if (arguments.image) {
        image.emplace(*arguments.image);
    }

    AskedTechniques asked;
    asked.add(request);
    Context context = open_context(settings, asked);
    const Instance instance_a{take(add_shape(context, a.rings, a.deviation), a.file), a.pose};
    const Instance instance_b{take(add_shape(context, b.rings, b.deviation), b.file), b.pose};
    Batch batch;
    add_query(batch, request, instance_a, instance_b);
    Results results;
    run_one(context, batch, results, {});
    const bool is_stopped = was_ctrl_c_pressed();

    std::vector<TileReport> tiles;
    if (arguments.tiles) {
        tiles = take(list_tiles(context));
    }
    const Answer answer{request, results.results.front(), results.timings, context.device_name(),
                        arguments.tiles ? &tiles : nullptr};
    if (image) {
        image->stream() << draw_answer(context, answer, a, b);
        image->commit();
    }
    if (const auto* field = std::get_if<DistanceFieldResult>(&answer.result)) {
        field_files.write(*field);
    }
    if (std::ostream* json = report.json()) {
        write_query_json(*json, answer);
    }
    write_summary(report.summary(), answer);
    report.commit();
    if (is_stopped) {
        std::cerr << "nearfield: stopped by Ctrl-C; the bounds are those found until then\n";
    }
    return is_stopped ? exit_status::stopped : exit_status::done;
}

}  // namespace nearfield::tools
