#include <tools/benchmark/measuring.hpp>
#include <tools/benchmark/workloads.hpp>
#include <tools/cli/bench.hpp>
#include <tools/cli/options.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/output_file.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {

using benchmark::Surroundings;
using benchmark::three_digits;

namespace {

constexpr std::string_view automatic_name = "automatic";
constexpr std::string_view technique_names[] = {"raster", "compute", "cpu", automatic_name};

FrameWork work_of(const Scene& scene, const SceneRunner& runner) {
    FrameWork work;
    work.queries = runner.query_count();
    work.vertices = benchmark::vertex_count(scene);
    for (const SceneAnswer& answer : runner.answers()) {
        work.found += std::visit(
            [](const auto& result) -> std::uint64_t {
                if constexpr (requires { result.count; }) {
                    return result.count;
                } else if constexpr (requires { result.inside; }) {
                    return result.inside ? 1 : 0;
                } else {
                    // Other answers than those of intersection tests are always found.
                    constexpr bool is_test =
                        std::is_same_v<decltype(result), const IntersectionTestResult&>;
                    return !is_test || result.intersects ? 1 : 0;
                }
            },
            answer.result);
        for (const Region& region : summary_of(answer.result).regions) {
            work.cells += std::uint64_t{region.width} * region.height;
        }
    }
    return work;
}

/// A technique under measurement in a row.
struct Entry {
    Entry(Scene row_scene, Technique technique, Context& context) : scene(std::move(row_scene)) {
        set_technique(scene, technique);
        runner.emplace(scene, to_string(technique), context);
    }

    double run_frame() {
        const double milliseconds = runner->run_frame();
        timings.push_back(runner->timings());
        return milliseconds;
    }

    Scene scene;
    std::optional<SceneRunner> runner;
    std::vector<Timings> timings;
};

/// The message of the error that an action throws; empty if it succeeds.
template <class Action>
std::string refusal_of(Action action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    } catch (const LibraryError& error) {
        return error.what();
    }
    return {};
}

/// Runs the first frame, which determines the work. Returns null, with the reason in `time`, if the
/// technique refuses.
std::unique_ptr<Entry> enter(const Scene& scene, Technique technique, Context& context,
                             TechniqueTime& time) {
    auto entry = std::make_unique<Entry>(scene, technique, context);
    time.refusal = refusal_of([&] {
        entry->run_frame();
        entry->runner->require_results();
    });
    if (!time.refusal.empty()) {
        return nullptr;
    }
    time.answered_by = entry->runner->technique();
    time.work = work_of(entry->scene, *entry->runner);
    return entry;
}

void summarize(const Entry& entry, const std::vector<double>& frames_ms, TechniqueTime& time) {
    time.frame_ms = benchmark::spread_of(frames_ms);
    time.timings = benchmark::median_timings(entry.timings, frames_ms.size());
}

/// Medians of a few frames of their own, since timestamps take time.
std::vector<PassTime> passes_of(const Scene& scene, Technique technique, Context& context) {
    constexpr std::size_t frames = 5;
    Entry entry(scene, technique, context);
    for (std::size_t frame = 0; frame < 1 + frames; ++frame) {
        entry.run_frame();
    }
    return benchmark::median_timings(entry.timings, frames).passes;
}

}  // namespace

std::optional<double> TechniqueTime::device_ms() const {
    if (timings.passes.empty()) {
        return std::nullopt;
    }
    return benchmark::sum_of(timings.passes);
}

const TechniqueTime* RowTimes::find(const std::string& technique) const {
    const auto place =
        std::find_if(techniques.begin(), techniques.end(),
                     [&](const TechniqueTime& time) { return time.technique == technique; });
    return place == techniques.end() || !place->refusal.empty() ? nullptr : &*place;
}

std::optional<double> RowTimes::automatic_to_best(double benchmark::Spread::*of) const {
    const TechniqueTime* const automatic = find(std::string(automatic_name));
    std::optional<double> best;
    for (const TechniqueTime& time : techniques) {
        if (time.refusal.empty() && time.technique != automatic_name) {
            best = std::min(best.value_or(time.frame_ms.*of), time.frame_ms.*of);
        }
    }
    return automatic != nullptr && best ? std::optional(automatic->frame_ms.*of / *best)
                                        : std::nullopt;
}

