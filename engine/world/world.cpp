// A world itself: its instances, and what its other members share.

#include <engine/batch/call_within.hpp>
#include <engine/world/checks.hpp>
#include <engine/world/world_state.hpp>

#include <string>
#include <utility>

namespace nearfield {

World::State::State(std::shared_ptr<Context::Implementation> of)
    : context(std::move(of)), jobs(context->jobs()), scratch(jobs.count()) {}

void World::State::prepare() {
    view().prepare();
}

void World::State::prepare(const WorldFilter& filter, const char* call) {
    instances.require_own(filter.ignored, call);
    prepare();
}

const geometry::Polygon& World::State::shape(ShapeHandle handle, const char* call) const {
    const geometry::Polygon* const polygon = context->shapes().find(handle);
    if (polygon == nullptr) {
        throw StatusException(context->shapes().errors().unknown(call, handle));
    }
    return *polygon;
}

World::World(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
World::World(Context& context) noexcept
    : state_(std::make_unique<State>(context.implementation_)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

Expected<World> World::create(Context& context) {
    return catch_to_expected(
        [&] { return World(std::make_unique<State>(context.implementation_)); });
}

Expected<InstanceHandle> World::add(const WorldInstance& instance) {
    return catch_to_expected([&] {
        static_cast<void>(state_->shape(instance.shape, "add"));
        if (Status bad_pose = queries::check_pose(instance.pose, "the instance"); !bad_pose.ok()) {
            refuse("add", bad_pose.message());
        }
        return state_->instances.add(instance);
    });
}

Status World::move(InstanceHandle instance, const Pose& pose) {
    return move(std::span(&instance, 1), std::span(&pose, 1));
}

Status World::move(std::span<const InstanceHandle> instances, std::span<const Pose> poses) {
    return catch_to_status([&] {
        require_moves("move", state_->instances, instances, poses);
        state_->instances.move(instances, poses);
    });
}

Status World::set_filter(InstanceHandle instance, std::uint32_t category, std::uint32_t mask) {
    return catch_to_status([&] {
        world::Instances& all = state_->instances;
        all.set_filter(all.find(instance, "set_filter"), category, mask);
    });
}

Status World::remove(InstanceHandle instance) {
    return catch_to_status([&] {
        world::Instances& all = state_->instances;
        all.remove(all.find(instance, "remove"));
    });
}

Expected<WorldInstance> World::instance(InstanceHandle instance) const {
    return catch_to_expected([&] {
        const world::Instances& all = state_->instances;
        return all[all.find(instance, "instance")];
    });
}

std::uint32_t World::size() const noexcept {
    return state_->instances.count();
}

std::uint64_t World::memory_use() const noexcept {
    return sizeof(State) + state_->instances.bytes();
}

void World::trim() noexcept {
    State& state = *state_;
    state.instances.trim();
    for (State::Job& job : state.scratch) {
        job = State::Job();
    }
    state.hilbert_order = {};
    state.ray_lists = {};
    state.instance_lists = {};
    state.rays = {};
    state.points = {};
    state.poses = {};
}

}  // namespace nearfield
