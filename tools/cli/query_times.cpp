#include <tools/cli/open_context.hpp>
#include <tools/cli/query_times.hpp>
#include <tools/common/library_error.hpp>
#include <tools/simulation/proximity.hpp>
#include <tools/simulation/world.hpp>

#include <algorithm>
#include <memory>
#include <utility>

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

const std::array<Technique, techniques_measured>& QueryStopwatch::techniques() {
    static constexpr std::array<Technique, techniques_measured> all{
        Technique::raster, Technique::compute, Technique::cpu, Technique::automatic};
    return all;
}

QueryStopwatch::QueryStopwatch(const Settings& settings) {
    for (const Technique technique : techniques()) {
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
        for (std::size_t i = 0; i < techniques_measured; ++i) {
            watches.push_back(
                std::make_unique<Watch>(contexts_[i], world.scene(), tolerance, techniques()[i]));
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
        watches[i]->report(times[i / techniques_measured], i % techniques_measured);
    }
    return times;
}

QueryTimes QueryStopwatch::measure_still(const simulation::Scene& scene) {
    QueryTimes times;
    for (std::size_t i = 0; i < techniques_measured; ++i) {
        Watch watch(contexts_[i], scene, scene.tolerance, techniques()[i]);
        watch.ask(6);
        watch.report(times, i);
    }
    return times;
}

}  // namespace nearfield::tools