namespace {

/// All techniques, each with its own context, so that none benefits from or disturbs what another
/// keeps from frame to frame.
class TechniqueRace {
public:
    explicit TechniqueRace(const Settings& settings) {
        for (const std::string_view name : technique_names) {
            Runner runner{std::string(name),
                          parse_name<Technique>(std::string(name), "standard table"),
                          {},
                          {},
                          {}};
            AskedTechniques asked;
            asked.add(runner.technique);
            Settings with = settings;
            with.timestamps = true;
            Settings without = settings;
            without.timestamps = false;
            runner.missing = refusal_of([&] {
                runner.context.emplace(open_context(without, asked));
                runner.timed.emplace(open_context(with, asked));
            });
            runners_.push_back(std::move(runner));
        }
    }

    [[nodiscard]] RowTimes run(const benchmark::Row& row) {
        RowTimes times{row.name, {}};
        std::vector<std::unique_ptr<Entry>> entries;  // one per technique; null if it refuses
        std::vector<benchmark::Contender> contenders;
        const Scene scene = row.scene();
        for (Runner& runner : runners_) {
            TechniqueTime& time = times.techniques.emplace_back();
            time.technique = runner.name;
            time.refusal = runner.missing;
            entries.push_back(time.refusal.empty()
                                  ? enter(scene, runner.technique, *runner.context, time)
                                  : nullptr);
            if (Entry* const entry = entries.back().get()) {
                contenders.push_back({[entry] { return entry->run_frame(); }, {}});
            }
        }
        benchmark::measure(contenders, {});
        auto contender = contenders.begin();
        for (std::size_t index = 0; index < entries.size(); ++index) {
            if (entries[index] != nullptr) {
                summarize(*entries[index], (contender++)->frames_ms, times.techniques[index]);
                times.techniques[index].timings.passes =
                    passes_of(scene, runners_[index].technique, *runners_[index].timed);
            }
        }
        return times;
    }

    /// Empty if there is no device.
    [[nodiscard]] std::string device_name() const {
        const std::optional<Context>& first = runners_.front().context;
        return first ? first->device_name() : std::string();
    }

private:
    struct Runner {
        std::string name;
        Technique technique{};
        std::string missing;             ///< why there is no context
        std::optional<Context> context;  ///< empty if unavailable
        std::optional<Context> timed;    ///< another one, with timestamps
    };

    std::vector<Runner> runners_;
};

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

constexpr std::size_t name_width = 40;
constexpr std::size_t work_width = 34;
constexpr std::size_t cell_width = 38;

std::string work_text(const FrameWork& work) {
    return std::to_string(work.queries) + ", " + std::to_string(work.vertices) + ", " +
           std::to_string(work.cells) + " -> " + std::to_string(work.found);
}

/// The work of a row, from the technique that reports most: only some techniques draw grids.
FrameWork work_of_row(const RowTimes& row) {
    FrameWork most;
    for (const TechniqueTime& time : row.techniques) {
        if (time.refusal.empty() && (most.queries == 0 || time.work.cells > most.cells)) {
            most = time.work;
        }
    }
    return most;
}

void write_work(JsonWriter& json, const FrameWork& work) {
    json.member("queries", work.queries);
    json.member("vertices", work.vertices);
    json.member("cells", work.cells);
    json.member("found", work.found);
}

void write_technique(JsonWriter& json, const TechniqueTime& time) {
    json.key(time.technique);
    if (!time.refusal.empty()) {
        json.begin_object().member("refused", time.refusal).end_object();
        return;
    }
    json.begin_object(JsonWriter::Layout::lines);
    json.member("technique", time.answered_by);
    json.member("frames", time.frame_ms.count);
    json.member("median_ms", time.frame_ms.median);
    json.member("min_ms", time.frame_ms.least);
    json.member("quartiles_ms",
                std::array{time.frame_ms.lower_quartile, time.frame_ms.upper_quartile});
    json.member("gpu_ms", time.device_ms());
    write_work(json, time.work);
    write_timings(json, time.timings);
    json.end_object();
}

/// The table in Markdown, written row by row.
class TextTable {
public:
    /// Writes the lines above the rows.
    TextTable(std::ostream& stream, const Surroundings& surroundings) : stream_(stream) {
        write_surroundings(stream_, surroundings);
        stream_
            << "\n\n"
            << "Milliseconds of a whole frame, everything handed over anew: median (least; lower "
               "quartile - upper quartile);\n"
            << "gpu: of it on the device, by timestamps. Work: queries, vertices, grid cells -> "
               "found. The last column is the\n"
            << "median of automatic over that of the quickest other (and the same of the "
               "least).\n\n"
            << "| " << padded("row", name_width) << " | " << padded("work", work_width);
        for (const char* technique : {"raster", "compute", "cpu", "automatic"}) {
            stream_ << " | " << padded(technique, cell_width);
        }
        stream_ << " | chose | to best |\n|---|---|---|---|---|---|---|---|\n" << std::flush;
    }

