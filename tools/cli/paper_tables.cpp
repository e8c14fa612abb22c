#include <tools/benchmark/measuring.hpp>
#include <tools/benchmark/workloads.hpp>
#include <tools/cli/bench.hpp>
#include <tools/cli/options.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <tools/drawing/line_chart.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/output_file.hpp>
#include <tools/simulation/proximity.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/scenes.hpp>
#include <tools/simulation/world.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <ostream>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

/// Measures one technique on the bodies of a scene.
class Watch {
public:
    /// Without a context the technique counts as unavailable.
    Watch(std::optional<Context>& context, const simulation::Scene& scene, double tolerance,
          Technique technique) {
        if (context) {
            proximity_.emplace(*context, scene.bodies, tolerance, technique);
        }
    }

    /// Runs a frame's queries `times` times and keeps the minimum, which other load disturbs least.
    void ask(int times) {
        if (!proximity_) {
            return;
        }
        double least = 0.0;
        for (int i = 0; i < times; ++i) {
            proximity_->reset_count();
            points_now_ = 0;
            try {
                for (const auto& overlap : proximity_->overlaps()) {
                    points_now_ += overlap.first_in_second->count + overlap.second_in_first->count;
                }
            } catch (const LibraryError&) {
                proximity_.reset();
                return;
            }
            const double time = proximity_->count().milliseconds;
            least = i == 0 ? time : std::min(least, time);
        }
        milliseconds_ += least;
        points_ += static_cast<double>(points_now_);
        queries_ += static_cast<double>(proximity_->count().queries);
        ++frames_;
    }

    void report(QueryTimes& times, std::size_t technique) const {
        if (proximity_ && frames_ > 0.0) {
            times.milliseconds[technique] = milliseconds_ / frames_;
            times.points = points_ / frames_;
            times.queries = queries_ / frames_;
        }
    }

private:
    std::optional<simulation::Proximity> proximity_;  // empty if the technique is unavailable
    std::size_t points_now_ = 0;
    double milliseconds_ = 0.0;
    double points_ = 0.0;
    double queries_ = 0.0;
    double frames_ = 0.0;
};

}  // namespace

QueryStopwatch::QueryStopwatch(const Settings& settings) {
    for (const Technique technique : techniques_measured) {
        AskedTechniques asked;
        asked.add(technique);
        try {
            contexts_.emplace_back(open_context(settings, asked));
        } catch (const LibraryError&) {
            contexts_.emplace_back();
        }
    }
}

std::string QueryStopwatch::device_name() const {
    return contexts_.front() ? contexts_.front()->device_name() : std::string();
}

std::vector<QueryTimes> QueryStopwatch::measure_run(simulation::Scene scene,
                                                    const std::vector<double>& tolerances) {
    constexpr int frames = 240;
    constexpr int every = 12;  // one of this many frames is measured
    Context context = take(Context::create_cpu());
    simulation::World world(context, std::move(scene), simulation::Response::penalty,
                            Technique::cpu);
    std::vector<std::unique_ptr<Watch>> watches;  // by tolerance, then by technique
    for (const double tolerance : tolerances) {
        for (std::size_t i = 0; i < techniques_measured.size(); ++i) {
            watches.push_back(std::make_unique<Watch>(contexts_[i], world.scene(), tolerance,
                                                      techniques_measured[i]));
        }
    }
    for (int frame = 1; frame <= frames; ++frame) {
        static_cast<void>(world.advance());
        for (std::size_t i = 0; i < watches.size() && frame % every == 0; ++i) {
            watches[i]->ask(4);
        }
    }
    std::vector<QueryTimes> times(tolerances.size());
    for (std::size_t i = 0; i < watches.size(); ++i) {
        watches[i]->report(times[i / techniques_measured.size()], i % techniques_measured.size());
    }
    return times;
}

QueryTimes QueryStopwatch::measure_still(const simulation::Scene& scene) {
    QueryTimes times;
    for (std::size_t i = 0; i < techniques_measured.size(); ++i) {
        Watch watch(contexts_[i], scene, scene.tolerance, techniques_measured[i]);
        watch.ask(6);
        watch.report(times, i);
    }
    return times;
}

