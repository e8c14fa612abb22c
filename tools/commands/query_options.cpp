#include <tools/commands/query.hpp>
#include <tools/input/query_request.hpp>

#include <string>

namespace nearfield::tools {
namespace {

void add_field_options(CLI::App& command, QueryArguments& arguments) {
    command
        .add_option("--sign", arguments.sign,
                    "Of distance-field: which buffer says what lies inside: stencil, color (set to "
                    "white) or feature-bit (the top bit of the feature id); default "
                    "stencil; naming one asks for the raster")
        ->type_name("NAME");
    command
        .add_option("--gradient", arguments.gradient,
                    "Of distance-field: how gradients are found: analytic (from the nearest "
                    "feature), central-differences, or blended (the whole image on the device); "
                    "default analytic")
        ->type_name("NAME");
    command
        .add_option("--gradient-field", arguments.gradient_field,
                    "Of distance-field: write the gradient at every cell as float32 (height, "
                    "width, 2); it points to where the signed distance grows; default none")
        ->type_name("FILE.npy");
    command
        .add_option("--features", arguments.features,
                    "Of distance-field: write the nearest feature of B at every cell (the Voronoi "
                    "diagram) as uint32 (height, width): the index of an edge or, with bit 31 set, "
                    "of a vertex; default none")
        ->type_name("FILE.npy");
    command
        .add_option("--at", arguments.at,
                    "Of distance-field: reconstruct distance, sign and gradient at a place of the "
                    "grid; once a place, the JSON lists them as points; default none")
        ->type_name("X,Y")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("--show", arguments.show,
                    "Of distance-field: what the picture shows: field, voronoi (the nearest "
                    "features in false colour) or gradient; default field")
        ->type_name("NAME");
}

void add_motion_options(CLI::App& command, QueryArguments& arguments) {
    command
        .add_option("--end-pose-a", arguments.end_pose_a,
                    "Of time-of-impact: where A is at time 1; between times 0 and 1 place and "
                    "degrees (more than 360 for more than a turn) change evenly; default as "
                    "--pose-a: A stands still")
        ->type_name("X,Y,DEGREES");
    command
        .add_option("--end-pose-b", arguments.end_pose_b,
                    "Of time-of-impact: where B is at time 1; default as --pose-b")
        ->type_name("X,Y,DEGREES");
    command
        .add_option("--time-bound", arguments.time_bound,
                    "Of time-of-impact: how closely the time is to be known at the least, above 0 "
                    "and at most 1; the tolerance may ask for more: in the time left open nothing "
                    "moves farther than it; default 1")
        ->type_name("T");
    command
        .add_option("--most-steps", arguments.most_steps,
                    "Of time-of-impact: how often the shapes are looked at, at the most; an answer "
                    "that needs more says so; default 10000")
        ->type_name("N");
    command
        .add_option("--most-work", arguments.most_work,
                    "Of separation-vector: how many edges are held against each other, at the "
                    "most; lower_bound says what less of it leaves open; default 10000000")
        ->type_name("N");
}

/// What is asked, of which outlines, and where they stand.
void add_outline_options(CLI::App& command, QueryArguments& arguments) {
    command
        .add_option("query", arguments.type,
                    "penetration: how deep the boundary of A is inside B, and the way out;\n"
                    "intersection: the samples of a grid that lie in both;\n"
                    "distance-field: the signed distance to B over a grid, negative inside;\n"
                    "contacts: the points of either boundary that are close to the other, and "
                    "the normals of B there;\n"
                    "closest-point: the point of A that is closest to B;\n"
                    "separation: the least distance between A and B, and where it is;\n"
                    "intersection-test: whether A and B share a point;\n"
                    "time-of-impact: when A and B first touch on their way from their poses to "
                    "their end poses;\n"
                    "separation-vector: a short translation of A that separates it from B")
        ->required()
        ->each([](const std::string& name) { static_cast<void>(parse_query_type(name, "query")); });
    command.add_option("A", arguments.file_a, "Outline A: GeoJSON, WKT, SVG or SVG path data file")
        ->required();
    command.add_option("B", arguments.file_b, "Outline B: GeoJSON, WKT, SVG or SVG path data file")
        ->required();
    command
        .add_option("-d", arguments.tolerance,
                    "Tolerance, world units, > 0: half the diagonal of a grid cell; required but "
                    "for intersection-test, which is exact")
        ->type_name("TOLERANCE");
    command
        .add_option("--deviation", arguments.deviation,
                    "Of SVG: how far the polygons that stand for curves may be from them, world "
                    "units; A's and B's together at most a quarter of the tolerance; default a "
                    "sixteenth of it each")
        ->type_name("DEVIATION");
    command
        .add_option("--pose-a", arguments.pose_a,
                    "Where A stands: turned counter-clockwise by degrees about its origin, then "
                    "moved by world units; default 0,0,0")
        ->type_name("X,Y,DEGREES");
    command.add_option("--pose-b", arguments.pose_b, "Where B stands; default 0,0,0")
        ->type_name("X,Y,DEGREES");
}

/// What of an answer is wanted, and how it is found.
void add_answer_options(CLI::App& command, QueryArguments& arguments) {
    command
        .add_option(
            "--technique", arguments.technique,
            "raster, compute, cpu (only raster has blended gradients) or automatic; default "
            "automatic: whichever is quickest here, by what --costs says")
        ->type_name("NAME");
    command
        .add_option("--strategy", arguments.strategy,
                    "Of intersection: the buffer that finds the samples, stencil, blend, logic-op "
                    "or depth; all find the same; nearfield info says which the device has; "
                    "default stencil; naming one asks for the raster")
        ->type_name("NAME");
    command
        .add_option("--kind", arguments.kind,
                    "Of intersection: boundary-boundary, boundary-volume or volume-volume (of A "
                    "and of B); default volume-volume")
        ->type_name("NAME");
    command
        .add_option("--points", arguments.points,
                    "Of penetration: boundary (samples along A's boundary, no gap wider than a "
                    "grid cell) or vertices (A's own); default boundary")
        ->type_name("NAME");
    command
        .add_option("--contact-distance", arguments.contact_distance,
                    "Of contacts and time-of-impact: how close counts as contact, world units, > "
                    "0; default the tolerance, and of time-of-impact none: they share a point")
        ->type_name("D");
    command
        .add_option("--normals", arguments.normals,
                    "Of contacts: analytic (from the nearest feature) or gradient (from the "
                    "differences of the signed field); default analytic")
        ->type_name("NAME");
    command
        .add_option("--rect", arguments.rectangle,
                    "Of distance-field: what the grid covers, world units; default the common box "
                    "of A and B grown by the tolerance")
        ->type_name("X0,Y0,X1,Y1");
}

void add_output_options(CLI::App& command, QueryArguments& arguments) {
    command
        .add_option("--json", arguments.json,
                    "Write the answer as JSON; - for the standard output, the summary then goes "
                    "to the standard error; default none")
        ->type_name("FILE|-");
    command
        .add_option("--image", arguments.image, "Draw the answer, 1600 x 1200 pixels; default none")
        ->type_name("FILE.png");
    command
        .add_option("--field", arguments.field,
                    "Of distance-field: write the values, world units, as a NumPy array of "
                    "float32 (height, width), row 0 at the lowest y; default none")
        ->type_name("FILE.npy");
    command.add_flag("--tiles", arguments.tiles,
                     "Tell the tiles that the device was given, in the JSON and in the picture; "
                     "what the CPU answers has none");
}

}  // namespace

CLI::App* add_query_command(CLI::App& program, QueryArguments& arguments) {
    CLI::App* command = program.add_subcommand("query", "Answer one query between two outlines");
    add_outline_options(*command, arguments);
    add_answer_options(*command, arguments);
    add_settings_options(*command, arguments.settings);
    add_output_options(*command, arguments);
    add_field_options(*command, arguments);
    add_motion_options(*command, arguments);
    return command;
}

}  // namespace nearfield::tools
