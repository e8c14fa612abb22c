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

namespace {

/// That of all queries of a problem that the task of penetrations poses; otherwise any.
PenetrationQuery penetration_of(const Problem& problem) {
    if (problem.task != Task::vertex_penetration) {
        return {};
    }
    Batch batch;
    tools::add_query(batch, problem.scene.queries.front().request, {}, {});
    return std::get<PenetrationQuery>(batch.queries().front());
}

constexpr PairTableOptions listed{.listed = true, .technique = Technique::cpu};

}  // namespace

KeptPairs::KeptPairs(const Problem& problem, Context& context)
    : problem_(problem),
      world_(tools::take(World::create(context))),
      tests_(IntersectionTestQuery{}, listed),
      penetrations_(penetration_of(problem), listed) {
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
}

double KeptPairs::run_frame() {
    PairTableBase& table = problem_.task == Task::vertex_penetration
                               ? static_cast<PairTableBase&>(penetrations_)
                               : static_cast<PairTableBase&>(tests_);
    return benchmark::milliseconds_of_short([&] {
        if (const Status status = world_.update(table, {.a = a_, .b = b_}); !status.ok()) {
            tools::require(status, "bench_peers");
        }
    });
}

void KeptPairs::require_same(const std::vector<const AnyResult*>& results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
        bool is_same = false;
        if (const auto* const test = std::get_if<IntersectionTestResult>(results[i])) {
            is_same = test->intersects == tests_.rows()[i].intersects;
        } else if (const auto* const penetration = std::get_if<PenetrationResult>(results[i])) {
            const PairRow<PenetrationQuery>& row = penetrations_.rows()[i];
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
