#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/context/calibration.hpp>
#include <engine/context/calibration_workloads.hpp>
#include <engine/plan/technique.hpp>
#include <engine/select/fit_cost.hpp>
#include <engine/select/work.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace nearfield {
namespace {

using calibration::kinds;
using calibration::Star;

// A workload runs until it has taken this long or run this often; its median counts.
constexpr double longest_milliseconds = 60.0;
constexpr std::size_t max_frames = 15;
constexpr std::size_t fewest_frames = 3;

// Of frames before a device is measured: GPUs raise their clock within this time.
constexpr double warm_up_milliseconds = 500.0;

// Queries of the batch that separates the cost of a query from that of a submission.
constexpr std::size_t many_queries = 64;

// Queries of the batch that tells what a device takes for each of several: one alone leaves much of
// a GPU idle.
constexpr std::size_t several_queries = 4;

/// The microseconds of a batch by one technique.
struct BatchTimes {
    double plan = 0.0;    ///< of the calling thread, up to and with the submission
    double device = 0.0;  ///< from then on until the calling thread saw its end
    double read = 0.0;    ///< of the calling thread; its answers, by Technique::cpu
    double total = 0.0;
};

constexpr std::array<double BatchTimes::*, 4> parts_of_times{&BatchTimes::plan, &BatchTimes::device,
                                                             &BatchTimes::read, &BatchTimes::total};

BatchTimes times_of(const Timings& timings) {
    constexpr double microseconds = 1000.0;
    return {
        .plan = microseconds * std::max(0.0, timings.total - timings.device - timings.decode),
        .device = microseconds * timings.device,
        .read = microseconds * timings.decode,
        .total = microseconds * timings.total,
    };
}

void add(Batch& batch, Technique technique, AnyQuery query, std::size_t count = 1) {
    std::visit(
        [&](auto& asked) {
            asked.technique = technique;
            for (std::size_t i = 0; i < count; ++i) {
                batch.add(asked);
            }
        },
        query);
}

Batch batch_of(Technique technique, const AnyQuery& query, std::size_t count = 1) {
    Batch batch;
    add(batch, technique, query, count);
    return batch;
}

void require(const Status& status) {
    if (!status.ok()) {
        throw StatusException(status);
    }
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

BatchTimes medians_of(const std::vector<BatchTimes>& frames) {
    BatchTimes medians;
    for (double BatchTimes::*const part : parts_of_times) {
        std::vector<double> times;
        times.reserve(frames.size());
        for (const BatchTimes& frame : frames) {
            times.push_back(frame.*part);
        }
        medians.*part = median_of(std::move(times));
    }
    return medians;
}

/// The times of a query alone, and of several.
struct QueryTimes {
    BatchTimes one;
    BatchTimes several;
};

/// The times of a kind of query by one technique.
struct KindTimes {
    BatchTimes one;            ///< query, hardly any work
    BatchTimes many;           ///< such queries
    BatchTimes shapes;         ///< as many, each of a shape of its own of some edges
    BatchTimes shape;          ///< as many of one such shape
    QueryTimes edges;          ///< queries of mostly edges
    QueryTimes samples;        ///< queries of mostly samples
    QueryTimes searches = {};  ///< queries of mostly searches, if there are any

    /// Of each further query of a batch.
    [[nodiscard]] double query(double BatchTimes::*part) const {
        return std::max(0.0, many.*part - one.*part) / static_cast<double>(many_queries - 1);
    }
    /// Of a batch of one query beside the query.
    [[nodiscard]] double once(double BatchTimes::*part) const {
        return std::max(0.0, one.*part - query(part));
    }
    /// Of each edge of a shape, whatever the number of queries that have it.
    [[nodiscard]] double shape_edge(double BatchTimes::*part) const {
        return std::max(0.0, shapes.*part - shape.*part) /
               static_cast<double>((many_queries - 1) * calibration::some_edges);
    }
    /// Of a query without what its batch takes once.
    [[nodiscard]] double alone(const QueryTimes& times, double BatchTimes::*part) const {
        if (part == &BatchTimes::device) {
            return std::max(0.0, times.several.*part - times.one.*part) /
                   static_cast<double>(several_queries - 1);
        }
        return std::max(0.0, times.one.*part - once(part));
    }
};

/// Nothing of a kind that the technique leaves to the CPU.
using AllTimes = std::array<std::optional<KindTimes>, kinds.size()>;

/// What a batch takes once: kinds differ in their passes, so it is the median of all kinds.
double once(const AllTimes& times, double BatchTimes::*part) {
    std::vector<double> all;
    for (const std::optional<KindTimes>& kind : times) {
        if (kind) {
            all.push_back(kind->once(part));
        }
    }
    return median_of(std::move(all));
}

/// Runs workloads in a context.
class Calibration {
public:
    Calibration(Context& context, const std::function<void(double)>& progress)
        : context_(&context),
          progress_(&progress),
          stars_(2 * many_queries + 1, Star(calibration::few_edges)),
          few_(stars_.front()),
          many_(stars_.back()) {
        std::fill_n(stars_.begin() + many_queries, many_queries, Star(calibration::some_edges));
        many_ = Star(calibration::many_edges);
        for (Star& star : stars_) {
            const Ring rings[] = {Ring(star.ring)};
            const Expected<ShapeHandle> handle = context.add_shape(rings);
            require(handle ? Status() : handle.error());
            star.handle = *handle;
        }
    }
    ~Calibration() {
        for (const Star& star : stars_) {
            static_cast<void>(context_->remove_shape(star.handle));
        }
    }
    Calibration(const Calibration&) = delete;
    Calibration& operator=(const Calibration&) = delete;

    CostModel measure(const DeviceTechniques& techniques) {
        CostModel costs = context_->costs();
        const bool has_device = techniques.raster || techniques.compute;
        count_ =
            kinds.size() * (1U + (techniques.raster ? 1U : 0U) + (techniques.compute ? 1U : 0U)) +
            (has_device ? 1U : 0U);
        if (techniques.raster) {
            costs.raster = measure_device(Technique::raster);
        }
        if (techniques.compute) {
            costs.compute = measure_device(Technique::compute);
        }
        const AllTimes by_cpu = measure(Technique::cpu);
        costs.cpu = {fit(by_cpu, &BatchTimes::plan), fit(by_cpu, &BatchTimes::read)};
        if (has_device) {
            costs.overlap =
                measure_overlap(techniques.compute ? Technique::compute : Technique::raster);
        }
        return costs;
    }

private:
    void run(const Batch& batch);
    void warm_up(Technique technique);
    template <std::size_t count>
    std::array<BatchTimes, count> median_times(const std::array<Batch, count>& batches);
    BatchTimes median_times(const Batch& batch) { return median_times<1>({batch})[0]; }
    void make_progress();
    [[nodiscard]] Batch all_of(std::size_t first_star, Technique technique,
                               const calibration::Kind& kind, double tolerance) const;
    QueryTimes query_times(Technique technique, const AnyQuery& query);
    AllTimes measure(Technique technique);
    DeviceCosts measure_device(Technique technique);
    double measure_overlap(Technique technique);
    [[nodiscard]] QueryCosts fit(const AllTimes& times, double BatchTimes::*part) const;

    Context* context_;
    const std::function<void(double)>* progress_;
    std::vector<Star> stars_;  // as many of few and of some edges, and one of many
    Star& few_;
    Star& many_;
    Results results_;
    std::size_t count_ = 0;  // of workloads to measure
    std::size_t measured_ = 0;
};

/// Runs a batch whose shapes have changed since the last one: nothing is kept from then.
void Calibration::run(const Batch& batch) {
    for (const Star& star : stars_) {
        const Ring rings[] = {Ring(star.ring)};
        require(context_->update_shape(star.handle, rings));
    }
    require(context_->run(batch, results_));
}

/// Runs queries of all kinds until the device has raised its clock.
void Calibration::warm_up(Technique technique) {
    Batch batch;
    for (const calibration::Kind& kind : kinds) {
        add(batch, technique, kind.query(many_.handle, kind.middle));
    }
    const Stopwatch start;
    while (start.milliseconds() < warm_up_milliseconds) {
        run(batch);
    }
}

/// Of each batch; they run in turns.
template <std::size_t count>
std::array<BatchTimes, count> Calibration::median_times(const std::array<Batch, count>& batches) {
    std::array<std::vector<BatchTimes>, count> frames;
    const Stopwatch start;
    // The first frames warm up.
    for (const Batch& batch : batches) {
        run(batch);
    }
    while (frames[0].size() < max_frames &&
           (frames[0].size() < fewest_frames ||
            start.milliseconds() < static_cast<double>(count) * longest_milliseconds)) {
        for (std::size_t i = 0; i < count; ++i) {
            run(batches[i]);
            frames[i].push_back(times_of(results_.timings));
        }
    }
    std::array<BatchTimes, count> medians;
    std::transform(frames.begin(), frames.end(), medians.begin(), medians_of);
    return medians;
}

void Calibration::make_progress() {
    ++measured_;
    if (*progress_) {
        (*progress_)(static_cast<double>(measured_) / static_cast<double>(count_));
    }
}

/// Many queries, each of a shape of its own.
Batch Calibration::all_of(std::size_t first_star, Technique technique,
                          const calibration::Kind& kind, double tolerance) const {
    Batch batch;
    for (std::size_t i = 0; i < many_queries; ++i) {
        add(batch, technique, kind.query(stars_[first_star + i].handle, tolerance));
    }
    return batch;
}

QueryTimes Calibration::query_times(Technique technique, const AnyQuery& query) {
    const BatchTimes one = median_times(batch_of(technique, query));
    return {one, technique == Technique::cpu
                     ? BatchTimes{}
                     : median_times(batch_of(technique, query, several_queries))};
}

AllTimes Calibration::measure(Technique technique) {
    AllTimes times;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const calibration::Kind& kind = kinds[i];
        const AnyQuery least = kind.query(few_.handle, kind.coarse);
        if (!plan::is_candidate(technique, least)) {
            make_progress();
            continue;
        }
        const AnyQuery some = kind.query(stars_[many_queries].handle, kind.middle);
        const auto [shapes, shape] =
            median_times<2>({all_of(many_queries, technique, kind, kind.middle),
                             batch_of(technique, some, many_queries)});
        times[i] = KindTimes{
            .one = median_times(batch_of(technique, least)),
            .many = median_times(all_of(0, technique, kind, kind.coarse)),
            .shapes = shapes,
            .shape = shape,
            .edges = query_times(technique, kind.query(many_.handle, kind.middle)),
            .samples = query_times(technique, kind.query(few_.handle, kind.fine)),
        };
        if (kind.searches) {
            times[i]->searches = query_times(technique, kind.query(many_.handle, kind.fine));
        }
        make_progress();
    }
    return times;
}

/// Of one part of the times: what a batch takes once is taken off.
QueryCosts Calibration::fit(const AllTimes& times, double BatchTimes::*part) const {
    QueryCosts costs;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (!times[i]) {
            continue;
        }
        const calibration::Kind& kind = kinds[i];
        const KindTimes& own = *times[i];
        // Both shapes of a query are one. Several queries of it tell what each of them takes of
        // the device, without the shape.
        const double shapes = part == &BatchTimes::device ? 0.0 : 1.0;
        const auto work = [&](const Star& star, double tolerance, double time, double shared) {
            const select::Work estimate =
                select::work_of(kind.query(star.handle, tolerance), &star.polygon, star.polygon);
            return select::MeasuredWork{estimate.edges, estimate.samples, estimate.searches,
                                        shared * star.polygon.size(), time};
        };
        costs.*kind.cost = select::fit_cost(
            {
                .least = work(few_, kind.coarse, own.query(part), 1.0),
                .edges = work(many_, kind.middle, own.alone(own.edges, part), shapes),
                .samples = work(few_, kind.fine, own.alone(own.samples, part), shapes),
                .searches = work(many_, kind.fine, own.alone(own.searches, part), shapes),
            },
            own.shape_edge(part));
    }
    return costs;
}

