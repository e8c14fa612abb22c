#include <tools/common/library_error.hpp>
#include <tools/common/world_runner.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace nearfield::tools {
namespace {

/// The number of groups that the bits of a category distinguish.
constexpr std::size_t groups_per_world = std::numeric_limits<std::uint32_t>::digits;

/// Makes the records of one kind those of an answer and returns them. Their memory is kept.
template <class Records>
Records& become(WorldRecords& records) {
    if (auto* const same = std::get_if<Records>(&records)) {
        return *same;
    }
    return records.emplace<Records>();
}

}  // namespace

WorldRunner::WorldRunner(const Scene& scene, Context& context, std::span<const ShapeHandle> shapes,
                         std::span<const Instance> instances, std::span<const std::size_t> sound)
    : scene_(scene), shapes_(shapes), instances_(instances), sound_(sound) {
    add_entries();
    for (std::size_t group = 0; group < groups_.size(); group += groups_per_world) {
        add_world(context, group);
    }
    for (Entry& entry : entries_) {
        if (entry.answer.request == nullptr) {
            continue;
        }
        const GroupedWorld& world = worlds_[entry.group / groups_per_world];
        entry.answer.instances = world.instances;
        if (entry.answer.request->except) {
            entry.filter.ignored = world.handles[*entry.answer.request->except];
        }
    }
}

void WorldRunner::add_entries() {
    entries_.resize(scene_.queries.size());
    for (std::size_t query = 0; query < entries_.size(); ++query) {
        const SceneQuery& asked = scene_.queries[query];
        if (!asked.problem.empty() || !asked.world) {
            continue;
        }
        Entry& entry = entries_[query];
        entry.answer.request = &*asked.world;
        entry.answer.scene = &scene_;
        std::vector<std::size_t> considered;
        if (asked.world->against) {
            const std::vector<std::size_t>& named = asked.world->against->instances;
            std::set_intersection(named.begin(), named.end(), sound_.begin(), sound_.end(),
                                  std::back_inserter(considered));
        } else {
            considered.assign(sound_.begin(), sound_.end());
        }
        entry.group = group_of(std::move(considered));
        entry.filter.mask = 1U << (entry.group % groups_per_world);
    }
}

std::size_t WorldRunner::group_of(std::vector<std::size_t> instances) {
    const auto found = std::find(groups_.begin(), groups_.end(), instances);
    const auto group = static_cast<std::size_t>(found - groups_.begin());
    if (found == groups_.end()) {
        groups_.push_back(std::move(instances));
    }
    return group;
}

/// Adds a world with the groups from a number on, as many as it distinguishes.
void WorldRunner::add_world(Context& context, std::size_t first_group) {
    const std::size_t count = std::min(groups_.size() - first_group, groups_per_world);
    std::vector<std::uint32_t> categories(scene_.instances.size(), 0);
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::size_t instance : groups_[first_group + i]) {
            categories[instance] |= 1U << i;
        }
    }
    GroupedWorld grouped{take(World::create(context)), {}, {}};
    grouped.handles.resize(scene_.instances.size());
    for (std::size_t i = 0; i < categories.size(); ++i) {
        if (categories[i] == 0) {
            continue;
        }
        WorldInstance instance;
        instance.shape = instances_[i].shape;
        instance.pose = instances_[i].pose;
        instance.user = i;
        instance.category = categories[i];
        const InstanceHandle handle = take(grouped.world.add(instance), scene_.instances[i].name);
        grouped.handles[i] = handle;
        grouped.instances.resize(
            std::max<std::size_t>(grouped.instances.size(), std::size_t{handle.index} + 1));
        grouped.instances[handle.index] = i;
    }
    worlds_.push_back(std::move(grouped));
}

Status WorldRunner::answer(std::size_t query, const Limits& limits) {
    Entry& entry = entries_[query];
    World& world = worlds_[entry.group / groups_per_world].world;
    switch (entry.answer.request->type) {
        case WorldQueryType::poses:
            return answer_poses(world, entry, limits);
        case WorldQueryType::nearest:
            return answer_nearest(world, entry, limits);
        case WorldQueryType::rays:
            return answer_rays(world, entry, limits);
        case WorldQueryType::cast:
            return answer_cast(world, entry, limits);
        case WorldQueryType::overlap:
            return answer_overlap(world, entry, limits);
    }
    return {};
}

ShapeHandle WorldRunner::shape_of(const Entry& entry) const {
    return shapes_[entry.answer.request->shape.value()];
}

Status WorldRunner::answer_poses(World& world, Entry& entry, const Limits& limits) const {
    const WorldRequest& request = *entry.answer.request;
    if (request.clearance) {
        auto& clearances = become<std::vector<Clearance>>(entry.answer.records);
        clearances.resize(request.poses.size());
        ClearanceQuery query;
        query.shape = shape_of(entry);
        query.filter = entry.filter;
        query.min_clearance = request.min_clearance;
        query.max_clearance = request.max_clearance;
        return world.find_clearances(query, request.poses, clearances, limits);
    }
    auto& intersects = become<std::vector<std::uint8_t>>(entry.answer.records);
    intersects.resize(request.poses.size());
    return world.test_poses({shape_of(entry), entry.filter}, request.poses, intersects, limits);
}

