#include <tools/common/library.hpp>
#include <tools/simulation/proximity.hpp>

#include <algorithm>
#include <chrono>

namespace nearfield::simulation {
namespace {

/// Adds its lifetime to a count.
class Stopwatch {
public:
    explicit Stopwatch(double& milliseconds) : milliseconds_(milliseconds) {}
    ~Stopwatch() {
        const std::chrono::duration<double, std::milli> time =
            std::chrono::steady_clock::now() - start_;
        milliseconds_ += time.count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    double& milliseconds_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

Proximity::Proximity(Context& context, std::span<const std::unique_ptr<Body>> bodies,
                     double tolerance, Technique technique)
    : context_(context), bodies_(bodies), tolerance_(tolerance), technique_(technique) {
    for (const std::unique_ptr<Body>& body : bodies_) {
        instances_.push_back({tools::take(context_.add_shape(body->rings())), body->pose()});
    }
}

Proximity::~Proximity() {
    for (const Instance& instance : instances_) {
        [[maybe_unused]] const Status status = context_.remove_shape(instance.shape);
    }
}

void Proximity::place() {
    const Stopwatch watch(count_.milliseconds);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        instances_[i].pose = bodies_[i]->pose();
        if (bodies_[i]->deforms()) {
            tools::require(context_.update_shape(instances_[i].shape, bodies_[i]->rings()));
        }
    }
}

void Proximity::run() {
    const Stopwatch watch(count_.milliseconds);
    tools::require(context_.run(batch_, results_));
    count_.queries += batch_.queries().size();
    ++count_.batches;
    for (const AnyResult& result : results_.results) {
        tools::require(
            std::visit([](const auto& any) -> const ResultSummary& { return any; }, result).status);
    }
}

const std::vector<InstancePair>& Proximity::near_pairs(double reach) {
    place();
    {
        const Stopwatch watch(count_.milliseconds);
        const auto found = tools::take(context_.find_overlapping_boxes(instances_, reach));
        pairs_.assign(found.begin(), found.end());
    }
    std::erase_if(pairs_, [this](const InstancePair& pair) {
        return !bodies_[pair.first]->movable() && !bodies_[pair.second]->movable();
    });
    return pairs_;
}

void Proximity::fill_with_overlaps(Batch& batch) {
    batch.clear();
    PenetrationQuery query;
    query.tolerance = tolerance_;
    query.technique = technique_;
    for (const InstancePair& pair : near_pairs(0.0)) {
        query.a = instances_[pair.first];
        query.b = instances_[pair.second];
        batch.add(query);
        std::swap(query.a, query.b);
        batch.add(query);
    }
}

const std::vector<Proximity::Overlap>& Proximity::overlaps() {
    fill_with_overlaps(batch_);
    run();
    overlaps_.clear();
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
        const auto& first = results_[QueryHandle<PenetrationQuery>{2 * i}];
        const auto& second = results_[QueryHandle<PenetrationQuery>{2 * i + 1}];
        if (first.count > 0 || second.count > 0) {
            overlaps_.push_back({pairs_[i], &first, &second});
        }
    }
    return overlaps_;
}

const std::vector<double>& Proximity::distances(std::span<const InstancePair> pairs) {
    place();
    batch_.clear();
    SeparationQuery query;
    query.tolerance = tolerance_;
    query.technique = technique_;
    for (const InstancePair& pair : pairs) {
        query.a = instances_[pair.first];
        query.b = instances_[pair.second];
        batch_.add(query);
    }
    run();
    distances_.clear();
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
        const SeparationResult& result = results_[QueryHandle<SeparationQuery>{i}];
        distances_.push_back(result.intersects ? 0.0 : result.distance);
    }
    return distances_;
}

const std::vector<const TimeOfImpactResult*>& Proximity::impacts(
    std::span<const Approach> approaches, std::span<const Pose> ends) {
    place();
    batch_.clear();
    TimeOfImpactQuery query;
    // Bodies stop before they reach the minimum distance, early by at most this tolerance.
    query.tolerance = tolerance_ / 32.0;
    for (const Approach& approach : approaches) {
        query.a = instances_[approach.pair.first];
        query.b = instances_[approach.pair.second];
        query.end_a = ends[approach.pair.first];
        query.end_b = ends[approach.pair.second];
        query.contact_distance = approach.least;
        batch_.add(query);
    }
    run();
    impacts_.clear();
    for (std::uint32_t i = 0; i < approaches.size(); ++i) {
        impacts_.push_back(&results_[QueryHandle<TimeOfImpactQuery>{i}]);
    }
    return impacts_;
}

const std::vector<Proximity::Touching>& Proximity::contacts(double contact_distance) {
    batch_.clear();
    ContactQuery query;
    query.tolerance = tolerance_;
    query.contact_distance = contact_distance;
    query.technique = technique_;
    for (const InstancePair& pair : near_pairs(contact_distance)) {
        query.a = instances_[pair.first];
        query.b = instances_[pair.second];
        batch_.add(query);
    }
    run();
    touching_.clear();
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
        const ContactResult& result = results_[QueryHandle<ContactQuery>{i}];
        if (result.count > 0) {
            touching_.push_back({pairs_[i], &result});
        }
    }
    return touching_;
}

}  // namespace nearfield::simulation
