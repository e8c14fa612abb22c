#include <nearfield/context.hpp>
#include <nearfield/diagnostics.hpp>
#include <nearfield/portable_math.hpp>

#include <tools/cli/options.hpp>
#include <tools/cli/query.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/drawing/figure.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/output_file.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nearfield::tools {
namespace {

std::vector<const CLI::App*> kinds_of(const CLI::App& query) {
    return query.get_subcommands([](const CLI::App*) { return true; });
}

bool is_kind(const CLI::App& query, const std::string& word) {
    const std::vector<const CLI::App*> kinds = kinds_of(query);
    return std::any_of(kinds.begin(), kinds.end(),
                       [&](const CLI::App* kind) { return kind->get_name() == word; });
}

bool is_option(const std::string& word) {
    return word.size() > 1 && word.front() == '-';
}

/// The option name in a word that begins with an option: "--json=FILE", "-d0.5".
std::string option_name(const std::string& word) {
    return word.starts_with("--") ? word.substr(0, word.find('=')) : word.substr(0, 2);
}

/// Finds an option of any kind; null if no kind has it.
const CLI::Option* find_option(const CLI::App& query, const std::string& name) {
    for (const CLI::App* const kind : kinds_of(query)) {
        if (const CLI::Option* const option = kind->get_option_no_throw(name)) {
            return option;
        }
    }
    return nullptr;
}

/// The number of words from `position` on that form an option and its values, as CLI11 counts them.
std::size_t option_length(const CLI::App& query, const std::vector<std::string>& words,
                          std::size_t position) {
    const std::string& word = words[position];
    const std::string name = option_name(word);
    const CLI::Option* const option = find_option(query, name);
    if (option == nullptr || option->get_items_expected_min() == 0) {
        return 1;
    }
    const std::size_t value = name.size() + (word.starts_with("--") ? 1 : 0);  // after the =
    std::size_t length = word.size() > value ? 1 : 2;
    while (option->get_allow_extra_args() && position + length < words.size() &&
           !is_option(words[position + length]) && !is_kind(query, words[position + length])) {
        ++length;
    }
    return length;
}

/// The position of the first word from `position` on that is neither an option nor an option's
/// value.
std::size_t find_argument(const CLI::App& query, const std::vector<std::string>& words,
                          std::size_t position) {
    while (position < words.size() && is_option(words[position])) {
        if (words[position] == "--") {
            return position + 1;
        }
        position += option_length(query, words, position);
    }
    return position;
}

std::string join(const std::vector<const CLI::App*>& kinds, const std::string& separator) {
    std::string names;
    for (const CLI::App* const kind : kinds) {
        names += (names.empty() ? "" : separator) + kind->get_name();
    }
    return names;
}

/// Rejects a word that is an option of other kinds only.
void refuse_foreign_option(const CLI::App& query, const CLI::App& kind, const std::string& word) {
    const std::string name = option_name(word);
    std::vector<const CLI::App*> owners = kinds_of(query);
    std::erase_if(owners, [&](const CLI::App* other) { return !other->get_option_no_throw(name); });
    if (!owners.empty() && !kind.get_option_no_throw(name)) {
        throw InputError(name + ": belongs to " + join(owners, " and ") + ", not to " +
                         kind.get_name());
    }
}

}  // namespace

std::vector<std::string> with_kind_first(const CLI::App& query, std::vector<std::string> words) {
    const auto command = std::find_if_not(words.begin(), words.end(), is_option);
    if (command == words.end() || *command != query.get_name()) {
        return words;
    }
    const auto first = static_cast<std::size_t>(command - words.begin()) + 1;
    const std::size_t kind = find_argument(query, words, first);
    if (kind < words.size()) {
        const auto place = [&](std::size_t index) {
            return words.begin() + static_cast<std::ptrdiff_t>(index);
        };
        std::rotate(place(first), place(kind), place(kind + 1));
    }
    return words;
}

