#include <tools/cli/help_formatter.hpp>
#include <tools/cli/query_options.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/io/query_request.hpp>

#include <array>
#include <initializer_list>
#include <memory>
#include <string>

namespace nearfield::tools {
namespace {

/// A kind of query as the help presents it.
struct QueryKind {
    QueryType type;
    const char* answer;   ///< one line in the help of `query`
    const char* example;  ///< the arguments after "nearfield query KIND"
};

constexpr std::array<QueryKind, 10> query_kinds{{
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
}};

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
        kind, "--units", arguments.unit, parse_length_unit,
        "The unit of coordinates read from SVG and DXF: user (user units as they are), or "
        "px, mm, cm, in, pt or pc, with viewBox, width and height (of DXF $INSUNITS) applied; "
        "default "
        "user")
        ->type_name("NAME");
    add_parsed_option(kind, "--fill-rule", arguments.treatment.fill_rule, parse_fill_rule,
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

void add_contact_options(CLI::App& kind, QueryRequest& request) {
    add_parsed_option(kind, "--contact-distance", request.contact_distance, parse_positive,
                      "Distance that counts as contact, world units, > 0; default the tolerance")
        ->type_name("D");
    add_parsed_option(kind, "--normals", request.normals, parse_normals,
                      "Source of the normals: analytic (the nearest feature) or gradient "
                      "(differences of the signed field); default analytic")
        ->type_name("NAME");
}

void add_field_options(CLI::App& kind, QueryArguments& arguments) {
    add_parsed_option(
        kind, "--rect", arguments.request.rectangle, parse_rectangle,
        "Extent of the grid, world units; default the common box of A and B grown by the tolerance")
        ->type_name("X0,Y0,X1,Y1");
    add_parsed_option(
        kind, "--gradient", arguments.gradient, parse_gradient,
        "Method of the gradients: analytic (from the nearest feature), central-differences, or "
        "blended (the whole image on the device, technique raster alone); default analytic")
        ->type_name("NAME");
    kind.add_option("--at", arguments.at,
                    "Reconstruct distance, sign and gradient at a point of the grid, world units; "
                    "repeatable; the JSON lists the points; default none")
        ->type_name("X,Y")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_motion_options(CLI::App& kind, QueryRequest& request) {
    add_parsed_option(
        kind, "--contact-distance", request.contact_distance, parse_positive,
        "Distance that counts as touching, world units, > 0; default 0: the shapes share a point")
        ->type_name("D");
    add_parsed_option(kind, "--time-bound", request.time_bound, parse_positive,
                      "Longest interval of time left open, > 0 and at most 1; the tolerance may "
                      "demand a shorter one; default 1")
        ->type_name("T");
    add_count_option(
        kind, "--most-steps", request.max_steps, {1, 1'000'000'000},
        "Limit of evaluations of the shapes; an answer that needs more says so; default 10000")
        ->type_name("N");
}

/// Options for the contents of an answer.
void add_answer_options(CLI::App& kind, QueryArguments& arguments, QueryType type) {
    kind.option_defaults()->group("Answer");
    switch (type) {
        case QueryType::penetration:
            add_parsed_option(kind, "--points", arguments.request.points, parse_points,
                              "boundary (samples along A's boundary, no gap wider than a grid "
                              "cell) or vertices (A's own); default boundary")
                ->type_name("NAME");
            break;
        case QueryType::intersection:
            add_parsed_option(kind, "--kind", arguments.request.kind, parse_kind,
                              "boundary-boundary, boundary-volume or volume-volume (of A and of "
                              "B); default volume-volume")
                ->type_name("NAME");
            break;
        case QueryType::distance_field:
            add_field_options(kind, arguments);
            break;
        case QueryType::contacts:
            add_contact_options(kind, arguments.request);
            break;
        case QueryType::time_of_impact:
            add_motion_options(kind, arguments.request);
            break;
        case QueryType::separation_vector:
            add_count_option(kind, "--most-work", arguments.request.max_work, {1, 1'000'000'000},
                             "Limit of edge tests; lower_bound states what the search left open; "
                             "default 10000000")
                ->type_name("N");
            break;
        case QueryType::closest_point:
        case QueryType::separation:
        case QueryType::intersection_test:
        case QueryType::containment:
            break;
    }
}

/// Options for the method.
void add_technique_options(CLI::App& kind, QueryArguments& arguments, QueryType type) {
    kind.option_defaults()->group("Technique");
    add_parsed_option(kind, "--technique", arguments.technique, parse_technique,
                      is_sampled(type)
                          ? "raster, compute, cpu or automatic; default automatic: cpu, and on a "
                            "GPU compute for large fields"
                          : "cpu or automatic, which are the same here: the CPU alone answers; "
                            "default automatic")
        ->type_name("NAME");
    add_parsed_option(kind, "--strategy", arguments.strategy, parse_strategy,
                      "The buffer that finds the samples: stencil, blend, logic-op or depth; all "
                      "find the same; nearfield info says which the device has; default stencil; "
                      "naming one asks for the raster")
        ->type_name("NAME");
    if (type == QueryType::distance_field) {
        add_parsed_option(kind, "--sign", arguments.sign, parse_sign,
                          "The buffer that says what lies inside: stencil, color (set to white) or "
                          "feature-bit (the top bit of the feature id); default stencil; naming "
                          "one asks for the raster")
            ->type_name("NAME");
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
        add_parsed_option(kind, "--show", arguments.request.picture, parse_picture,
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

}  // namespace nearfield::tools