namespace {

/// Milliseconds from the paper: GeForce2, InfiniteReality2, ATI Rage Pro LT.
using PaperTimes = std::array<double, 3>;
constexpr std::array<PaperTimes, 5> paper_table_2{{{0.281, 0.901, 0.4344},
                                                   {0.015, 0.026, 0.064},
                                                   {0.020, 0.052, 0.038},
                                                   {0.007, 0.026, 0.015},
                                                   {1.030, 2.360, 2.990}}};
constexpr std::array<PaperTimes, 5> paper_table_3{{{0.710, 1.270, 5.560},
                                                   {0.315, 1.000, 1.850},
                                                   {0.211, 0.930, 0.895},
                                                   {0.176, 0.879, 0.631},
                                                   {0.165, 0.876, 0.535}}};
constexpr std::array<double, 5> tolerance_factors{0.25, 0.5, 1.0, 2.0, 4.0};
constexpr std::array<const char*, 5> tolerance_names{"d/4", "d/2", "d", "2d", "4d"};

/// A row of either of the two tables.
struct PaperRow {
    std::string name;
    std::size_t objects = 0;
    std::size_t lines = 0;
    double tolerance = 0.0;
    QueryTimes times;
    PaperTimes paper{};
};

/// The independent variable and the time.
struct GrowthPoint {
    double of = 0.0;
    QueryTimes times;
};

struct Measured {
    std::vector<PaperRow> table_2;
    std::vector<PaperRow> table_3;
    std::vector<GrowthPoint> lines;       ///< by total number of lines of two coasts
    std::vector<GrowthPoint> tolerances;  ///< by tolerance d
};

/// Shows the measurement that begins; Ctrl-C ends the program before it.
void show(const std::string& what) {
    static const StatusLine line;
    stop_after_ctrl_c();
    line.show(what);
}

std::vector<PaperRow> measure_table_2(QueryStopwatch& stopwatch) {
    std::vector<PaperRow> rows;
    for (const simulation::NamedScene& named : simulation::paper_scenes()) {
        show(std::string("table 2: ") + named.name);
        simulation::Scene scene = named.make();
        PaperRow row{named.name, scene.bodies.size(),       line_count(scene), scene.tolerance,
                     {},         paper_table_2[rows.size()]};
        row.times = stopwatch.measure_run(std::move(scene), {row.tolerance}).front();
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<PaperRow> measure_table_3(QueryStopwatch& stopwatch) {
    show("table 3: wavy");
    simulation::Scene scene = simulation::wavy_scene();
    std::vector<PaperRow> rows;
    std::vector<double> tolerances;
    for (std::size_t i = 0; i < tolerance_factors.size(); ++i) {
        tolerances.push_back(tolerance_factors[i] * scene.tolerance);
        rows.push_back({tolerance_names[i],
                        scene.bodies.size(),
                        line_count(scene),
                        tolerances.back(),
                        {},
                        paper_table_3[i]});
    }
    const std::vector<QueryTimes> times = stopwatch.measure_run(std::move(scene), tolerances);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].times = times[i];
    }
    return rows;
}

/// Two coasts of n lines each that overlap by a fifth of their size.
simulation::Scene two_coasts(std::size_t n, double tolerance) {
    simulation::Scene scene;
    for (const double side : {-0.8, 0.8}) {
        scene.bodies.push_back(std::make_unique<simulation::RigidBody>(
            std::vector<Ring>{benchmark::coast(side < 0.0 ? 1 : 2, n)}, Pose{{side, 0.0}}));
    }
    scene.tolerance = tolerance;
    return scene;
}

void measure_growth(QueryStopwatch& stopwatch, Measured& measured) {
    for (const std::size_t n : {50U, 158U, 500U, 1581U, 5000U, 15811U, 50000U}) {
        show("growth: " + std::to_string(2 * n) + " lines");
        measured.lines.push_back(
            {static_cast<double>(2 * n), stopwatch.measure_still(two_coasts(n, 0.01))});
    }
    for (const double d : {0.0003162, 0.001, 0.003162, 0.01, 0.03162, 0.1}) {
        show("growth: tolerance " + std::to_string(d));
        measured.tolerances.push_back({d, stopwatch.measure_still(two_coasts(500, d))});
    }
    show("");
}

std::string digits(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3f", number);
    return text.data();
}

std::string digits(const std::optional<double>& number) {
    return number ? digits(*number) : "refused";
}

void print_rows(std::ostream& stream, const std::vector<PaperRow>& rows) {
    for (const PaperRow& row : rows) {
        stream << "| " << row.name << " | " << row.objects << " | " << row.lines << " | "
               << digits(row.times.queries) << " | " << digits(row.times.points);
        for (const std::optional<double>& time : row.times.milliseconds) {
            stream << " | " << digits(time);
        }
        for (const double time : row.paper) {
            stream << " | " << digits(time);
        }
        stream << " |\n";
    }
}

void print_tables(std::ostream& stream, const Measured& measured,
                  const benchmark::Surroundings& surroundings) {
    constexpr auto header =
        " | objects | lines | queries | points | raster | compute | cpu | automatic | GeForce2 | "
        "InfiniteReality2 | ATI Rage Pro LT |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    write_surroundings(stream, surroundings);
    stream << "\n\n"
           << "Table 2: milliseconds of a frame's proximity queries (points inside each other, "
              "their depths and directions,\nfor every near pair both ways), on average over the "
              "simulation; the last three columns are the paper's.\n\n| demo"
           << header;
    print_rows(stream, measured.table_2);
    stream << "\nTable 3: wavy, by the tolerance; d is " << digits(measured.table_3[2].tolerance)
           << "\n\n| tolerance" << header;
    print_rows(stream, measured.table_3);
}

void write_times(JsonWriter& json, const QueryTimes& times) {
    json.member("queries", times.queries);
    json.member("points", times.points);
    json.key("ms").begin_object();
    for (std::size_t i = 0; i < techniques_measured.size(); ++i) {
        json.member(to_string(techniques_measured[i]), times.milliseconds[i]);
    }
    json.end_object();
}

void write_rows(JsonWriter& json, const char* name, const std::vector<PaperRow>& rows) {
    json.list(name, rows, [&json](const PaperRow& row) {
        json.begin_object();
        json.member("name", row.name);
        json.member("objects", row.objects);
        json.member("lines", row.lines);
        json.member("tolerance", row.tolerance);
        write_times(json, row.times);
        json.member("paper_ms", row.paper);
        json.end_object();
    });
}

void write_growth(JsonWriter& json, const char* name, const char* of,
                  const std::vector<GrowthPoint>& points) {
    json.list(name, points, [&](const GrowthPoint& point) {
        json.begin_object();
        json.member(of, point.of);
        write_times(json, point.times);
        json.end_object();
    });
}

void write_json(std::ostream& stream, const Measured& measured,
                const benchmark::Surroundings& surroundings) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    write_surroundings(json, surroundings);
    write_rows(json, "table_2", measured.table_2);
    write_rows(json, "table_3", measured.table_3);
    write_growth(json, "growth_with_lines", "lines", measured.lines);
    write_growth(json, "growth_with_tolerance", "tolerance", measured.tolerances);
    json.end_object();
    stream << '\n';
}