/// No more hits of a point are asked for than there can be.
std::uint32_t WorldRunner::wanted_hits(const Entry& entry) const {
    const WorldRequest& request = *entry.answer.request;
    const std::vector<std::size_t>& considered = groups_[entry.group];
    std::uint64_t most = considered.size();
    if (request.kind == NearestKind::edges) {
        most = 0;
        for (const std::size_t instance : considered) {
            for (const Ring& ring : scene_.shapes[scene_.instances[instance].shape].rings) {
                most += ring.size();
            }
        }
    }
    return static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(most, 1, std::max(request.count, 1U)));
}

/// Asks about some inputs at a time, so that memory grows with the hits that there are, not with
/// those that were wanted.
template <class Query, class Input, class Hit>
Status WorldRunner::write_nearest(World& world, const Query& query, std::span<const Input> inputs,
                                  const Limits& limits, std::vector<Hit>& scratch,
                                  NearestLists<Hit>& lists) {
    constexpr std::size_t hits_at_a_time = std::size_t{1} << 18U;
    lists.offsets.assign(1, 0);
    lists.hits.clear();
    const std::size_t part = std::max<std::size_t>(hits_at_a_time / query.count, 1);
    for (std::size_t first = 0; first < inputs.size(); first += part) {
        const auto asked = inputs.subspan(first, std::min(part, inputs.size() - first));
        scratch.resize(asked.size() * query.count);
        if (Status status = world.find_nearest(query, asked, scratch, limits); !status.ok()) {
            return status;
        }
        for (std::size_t i = 0; i < scratch.size(); ++i) {
            if (!(scratch[i].instance == InstanceHandle{})) {
                lists.hits.push_back(scratch[i]);
            }
            if ((i + 1) % query.count == 0) {
                lists.offsets.push_back(static_cast<std::uint32_t>(lists.hits.size()));
            }
        }
    }
    return {};
}

Status WorldRunner::answer_nearest(World& world, Entry& entry, const Limits& limits) {
    const WorldRequest& request = *entry.answer.request;
    if (request.shape && request.kind == NearestKind::edges) {
        const ShapeEdgeQuery query{shape_of(entry), entry.filter, wanted_hits(entry),
                                   request.max_distance};
        return write_nearest(world, query, std::span<const Pose>(request.poses), limits,
                             edges_near_shape_,
                             become<NearestLists<ShapeEdgeHit>>(entry.answer.records));
    }
    if (request.shape) {
        const ShapeNearestQuery query{shape_of(entry), entry.filter, wanted_hits(entry),
                                      request.max_distance};
        return write_nearest(world, query, std::span<const Pose>(request.poses), limits,
                             nearest_of_shape_,
                             become<NearestLists<Clearance>>(entry.answer.records));
    }
    const NearestQuery query{wanted_hits(entry), request.kind, request.max_distance, entry.filter};
    return write_nearest(world, query, std::span<const Vector2>(request.points), limits, nearest_,
                         become<NearestLists<NearestHit>>(entry.answer.records));
}

Status WorldRunner::answer_rays(World& world, Entry& entry, const Limits& limits) const {
    const WorldRequest& request = *entry.answer.request;
    if (request.all_hits) {
        return world.cast_rays(request.segments, become<RayHits>(entry.answer.records),
                               entry.filter, limits);
    }
    auto& hits = become<std::vector<RayHit>>(entry.answer.records);
    hits.resize(request.segments.size());
    return world.cast_rays(request.segments, hits, entry.filter, limits);
}

Status WorldRunner::answer_cast(World& world, Entry& entry, const Limits& limits) const {
    const WorldRequest& request = *entry.answer.request;
    auto& hits = become<std::vector<ShapeCastHit>>(entry.answer.records);
    hits.resize(request.sweeps.size());
    ShapeCastQuery query;
    query.shape = shape_of(entry);
    query.filter = entry.filter;
    query.tolerance = request.tolerance;
    query.contact_distance = request.contact_distance;
    return world.cast_shape(query, request.sweeps, hits, limits);
}

Status WorldRunner::answer_overlap(World& world, Entry& entry, const Limits& limits) const {
    const WorldRequest& request = *entry.answer.request;
    auto& lists = become<InstanceLists>(entry.answer.records);
    if (request.shape) {
        return world.find_overlaps({shape_of(entry), entry.filter}, request.poses, lists, limits);
    }
    if (!request.points.empty()) {
        return world.find_overlaps(std::span<const Vector2>(request.points), lists, entry.filter,
                                   limits);
    }
    return world.find_overlaps(std::span<const Rectangle>(request.rectangles), lists, entry.filter,
                               limits);
}

}  // namespace nearfield::tools
