#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/context/calibration.hpp>
#include <engine/geometry/polygon.hpp>
#include <engine/select/fit_cost.hpp>
#include <engine/select/work.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace nearfield {
namespace {

// A workload runs until it has taken this long or run this often; its median counts.
constexpr double longest_milliseconds = 60.0;
constexpr std::size_t max_frames = 15;
constexpr std::size_t fewest_frames = 3;

// Queries of the batch that separates the cost of a query from that of a submission.
constexpr std::size_t many_queries = 64;

/// A star of five rounded arms, about one in radius.
std::vector<Vector2> star(std::uint32_t vertices) {
    std::vector<Vector2> ring;
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / vertices;
        const double radius = 1.0 + 0.3 * std::cos(5.0 * angle);
        ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return ring;
}

constexpr std::uint32_t few_edges = 16;
constexpr std::uint32_t many_edges = 4096;

/// A shape in the context, and a copy for estimates.
struct Star {
    explicit Star(std::uint32_t vertices) : ring(star(vertices)) {
        const Ring rings[] = {Ring(ring)};
        const Status status = polygon.assign(rings);
        if (!status.ok()) {
            throw StatusException(status);
        }
    }

    std::vector<Vector2> ring;
    geometry::Polygon polygon;
    ShapeHandle handle;
};

/// A kind of work: a query at a tolerance, and the tolerances that yield few and many samples.
struct Kind {
    WorkCost TechniqueCost::*cost;
    double coarse;
    double fine;
    AnyQuery (*query)(ShapeHandle shape, double tolerance);
};

// Deeply overlapping, and separated; both rotated.
const Pose overlapping{{0.7, 0.2}, 0.4};
const Pose apart{{3.0, 0.5}, 0.4};
const Rectangle window{{-1.0, -1.0}, {1.0, 1.0}};

template <class Query>
Query pair(ShapeHandle shape, const Pose& pose, double tolerance) {
    Query query;
    query.a = {shape, {}};
    query.b = {shape, pose};
    query.tolerance = tolerance;
    return query;
}

AnyQuery points(ShapeHandle shape, double tolerance) {
    auto query = pair<PenetrationQuery>(shape, overlapping, tolerance);
    query.records = false;
    return query;
}

AnyQuery closest(ShapeHandle shape, double tolerance) {
    return pair<SeparationQuery>(shape, apart, tolerance);
}

AnyQuery intersection(ShapeHandle shape, double tolerance) {
    auto query = pair<IntersectionQuery>(shape, overlapping, tolerance);
    query.records = false;
    return query;
}

AnyQuery field(ShapeHandle shape, double tolerance) {
    auto query = pair<DistanceFieldQuery>(shape, {}, tolerance);
    query.rectangle = window;
    return query;
}

AnyQuery features(ShapeHandle shape, double tolerance) {
    auto query = pair<DistanceFieldQuery>(shape, {}, tolerance);
    query.rectangle = window;
    query.features = true;
    return query;
}

constexpr std::array<Kind, 5> kinds{{
    {&TechniqueCost::points, 0.2, 0.001, points},
    {&TechniqueCost::closest, 0.2, 0.2, closest},
    {&TechniqueCost::intersection, 0.2, 0.004, intersection},
    {&TechniqueCost::field, 0.2, 0.01, field},
    {&TechniqueCost::features, 0.2, 0.015, features},
}};

/// Runs workloads in a context.
class Calibration {
public:
    Calibration(Context& context, const std::function<void(double)>& progress)
        : context_(&context), progress_(&progress), few_(few_edges), many_(many_edges) {
        for (Star* star : {&few_, &many_}) {
            const Ring rings[] = {Ring(star->ring)};
            Expected<ShapeHandle> handle = context.add_shape(rings);
            if (!handle) {
                throw StatusException(handle.error());
            }
            star->handle = *handle;
        }
    }
    ~Calibration() {
        static_cast<void>(context_->remove_shape(few_.handle));
        static_cast<void>(context_->remove_shape(many_.handle));
    }
    Calibration(const Calibration&) = delete;
    Calibration& operator=(const Calibration&) = delete;

