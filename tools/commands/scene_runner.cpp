#include <tools/commands/library_error.hpp>
#include <tools/commands/scene_runner.hpp>
#include <tools/input/query_request.hpp>
#include <tools/output/answer.hpp>

#include <chrono>
#include <cstddef>
#include <utility>

namespace nearfield::tools {

SceneRunner::SceneRunner(const Scene& scene, std::string file, Context& context)
    : scene_(scene), file_(std::move(file)), context_(context) {
    for (const SceneShape& shape : scene_.shapes) {
        shapes_.push_back(take(context_.add_shape(shape.rings), place_of(shape)));
    }
}

double SceneRunner::run_frame() {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t index = 0; index < shapes_.size(); ++index) {
        const SceneShape& shape = scene_.shapes[index];
        if (const Status status = context_.update_shape(shapes_[index], shape.rings);
            !status.ok()) {
            require(status, place_of(shape));
        }
    }
    batch_.clear();
    for (const SceneQuery& query : scene_.queries) {
        add_query(batch_, query.request, instance(query.a), instance(query.b));
    }
    require(context_.run(batch_, results_), file_);
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(end - start).count();
}

void SceneRunner::require_results() const {
    for (std::size_t index = 0; index < results_.results.size(); ++index) {
        require(summary_of(results_.results[index]).status,
                file_ + ": queries[" + std::to_string(index) + "]");
    }
}

Instance SceneRunner::instance(std::size_t index) const {
    const SceneInstance& entry = scene_.instances[index];
    return {shapes_[entry.shape], entry.pose};
}

std::string SceneRunner::place_of(const SceneShape& shape) const {
    return file_ + ": shapes." + shape.name;
}

}  // namespace nearfield::tools