DeviceCosts Calibration::measure_device(Technique technique) {
    warm_up(technique);
    const AllTimes times = measure(technique);
    return {
        .submission = once(times, &BatchTimes::plan) + once(times, &BatchTimes::read),
        .latency = once(times, &BatchTimes::device),
        .plan = fit(times, &BatchTimes::plan),
        .device = fit(times, &BatchTimes::device),
        .read = fit(times, &BatchTimes::read),
    };
}

/// The part of the lesser work that the other one hides, where the CPU has about as much to do as
/// the device.
double Calibration::measure_overlap(Technique technique) {
    const Batch on_device =
        batch_of(technique, calibration::field(many_.handle, calibration::large_field));
    const AnyQuery small = calibration::field(few_.handle, calibration::small_field);
    const double one =
        median_times(batch_of(Technique::cpu, small, many_queries)).total / many_queries;
    const double as_many = median_times(on_device).device / one;
    const Batch on_cpu =
        batch_of(Technique::cpu, small, static_cast<std::size_t>(std::clamp(as_many, 1.0, 4096.0)));
    Batch on_both = on_cpu;
    add(on_both, technique, calibration::field(many_.handle, calibration::large_field));
    const auto [device, cpu, both] = median_times<3>({on_device, on_cpu, on_both});
    make_progress();
    return std::clamp((device.total + cpu.total - both.total) / std::min(device.device, cpu.total),
                      0.0, 1.0);
}

}  // namespace

CostModel calibrate(Context& context, const DeviceTechniques& techniques,
                    const std::function<void(double)>& progress) {
    return Calibration(context, progress).measure(techniques);
}

}  // namespace nearfield
