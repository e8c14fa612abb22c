#include <tools/benchmark/measuring.hpp>
#include <tools/common/library_error.hpp>
#include <tools/simulation/clearance_scene.hpp>
#include <tools/simulation/nest.hpp>
#include <tools/simulation/robots.hpp>

#include <algorithm>
#include <utility>

namespace nearfield::simulation {
namespace {

template <class Scene>
std::unique_ptr<ClearanceScene> made(Context& context) {
    auto scene = std::make_unique<Scene>(context);
    scene->ask();
    return scene;
}

constexpr NamedClearanceScene scenes_of_clearances[] = {{"nest", made<Nest>},
                                                        {"robots", made<Robots>}};

std::size_t edges_of(const std::vector<Ring>& rings) {
    std::size_t count = 0;
    for (const Ring& ring : rings) {
        count += ring.size();
    }
    return count;
}

}  // namespace

std::span<const NamedClearanceScene> clearance_scenes() {
    return scenes_of_clearances;
}

ClearanceScene::ClearanceScene(Context& context, const Setting& setting)
    : context_(context),
      world_(tools::take(nearfield::World::create(context))),
      name_(setting.name),
      view_(setting.view),
      poses_a_path_(setting.poses_a_path),
      min_clearance_(setting.min_clearance),
      max_clearance_(setting.max_clearance) {}

ClearanceScene::~ClearanceScene() {
    for (const ShapeHandle& shape : shapes_) {
        [[maybe_unused]] const Status status = context_.remove_shape(shape);
    }
}

ShapeHandle ClearanceScene::add_shape(const std::vector<Ring>& rings) {
    return shapes_.emplace_back(tools::take(context_.add_shape(rings)));
}

void ClearanceScene::add_obstacle(std::vector<Ring> rings, const Pose& pose) {
    const ShapeHandle shape = add_shape(rings);
    const InstanceHandle instance =
        tools::take(world_.add({.shape = shape, .pose = pose, .user = obstacles_.size()}));
    obstacles_.push_back({std::move(rings), pose, shape, instance});
}

std::optional<std::size_t> ClearanceScene::obstacle_at(Vector2 point) {
    InstanceLists found;
    tools::require(world_.find_overlaps(std::span(&point, 1), found));
    if (found.instances.empty()) {
        return std::nullopt;
    }
    return tools::take(world_.instance(found.instances.back())).user;
}

void ClearanceScene::advance() {
    ++frames_;
    frame_.time = frame_time * static_cast<double>(frames_);
    move();
    ask();
}

ClearanceQuery ClearanceScene::query() const {
    ClearanceQuery query{.shape = shape_};
    query.min_clearance = min_clearance_;
    query.max_clearance = max_clearance_;
    return query;
}

WorldFilter ClearanceScene::filter() const {
    return {.ignored =
                moving_obstacle_ ? obstacles_[*moving_obstacle_].instance : InstanceHandle()};
}

void ClearanceScene::ask() {
    poses_.clear();
    list_poses(poses_);
    clearances_.resize(poses_.size());
    frame_.milliseconds = benchmark::milliseconds_of([this] {
        tools::require(world_.find_clearances(query(), poses_, clearances_, {.filter = filter()}));
    });
    least_.clear();
    frame_.free_paths = 0;
    for (std::size_t first = 0; first < poses_.size(); first += poses_a_path_) {
        std::size_t least = first;
        for (std::size_t pose = first; pose < first + poses_a_path_; ++pose) {
            least = clearances_[pose].distance < clearances_[least].distance ? pose : least;
        }
        least_.push_back(least);
        frame_.free_paths += clearances_[least].distance > 0.0 ? 1U : 0U;
    }
    frame_.pose = pose_;
    frame_.poses = poses_.size();
    frame_.paths = least_.size();
    frame_.best_path = best_path();
    frame_.clearance = clearance(frame_.best_path);
    frame_.neighbor.reset();
    if (frame_.clearance.instance != InstanceHandle{}) {
        frame_.neighbor = tools::take(world_.instance(frame_.clearance.instance)).user;
    }
}

std::span<const Pose> ClearanceScene::path(std::size_t path) const {
    return std::span(poses_).subspan(path * poses_a_path_, poses_a_path_);
}

std::size_t ClearanceScene::line_count() const {
    std::size_t count = moving_obstacle_ ? 0 : edges_of(mover());
    for (const Obstacle& obstacle : obstacles_) {
        count += edges_of(obstacle.rings);
    }
    return count;
}

}  // namespace nearfield::simulation