    CostModel run(const DeviceTechniques& techniques) {
        CostModel costs = context_->costs();
        count_ =
            kinds.size() * (1U + (techniques.raster ? 1U : 0U) + (techniques.compute ? 1U : 0U));
        if (techniques.raster) {
            costs.raster = measure(Technique::raster);
        }
        if (techniques.compute) {
            costs.compute = measure(Technique::compute);
        }
        costs.cpu = measure(Technique::cpu);
        return costs;
    }

private:
    struct KindTimes {
        double submission = 0.0;
        double query = 0.0;
        double edges = 0.0;
        double samples = 0.0;
    };

    TechniqueCost measure(Technique technique);
    KindTimes measure(Technique technique, const Kind& kind);
    double median_microseconds(Technique technique, AnyQuery query, std::size_t count);

    Context* context_;
    const std::function<void(double)>* progress_;
    Star few_;
    Star many_;
    Batch batch_;
    Results results_;
    std::size_t count_ = 0;  // of workloads to measure
    std::size_t measured_ = 0;
};

double Calibration::median_microseconds(Technique technique, AnyQuery query, std::size_t count) {
    batch_.clear();
    std::visit(
        [&](auto& asked) {
            asked.technique = technique;
            for (std::size_t i = 0; i < count; ++i) {
                batch_.add(asked);
            }
        },
        query);
    std::vector<double> times;
    const Stopwatch start;
    // The first frame warms up.
    for (std::size_t frame = 0; frame <= max_frames; ++frame) {
        const Status status = context_->run(batch_, results_);
        if (!status.ok()) {
            throw StatusException(status);
        }
        if (frame > 0) {
            times.push_back(results_.timings.total);
        }
        if (times.size() >= fewest_frames && start.milliseconds() > longest_milliseconds) {
            break;
        }
    }
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    return *middle * 1000.0;
}

Calibration::KindTimes Calibration::measure(Technique technique, const Kind& kind) {
    const double one = median_microseconds(technique, kind.query(few_.handle, kind.coarse), 1);
    const double many =
        median_microseconds(technique, kind.query(few_.handle, kind.coarse), many_queries);
    KindTimes times;
    times.query = std::max(0.0, many - one) / static_cast<double>(many_queries - 1);
    times.submission = std::max(0.0, one - times.query);
    times.edges = median_microseconds(technique, kind.query(many_.handle, kind.coarse), 1);
    times.samples = median_microseconds(technique, kind.query(few_.handle, kind.fine), 1);
    ++measured_;
    if (*progress_) {
        (*progress_)(static_cast<double>(measured_) / static_cast<double>(count_));
    }
    return times;
}

TechniqueCost Calibration::measure(Technique technique) {
    std::array<KindTimes, kinds.size()> times;
    std::array<double, kinds.size()> submissions{};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        times[i] = measure(technique, kinds[i]);
        submissions[i] = times[i].submission;
    }
    // Kinds differ in their passes, and this is a difference of two noisy times.
    std::sort(submissions.begin(), submissions.end());
    const double submission = submissions[kinds.size() / 2];
    TechniqueCost cost;
    cost.submission = submission;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const Kind& kind = kinds[i];
        const auto work = [&](const Star& star, double tolerance, double time) {
            const select::Work estimate =
                select::work_of(kind.query(star.handle, tolerance), &star.polygon, star.polygon);
            return select::MeasuredWork{estimate.edges, estimate.samples, time};
        };
        const auto alone = [&](double time) { return std::max(0.0, time - submission); };
        cost.*kind.cost = select::fit_cost(work(few_, kind.coarse, times[i].query),
                                           work(many_, kind.coarse, alone(times[i].edges)),
                                           work(few_, kind.fine, alone(times[i].samples)));
    }
    return cost;
}

}  // namespace

CostModel calibrate(Context& context, const DeviceTechniques& techniques,
                    const std::function<void(double)>& progress) {
    return Calibration(context, progress).run(techniques);
}

}  // namespace nearfield