    void add(const RowTimes& row) {
        stream_ << "| " << padded(row.name, name_width) << " | "
                << padded(work_text(work_of_row(row)), work_width);
        for (const TechniqueTime& time : row.techniques) {
            stream_ << " | " << padded(cell(time), cell_width);
        }
        const TechniqueTime* const automatic = row.find("automatic");
        const std::optional<double> ratio = row.automatic_to_best();
        const std::optional<double> least = row.automatic_to_best(&benchmark::Spread::least);
        stream_ << " | " << (automatic != nullptr ? automatic->answered_by : "") << " | "
                << (ratio && least ? three_digits(*ratio) + " (" + three_digits(*least) + ")" : "")
                << " |\n"
                << std::flush;
    }
    /// Writes the explanations of the refusals.
    void finish() {
        if (!refusals_.empty()) {
            stream_ << '\n';
        }
        for (std::size_t index = 0; index < refusals_.size(); ++index) {
            stream_ << '[' << index + 1 << "] " << refusals_[index] << '\n';
        }
    }

private:
    [[nodiscard]] std::string cell(const TechniqueTime& time) {
        if (!time.refusal.empty()) {
            auto place = std::find(refusals_.begin(), refusals_.end(), time.refusal);
            if (place == refusals_.end()) {
                place = refusals_.insert(refusals_.end(), time.refusal);
            }
            return "refused [" + std::to_string(place - refusals_.begin() + 1) + "]";
        }
        const benchmark::Spread& spread = time.frame_ms;
        const std::optional<double> device = time.device_ms();
        return three_digits(spread.median) + " (" + three_digits(spread.least) + "; " +
               three_digits(spread.lower_quartile) + " - " + three_digits(spread.upper_quartile) +
               ")" + (device ? " gpu " + three_digits(*device) : "");
    }

    std::ostream& stream_;
    std::vector<std::string> refusals_;  // distinct; rows refer to them by number
};

/// Writes the table as JSON with a final line feed.
void write_table_json(std::ostream& stream, std::span<const RowTimes> table,
                      const Surroundings& surroundings) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    write_surroundings(json, surroundings);
    json.member("driver", surroundings.driver);
    json.list("rows", table, [&json](const RowTimes& row) {
        json.begin_object(JsonWriter::Layout::lines);
        json.member("name", row.name);
        write_work(json, work_of_row(row));
        json.key("techniques").begin_object(JsonWriter::Layout::lines);
        for (const TechniqueTime& time : row.techniques) {
            write_technique(json, time);
        }
        json.end_object();
        json.member("automatic_to_best", row.automatic_to_best());
        json.member("automatic_to_best_least", row.automatic_to_best(&benchmark::Spread::least));
        json.end_object();
    });
    json.end_object();
    stream << '\n';
}

}  // namespace

void run_standard_table(const std::string& filter, const Settings& settings,
                        const std::optional<std::string>& json) {
    const std::vector<benchmark::Row> rows =
        benchmark::rows_with(filter, benchmark::standard_table());
    ReportTarget report(json);
    TechniqueRace race(settings);
    const Surroundings surroundings = benchmark::surroundings_of(race.device_name());
    TextTable text(report.summary(), surroundings);
    std::vector<RowTimes> table;
    for (const benchmark::Row& row : rows) {
        {
            const StatusLine line;
            line.show("row", table.size() + 1, rows.size(), row.name);
            stop_after_ctrl_c();
            table.push_back(race.run(row));
        }
        text.add(table.back());
    }
    text.finish();
    if (std::ostream* stream = report.json()) {
        write_table_json(*stream, table, surroundings);
    }
    report.commit();
}

}  // namespace nearfield::tools
