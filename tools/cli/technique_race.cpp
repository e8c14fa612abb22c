#include <tools/benchmark/median_timings.hpp>
#include <tools/benchmark/objects.hpp>
#include <tools/cli/open_context.hpp>
#include <tools/cli/technique_race.hpp>
#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/input_error.hpp>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

constexpr std::string_view automatic_name = "automatic";
constexpr std::string_view technique_names[] = {"raster", "compute", "cpu", automatic_name};

void add_result(FrameWork& work, const PenetrationResult& result) {
    work.found += result.count;
}
void add_result(FrameWork& work, const IntersectionResult& result) {
    work.found += result.count;
}
void add_result(FrameWork& work, const ContactResult& result) {
    work.found += result.count;
}
void add_result(FrameWork& work, const IntersectionTestResult& result) {
    work.found += result.intersects ? 1 : 0;
}
void add_result(FrameWork& work, const ContainmentResult& result) {
    work.found += result.inside ? 1 : 0;
}
/// Closest points, separations, fields, times of impact and separation vectors.
void add_result(FrameWork& work, const ResultSummary& /*result*/) {
    ++work.found;
}

FrameWork work_of(const Scene& scene, const SceneRunner& runner) {
    FrameWork work;
    work.queries = runner.query_count();
    work.vertices = benchmark::vertex_count(scene);
    for (const SceneAnswer& answer : runner.answers()) {
        std::visit([&](const auto& result) { add_result(work, result); }, answer.result);
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

TechniqueRace::TechniqueRace(const Settings& settings) {
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

RowTimes TechniqueRace::run(const benchmark::Row& row) {
    RowTimes times{row.name, {}};
    std::vector<std::unique_ptr<Entry>> entries;  // one per technique; null if it refuses
    std::vector<benchmark::Contender> contenders;
    const Scene scene = row.scene();
    for (Runner& runner : runners_) {
        TechniqueTime& time = times.techniques.emplace_back();
        time.technique = runner.name;
        time.refusal = runner.missing;
        entries.push_back(
            time.refusal.empty() ? enter(scene, runner.technique, *runner.context, time) : nullptr);
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

std::string TechniqueRace::device_name() const {
    const std::optional<Context>& first = runners_.front().context;
    return first ? first->device_name() : std::string();
}

}  // namespace nearfield::tools
