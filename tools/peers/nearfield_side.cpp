#include <tools/benchmark/milliseconds_of.hpp>
#include <tools/common/add_shape.hpp>
#include <tools/common/library_error.hpp>
#include <tools/peers/nearfield_side.hpp>

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

KeptTests::KeptTests(const Problem& problem, Context& context)
    : world_(tools::take(World::create(context))), intersects_(problem.scene.queries.size()) {
    std::vector<ShapeHandle> shapes;
    for (const tools::SceneShape& shape : problem.scene.shapes) {
        shapes.push_back(tools::take(tools::add_shape(context, shape.rings, shape.deviation)));
    }
    std::vector<InstanceHandle> instances;
    for (const tools::SceneInstance& instance : problem.scene.instances) {
        instances.push_back(
            tools::take(world_.add({.shape = shapes[instance.shape], .pose = instance.pose})));
    }
    for (const tools::SceneQuery& query : problem.scene.queries) {
        a_.push_back(instances[query.a]);
        b_.push_back(instances[query.b]);
    }
}

double KeptTests::run_frame() {
    Status status;
    const double milliseconds =
        benchmark::milliseconds_of([&] { status = world_.test_pairs(a_, b_, intersects_); });
    tools::require(status, "bench_peers");
    return milliseconds;
}

}  // namespace nearfield::peers
