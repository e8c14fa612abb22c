#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/query_request.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace nearfield::tools {

std::optional<Technique> parse_technique_option(const std::optional<std::string>& name) {
    return name ? std::optional(parse_technique(*name, "--technique")) : std::nullopt;
}

void set_technique(Scene& scene, std::optional<Technique> technique) {
    for (SceneQuery& query : scene.queries) {
        query.request.technique = technique.value_or(query.request.technique);
    }
}

namespace {

/// True if swapping A and B does not change the answer: then one order suffices.
bool is_symmetric(QueryType type) {
    return type == QueryType::separation || type == QueryType::intersection_test ||
           type == QueryType::time_of_impact || type == QueryType::separation_vector;
}

/// A box that contains a shape throughout its motion from its pose to its end pose.
Rectangle swept_box(const SceneShape& shape, const SceneInstance& instance) {
    const Pose& start = instance.pose;
    const Pose end = instance.end_pose.value_or(start);
    constexpr double none = std::numeric_limits<double>::infinity();
    Rectangle box{{none, none}, {-none, -none}};
    const auto hold = [&box](Vector2 origin, Vector2 low, Vector2 high) {
        box.min = {std::min(box.min.x, origin.x + low.x), std::min(box.min.y, origin.y + low.y)};
        box.max = {std::max(box.max.x, origin.x + high.x), std::max(box.max.y, origin.y + high.y)};
    };
    for (const Ring& ring : shape.rings) {
        for (const Vector2 vertex : ring) {
            // A rotating shape stays within a circle about the origin of its coordinates.
            const double radius = std::hypot(vertex.x, vertex.y);
            const double cosine = std::cos(start.angle);
            const double sine = std::sin(start.angle);
            const Vector2 arm{cosine * vertex.x - sine * vertex.y,
                              sine * vertex.x + cosine * vertex.y};
            const bool turns = start.angle != end.angle;
            const Vector2 low = turns ? Vector2{-radius, -radius} : arm;
            const Vector2 high = turns ? Vector2{radius, radius} : arm;
            hold(start.translation, low, high);
            hold(end.translation, low, high);
        }
    }
    return box;
}

bool come_within(const Rectangle& a, const Rectangle& b, double reach) {
    return a.min.x - b.max.x <= reach && b.min.x - a.max.x <= reach && a.min.y - b.max.y <= reach &&
           b.min.y - a.max.y <= reach;
}

}  // namespace

SceneRunner::SceneRunner(const Scene& scene, std::string file, Context& context)
    : scene_(scene), file_(std::move(file)), context_(context) {
    for (const SceneShape& shape : scene_.shapes) {
        shapes_.push_back(take(context_.add_shape(shape.rings, shape.deviation), place_of(shape)));
    }
    for (const SceneInstance& instance : scene_.instances) {
        instances_.push_back({shapes_[instance.shape], instance.pose});
    }
}

SceneRunner::~SceneRunner() {
    for (const ShapeHandle shape : shapes_) {
        static_cast<void>(context_.remove_shape(shape));  // fails only for an unknown shape
    }
}

double SceneRunner::run_frame() {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t index = 0; index < shapes_.size(); ++index) {
        const SceneShape& shape = scene_.shapes[index];
        if (const Status status =
                context_.update_shape(shapes_[index], shape.rings, shape.deviation);
            !status.ok()) {
            require(status, place_of(shape));
        }
    }
    batch_.clear();
    entries_.clear();
    for (std::size_t query = 0; query < scene_.queries.size(); ++query) {
        if (scene_.queries[query].all_pairs) {
            add_all_pairs(query);
        } else {
            add(query, scene_.queries[query].a, scene_.queries[query].b);
        }
    }
    require(context_.run(batch_, results_), file_);
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(end - start).count();
}

void SceneRunner::add(std::size_t query, std::size_t a, std::size_t b) {
    const QueryRequest& request = scene_.queries[query].request;
    if (request.type == QueryType::time_of_impact) {
        QueryRequest moving = request;
        moving.end_a = scene_.instances[a].end_pose;
        moving.end_b = scene_.instances[b].end_pose;
        add_query(batch_, moving, instances_[a], instances_[b]);
    } else {
        add_query(batch_, request, instances_[a], instances_[b]);
    }
    entries_.push_back({query, a, b});
}

void SceneRunner::add_moving_pairs(std::size_t query) {
    const double reach = scene_.queries[query].request.contact_distance.value_or(0.0);
    std::vector<Rectangle> boxes;
    for (const SceneInstance& instance : scene_.instances) {
        boxes.push_back(swept_box(scene_.shapes[instance.shape], instance));
    }
    for (std::size_t a = 0; a < boxes.size(); ++a) {
        for (std::size_t b = a + 1; b < boxes.size(); ++b) {
            if (come_within(boxes[a], boxes[b], reach)) {
                add(query, a, b);
            }
        }
    }
}

void SceneRunner::add_all_pairs(std::size_t query) {
    const SceneQuery& all = scene_.queries[query];
    const QueryRequest& request = all.request;
    if (request.type == QueryType::time_of_impact) {
        add_moving_pairs(query);
        return;
    }
    const double reach = request.type == QueryType::contacts
                             ? request.contact_distance.value_or(request.tolerance)
                             : all.reach;
    const auto pairs = take(context_.find_pairs(instances_, reach), file_);
    for (const InstancePair& pair : pairs) {
        add(query, pair.first, pair.second);
        if (!is_symmetric(request.type)) {
            add(query, pair.second, pair.first);
        }
    }
}

void SceneRunner::require_results() const {
    for (std::size_t index = 0; index < results_.results.size(); ++index) {
        const Status& status = summary_of(results_.results[index]).status;
        if (!status.ok()) {
            require(status, file_ + ": queries[" + std::to_string(entries_[index].query) + "]");
        }
    }
}

std::vector<SceneAnswer> SceneRunner::answers() const {
    std::vector<SceneAnswer> answers;
    for (std::size_t index = 0; index < entries_.size(); ++index) {
        const Entry& entry = entries_[index];
        const SceneQuery& query = scene_.queries[entry.query];
        // The boxes may be within reach although the shapes are not.
        const auto* const separation = std::get_if<SeparationResult>(&results_.results[index]);
        if (query.all_pairs && separation != nullptr && separation->distance > query.reach) {
            continue;
        }
        answers.push_back({query.request, scene_.instances[entry.a].name,
                           scene_.instances[entry.b].name, results_.results[index]});
    }
    return answers;
}

std::string_view SceneRunner::technique() const {
    if (results_.results.empty()) {
        return "none";
    }
    const Technique first = summary_of(results_.results.front()).technique;
    const bool same = std::all_of(
        results_.results.begin(), results_.results.end(),
        [first](const AnyResult& result) { return summary_of(result).technique == first; });
    return same ? to_string(first) : "mixed";
}

std::string SceneRunner::place_of(const SceneShape& shape) const {
    return file_ + ": shapes." + shape.name;
}

}  // namespace nearfield::tools
