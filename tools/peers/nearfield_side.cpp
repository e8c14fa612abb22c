#include <tools/benchmark/milliseconds_of.hpp>
#include <tools/common/add_shape.hpp>
#include <tools/common/library_error.hpp>
#include <tools/io/query_request.hpp>
#include <tools/peers/nearfield_side.hpp>

#include <stdexcept>
#include <variant>

namespace nearfield::peers {
namespace {

Answer answer_of(const PenetrationResult& result) {
    return {result.count, result.count > 0 ? result.deepest.depth : 0.0, {}};
}

Answer answer_of(const SeparationResult& result) {
    return {0, result.distance, {}};
}

Answer answer_of(const IntersectionResult& result) {
    return {0, result.area, {}};
}

Answer answer_of(const DistanceFieldResult& result) {
    return {0, 0.0, result.values};
}

/// No problem contains other queries.
Answer answer_of(const ResultSummary& /*result*/) {
    return {};
}

}  // namespace

NearfieldSide::NearfieldSide(const Problem& problem, Context& context)
    : runner_(problem.scene, problem.name, context) {}

double NearfieldSide::run_frame(tools::FrameInput input) {
    const double milliseconds = runner_.run_frame(input);
    runner_.require_results();
    return milliseconds;
}

std::vector<Answer> NearfieldSide::answers() const {
    std::vector<Answer> answers;
    for (const AnyResult* const result : results()) {
        answers.push_back(std::visit([](const auto& any) { return answer_of(any); }, *result));
    }
    return answers;
}

std::vector<const AnyResult*> NearfieldSide::results() const {
    std::vector<const AnyResult*> results;
    for (const tools::SceneAnswer& answer : runner_.answers()) {
        results.push_back(&answer.result);
    }
    return results;
}

KeptPairs::KeptPairs(const Problem& problem, Context& context)
    : problem_(problem), world_(tools::take(World::create(context))) {
    const tools::Scene& scene = problem.scene;
    std::vector<ShapeHandle> shapes;
    for (const tools::SceneShape& shape : scene.shapes) {
        shapes.push_back(tools::take(tools::add_shape(context, shape.rings, shape.deviation)));
    }
    std::vector<InstanceHandle> instances;
    for (const tools::SceneInstance& instance : scene.instances) {
        instances.push_back(
            tools::take(world_.add({.shape = shapes[instance.shape], .pose = instance.pose})));
    }
    for (const tools::SceneQuery& query : scene.queries) {
        a_.push_back(instances[query.a]);
        b_.push_back(instances[query.b]);
    }
    if (problem.task == Task::vertex_penetration) {
        Batch batch;
        tools::add_query(batch, scene.queries.front().request, {}, {});
        query_ = std::get<PenetrationQuery>(batch.queries().front());
        rows_.resize(a_.size());
    } else {
        intersects_.resize(a_.size());
    }
}

double KeptPairs::run_frame() {
    const auto milliseconds_of_call = [](const auto& call) {
        return benchmark::milliseconds_of_short([&] {
            if (const Status status = call(); !status.ok()) {
                tools::require(status, "bench_peers");
            }
        });
    };
    return rows_.empty()
               ? milliseconds_of_call([&] { return world_.test_pairs(a_, b_, intersects_); })
               : milliseconds_of_call(
                     [&] { return world_.find_penetrations(query_, a_, b_, rows_); });
}

void KeptPairs::require_same(const std::vector<const AnyResult*>& results) const {
    for (std::size_t i = 0; i < results.size(); ++i) {
        bool is_same = false;
        if (const auto* const test = std::get_if<IntersectionTestResult>(results[i])) {
            is_same = test->intersects == (intersects_[i] != 0);
        } else if (const auto* const penetration = std::get_if<PenetrationResult>(results[i])) {
            const PairRow<PenetrationQuery>& row = rows_[i];
            is_same = row.status == StatusCode::ok && row.intersects == penetration->intersects &&
                      row.count == penetration->count &&
                      row.deepest.depth == penetration->deepest.depth;
        }
        if (!is_same) {
            throw std::runtime_error(problem_.name + ": a batch and a world differ in query " +
                                     std::to_string(i));
        }
    }
}

}  // namespace nearfield::peers