void explain_refusal(const CLI::App& query) {
    // The words in place of the kind: a valid kind, and everything after it, would not remain here.
    const std::vector<std::string> rest = query.remaining();
    if (!rest.empty() && !is_option(rest.front())) {
        throw InputError("query: \"" + rest.front() + "\" is none of the kinds " +
                         join(kinds_of(query), ", "));
    }
    const std::vector<CLI::App*> chosen = query.get_subcommands();
    if (chosen.empty()) {
        throw InputError("query: a kind is required: one of " + join(kinds_of(query), ", "));
    }
    for (const std::string& word : chosen.front()->remaining()) {
        if (is_option(word)) {
            refuse_foreign_option(query, *chosen.front(), word);
        }
    }
}

namespace {

/// A kind of query as the help presents it.
struct QueryKind {
    QueryType type;
    const char* answer;   ///< one line in the help of `query`
    const char* example;  ///< the arguments after "nearfield query KIND"
};

constexpr auto query_kinds = std::to_array<QueryKind>({
    {QueryType::penetration, "How deep the boundary of A lies inside B, and the way out",
     "A.geojson B.wkt -d 0.8 --json - --image out.png"},
    {QueryType::contacts, "The points of either boundary near the other, and normals",
     "A.geojson B.wkt -d 0.5 --contact-distance 2 --json -"},
    {QueryType::intersection, "The samples of a grid that lie in both A and B",
     "A.geojson B.wkt -d 3 --kind boundary-volume"},
    {QueryType::separation, "The least distance between A and B, and where it is",
     "A.geojson B.wkt -d 1 --pose-b 430,30,20"},
    {QueryType::closest_point, "The point of A that is closest to B",
     "A.geojson B.wkt -d 1 --pose-b 430,30,20"},
    {QueryType::distance_field, "The signed distance to B over a grid, negative inside B",
     "A.svg B.wkt -d 1 --rect -9,-9,9,9 --field f.npy"},
    {QueryType::intersection_test, "Whether A and B share a point, up to rounding of vertices",
     "A.geojson B.wkt --pose-b 120,20,30"},
    {QueryType::time_of_impact, "When A and B first touch on the way to their end poses",
     "A.geojson B.wkt -d 0.01 --end-pose-a 400,0,90"},
    {QueryType::separation_vector, "A short translation of A that separates it from B",
     "A.geojson B.wkt -d 1 --pose-b 120,20,30"},
    {QueryType::containment, "Whether A lies inside B, and its clearance to B's boundary",
     "A.geojson B.wkt --pose-b 120,20,30"},
});
static_assert(query_kinds.size() == names<QueryType>.size());

/// The meaning of -d for a kind.
const char* describe_tolerance(QueryType type) {
    switch (type) {
        case QueryType::intersection_test:
        case QueryType::containment:
            return "Tolerance, world units, > 0: curves become edges that are off by at "
                   "most a sixteenth of it. It has no other use, since the answer holds up to the "
                   "rounding of vertices; default none";
        case QueryType::time_of_impact:
            return "Tolerance, world units, > 0: no two points of the shapes move by more than "
                   "this against each other in the time that is left open";
        case QueryType::separation_vector:
            return "Tolerance, world units, > 0: the search ends where the vector is known to be "
                   "no more than this longer than the shortest one";
        case QueryType::separation:
        case QueryType::closest_point:
            return "Tolerance, world units, > 0: half the diagonal of a grid cell, which "
                   "sampled_distance and unique depend on; the distance is exact; default a "
                   "thousandth of the longer side of A or B, or more for coordinates so large "
                   "that it would be lost. Curves need -d or --deviation";
        default:
            return "Tolerance, world units, > 0: half the diagonal of a grid cell";
    }
}

void add_input_options(CLI::App& kind, QueryArguments& arguments, QueryType type) {
    kind.option_defaults()->group("Input");
    kind.add_option("A", arguments.file_a,
                    "Outline A: GeoJSON, WKT, WKB, SVG, SVG path data or DXF; - reads the standard "
                    "input")
        ->required()
        ->type_name("FILE");
    kind.add_option("B", arguments.file_b, "Outline B: the same formats; - for one of the two")
        ->required()
        ->type_name("FILE");
    add_parsed_option(kind, "-d", arguments.request.tolerance, parse_positive,
                      describe_tolerance(type))
        ->type_name("TOLERANCE")
        ->required(!is_exact(type));
    add_parsed_option(kind, "--deviation", arguments.deviation, parse_positive,
                      "Largest deviation of the edges that replace curves and the round corners of "
                      "--offset, world units, > 0; A's and B's together at most a quarter of the "
                      "tolerance; default a sixteenth of it each")
        ->type_name("DEVIATION");
    add_parsed_option(
        kind, "--units", arguments.unit, parse_name<LengthUnit>,
        "The unit of coordinates read from SVG and DXF: user (user units as they are), or "
        "px, mm, cm, in, pt or pc, with viewBox, width and height (of DXF $INSUNITS) applied; "
        "default "
        "user")
        ->type_name("NAME");
    add_parsed_option(kind, "--fill-rule", arguments.treatment.fill_rule, parse_name<FillRule>,
                      "What the rings of A and B enclose: odd-even, nonzero, positive (a winding "
                      "number above 0), or union (of the polygons, each odd-even); edges inside "
                      "are no boundary; default odd-even, and no edge is changed; of SVG as each "
                      "element says (nonzero unless it does), and one over the other")
        ->type_name("NAME");
    add_parsed_option(kind, "--clean-width", arguments.treatment.clean_width, parse_positive,
                      "Drop rings, spikes and vertices that are no wider than this, world units, > "
                      "0; part of the deviation; default only rings that enclose nothing")
        ->type_name("W");
    add_parsed_option(kind, "--offset", arguments.treatment.offset, parse_nonzero,
                      "Grow A and B by this, world units, with round corners; negative: shrink; "
                      "the deviation of the corners is part of --deviation; default none")
        ->type_name("DISTANCE");
    kind.add_flag("--strict", arguments.treatment.strict,
                  "Refuse rings that enclose nothing; otherwise they are dropped, and listed on "
                  "the standard error");
}

void add_pose_options(CLI::App& kind, QueryArguments& arguments, QueryType type) {
    add_parsed_option(kind, "--pose-a", arguments.pose_a, parse_pose,
                      "Pose of A: rotation counter-clockwise about its origin by degrees, then "
                      "translation in world units; default 0,0,0")
        ->type_name("X,Y,DEGREES");
    add_parsed_option(kind, "--pose-b", arguments.pose_b, parse_pose, "Pose of B; default 0,0,0")
        ->type_name("X,Y,DEGREES");
    if (type == QueryType::time_of_impact) {
        add_parsed_option(kind, "--end-pose-a", arguments.end_pose_a, parse_pose,
                          "Pose of A at time 1; position and degrees (more than 360 for more than "
                          "a turn) change at a constant rate; default as --pose-a: A does not move")
            ->type_name("X,Y,DEGREES");
        add_parsed_option(kind, "--end-pose-b", arguments.end_pose_b, parse_pose,
                          "Pose of B at time 1; default as --pose-b: B does not move")
            ->type_name("X,Y,DEGREES");
    }
}

/// The option of a member, unless only scenes have it.
void add_member(CLI::App& kind, QueryRequest& request, const QueryMember& member) {
    if (!member.parse) {
        return;
    }
    std::string name = "--" + member.key;
    std::replace(name.begin(), name.end(), '_', '-');
    kind.add_option_function<std::string>(
            name,
            [&kind, &request, parse = member.parse, name](const std::string& text) {
                if (!is_help_asked(kind)) {
                    parse(request, text, name);
                }
            },
            member.help)
        ->type_name(member.form);
}

/// Options for the contents of an answer.
void add_answer_options(CLI::App& kind, QueryArguments& arguments, QueryType type) {
    kind.option_defaults()->group("Answer");
    for (const QueryMember& member : answer_members(type)) {
        add_member(kind, arguments.request, member);
    }
    if (type == QueryType::distance_field) {
        kind.add_option("--at", arguments.at,
                        "Reconstruct distance, sign and gradient at a point of the grid, world "
                        "units; repeatable; the JSON lists the points; default none")
            ->type_name("X,Y")
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }
}

/// Options for the method.
void add_technique_options(CLI::App& kind, QueryArguments& arguments, QueryType type) {
    kind.option_defaults()->group("Technique");
    for (const QueryMember& member : technique_members(type)) {
        add_member(kind, arguments.request, member);
    }
    add_settings_options(kind, arguments.settings);
}

/// Options for the outputs.
void add_output_options(CLI::App& kind, QueryArguments& arguments, QueryType type) {
    kind.option_defaults()->group("Output");
    kind.add_option("--json", arguments.json,
                    "Write the answer as JSON; - for the standard output, the summary then goes to "
                    "the standard error; default none")
        ->type_name("FILE|-");
    CLI::Option* const image =
        add_parsed_option(kind, "--image", arguments.image, parse_png_name,
                          "Draw the answer, 1600 x 1200 pixels; default none")
            ->type_name("FILE.png");
    if (type == QueryType::distance_field) {
        add_parsed_option(kind, "--show", arguments.request.picture, parse_name<FieldPicture>,
                          "Content of the picture: field, voronoi (the nearest features in false "
                          "colour) or gradient; default field")
            ->type_name("NAME")
            ->needs(image);
        kind.add_option("--field", arguments.field,
                        "Write the signed distances, world units, as a NumPy array of float32 "
                        "(height, width), row 0 at the lowest y; default none")
            ->type_name("FILE.npy");
        kind.add_option("--gradient-field", arguments.gradient_field,
                        "Write the gradient at every cell as float32 (height, width, 2); it points "
                        "to where the signed distance grows; default none")
            ->type_name("FILE.npy");
        kind.add_option("--features", arguments.features,
                        "Write the nearest feature of B at every cell (the Voronoi diagram) as "
                        "uint32 (height, width): the index of an edge or, with bit 31 set, of a "
                        "vertex; default none")
            ->type_name("FILE.npy");
    }
    kind.add_flag(
        "--tiles", arguments.tiles,
        "Add the tiles of the device to the JSON and to the picture; answers of the CPU have none");
}

/// Hides options in the help of a kind that accepts them but does not use them. They are accepted
/// so that the same command line works for all kinds.
void hide_options(CLI::App& kind, std::initializer_list<const char*> names) {
    for (const char* const name : names) {
        kind.get_option(name)->group("");
    }
}

void add_kind(CLI::App& query, QueryArguments& arguments, const QueryKind& description,
              const std::string& exit_statuses) {
    const std::string name(name_of(description.type));
    const QueryType type = description.type;
    CLI::App& kind = *query.add_subcommand(name, description.answer);
    kind.group("Kinds");
    kind.formatter(std::make_shared<HelpFormatter>(HelpStyle{.positionals = "Outlines"}));
    kind.footer("Example:\n  nearfield query " + name + ' ' + description.example + "\n\n" +
                exit_statuses);
    kind.preparse_callback([&arguments, type](std::size_t) { arguments.request.type = type; });
    add_input_options(kind, arguments, type);
    add_pose_options(kind, arguments, type);
    add_answer_options(kind, arguments, type);
    add_technique_options(kind, arguments, type);
    add_output_options(kind, arguments, type);
    if (type != QueryType::intersection) {
        hide_options(kind, {"--strategy"});
    }
    if (!is_sampled(type)) {
        hide_options(kind, {"--boxes", "--height", "--memory-limit", "--tiles"});
    }
}

}  // namespace

CLI::App* add_query_command(CLI::App& program, QueryArguments& arguments) {
    CLI::App* const query =
        program.add_subcommand("query", "Answer one query between two outlines");
    query->formatter(
        std::make_shared<HelpFormatter>(HelpStyle{.first_column = 20, .subcommand = "KIND"}));
    query->require_subcommand(1);
    query->footer(
        "nearfield query KIND --help lists the options of a kind. They may stand before\n"
        "the kind as well as after it.\n\n"
        "Example:\n  nearfield query penetration A.geojson B.wkt -d 0.8 --json -\n\n" +
        program.get_footer());
    for (const QueryKind& kind : query_kinds) {
        add_kind(*query, arguments, kind, program.get_footer());
    }
    return query;
}

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
