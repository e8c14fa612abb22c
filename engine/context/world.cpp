#include <engine/context/call_within.hpp>
#include <engine/context/implementation.hpp>
#include <engine/context/world_implementation.hpp>

#include <utility>

namespace nearfield {

World::World(std::unique_ptr<Implementation> implementation) noexcept
    : implementation_(std::move(implementation)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

Expected<World> World::create(Context& context) {
    std::unique_ptr<Implementation> implementation;
    Status status = catch_to_status(
        [&] { implementation = std::make_unique<Implementation>(*context.implementation_); });
    if (!status.ok()) {
        return status;
    }
    return World(std::move(implementation));
}

Expected<InstanceHandle> World::add(const WorldInstance& instance) {
    InstanceHandle handle;
    Status status = catch_to_status([&] { handle = implementation_->add(instance); });
    return status.ok() ? Expected<InstanceHandle>(handle) : status;
}

Status World::move(InstanceHandle instance, const Pose& pose) {
    return move(std::span(&instance, 1), std::span(&pose, 1));
}

Status World::move(std::span<const InstanceHandle> instances, std::span<const Pose> poses) {
    return catch_to_status([&] { implementation_->move(instances, poses); });
}

Status World::set_filter(InstanceHandle instance, std::uint32_t category, std::uint32_t mask) {
    return catch_to_status([&] { implementation_->set_filter(instance, category, mask); });
}

Status World::remove(InstanceHandle instance) {
    return catch_to_status([&] { implementation_->remove(instance); });
}

Expected<WorldInstance> World::instance(InstanceHandle instance) const {
    WorldInstance found;
    Status status = catch_to_status([&] { found = implementation_->instance(instance); });
    return status.ok() ? Expected<WorldInstance>(found) : status;
}

std::uint32_t World::size() const noexcept {
    return implementation_->size();
}

Status World::test_poses(const PoseTestQuery& query, std::span<const Pose> poses,
                         std::span<std::uint8_t> intersects, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->test_poses(query, poses, intersects); });
}

Status World::find_clearances(const ClearanceQuery& query, std::span<const Pose> poses,
                              std::span<Clearance> clearances, const Limits& limits) {
    return catch_within(limits,
                        [&] { implementation_->find_clearances(query, poses, clearances); });
}

Status World::find_nearest(const NearestQuery& query, std::span<const Vector2> points,
                           std::span<NearestHit> hits, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->find_nearest(query, points, hits); });
}

Status World::find_nearest(const ShapeNearestQuery& query, std::span<const Pose> poses,
                           std::span<Clearance> nearest, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->find_nearest(query, poses, nearest); });
}

Status World::find_nearest(const ShapeEdgeQuery& query, std::span<const Pose> poses,
                           std::span<ShapeEdgeHit> hits, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->find_nearest(query, poses, hits); });
}

Status World::cast_rays(std::span<const Segment> segments, std::span<RayHit> hits,
                        const WorldFilter& filter, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->cast_rays(segments, hits, filter); });
}

Status World::cast_rays(std::span<const Segment> segments, RayHits& hits, const WorldFilter& filter,
                        const Limits& limits) {
    return catch_within(limits, [&] { implementation_->cast_rays(segments, hits, filter); });
}

Status World::cast_shape(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                         std::span<ShapeCastHit> hits, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->cast_shape(query, sweeps, hits); });
}

Status World::find_overlaps(std::span<const Rectangle> rectangles, InstanceLists& lists,
                            const WorldFilter& filter, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->find_overlaps(rectangles, lists, filter); });
}

Status World::find_overlaps(std::span<const Vector2> points, InstanceLists& lists,
                            const WorldFilter& filter, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->find_overlaps(points, lists, filter); });
}

Status World::find_overlaps(const PoseTestQuery& query, std::span<const Pose> poses,
                            InstanceLists& lists, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->find_overlaps(query, poses, lists); });
}

std::uint64_t World::memory_use() const noexcept {
    return implementation_->bytes();
}

void World::trim() noexcept {
    implementation_->trim();
}

}  // namespace nearfield