LineChart chart_of(const std::vector<GrowthPoint>& points, std::string title, std::string x_name) {
    constexpr std::array<Color, techniques_measured.size()> colors{rgb(0xC2185B), rgb(0x7B3FA0),
                                                                   rgb(0x14467C), rgb(0x5B6675)};
    LineChart chart{std::move(title), std::move(x_name), "milliseconds of a frame's queries", {}};
    for (std::size_t i = 0; i < techniques_measured.size(); ++i) {
        ChartLine line{to_string(techniques_measured[i]), colors[i], {}};
        for (const GrowthPoint& point : points) {
            if (point.times.milliseconds[i]) {
                line.points.push_back({point.of, *point.times.milliseconds[i]});
            }
        }
        chart.lines.push_back(std::move(line));
    }
    return chart;
}

std::string draw_curves(const Measured& measured) {
    Canvas canvas(1240, 480, palette::page);
    draw_line_chart(canvas, chart_of(measured.lines, "Two coasts, d = 0.01", "lines, together"),
                    {{0.0, 0.0}, {620.0, 480.0}});
    draw_line_chart(canvas,
                    chart_of(measured.tolerances, "Two coasts of 500 lines each", "tolerance d"),
                    {{620.0, 0.0}, {1240.0, 480.0}});
    return canvas.png();
}

}  // namespace

void run_paper_tables(const Settings& settings, const std::optional<std::string>& json,
                      const std::optional<std::string>& curves) {
    ReportTarget report(json);
    std::optional<OutputFile> picture;
    if (curves) {
        picture.emplace(*curves);
    }
    QueryStopwatch stopwatch(settings);
    Measured measured{measure_table_2(stopwatch), measure_table_3(stopwatch), {}, {}};
    if (json || curves) {
        measure_growth(stopwatch, measured);
    }
    show("");
    const benchmark::Surroundings surroundings =
        benchmark::surroundings_of(stopwatch.device_name());
    print_tables(report.summary(), measured, surroundings);
    if (picture) {
        picture->stream() << draw_curves(measured);
        picture->commit();
    }
    if (std::ostream* stream = report.json()) {
        write_json(*stream, measured, surroundings);
    }
    report.commit();
}

}  // namespace nearfield::tools
