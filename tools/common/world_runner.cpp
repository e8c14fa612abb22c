#include <tools/common/library.hpp>
#include <tools/common/world_runner.hpp>
#include <tools/io/world_request.hpp>

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

Status WorldRunner::answer(std::size_t query, const Limits& limits, Timings& timings) {
    Entry& entry = entries_[query];
    const WorldOptions options{.filter = entry.filter,
                               .limits = limits,
                               .technique = answering_technique(*entry.answer.request)};
    const Call call{worlds_[entry.group / groups_per_world], options, timings};
    switch (entry.answer.request->type) {
        case WorldQueryType::poses:
            return answer_poses(call, entry);
        case WorldQueryType::nearest:
            return answer_nearest(call, entry);
        case WorldQueryType::rays:
            return answer_rays(call, entry);
        case WorldQueryType::cast:
            return answer_cast(call, entry);
        case WorldQueryType::overlap:
            return answer_overlap(call, entry);
    }
    return {};
}

ShapeHandle WorldRunner::shape_of(const Entry& entry) const {
    return shapes_[entry.answer.request->shape.value()];
}

/// Halves the parts until one submission takes them: how many that are depends on memory.
template <class Input, class Output, class Submit>
Status WorldRunner::ask_device(ByDevice& by, const Call& call, std::span<const Input> inputs,
                               std::span<Output> outputs, const Submit& submit) {
    for (std::size_t first = 0; first < inputs.size();) {
        const std::size_t count = std::min(by.part, inputs.size() - first);
        Status status = submit(by.request, inputs.subspan(first, count));
        if (status.ok()) {
            status = by.request.collect(outputs.subspan(first, count), call.options.limits);
        }
        if (status.code() == StatusCode::too_large && count > 1) {
            by.part = count / 2;
            continue;
        }
        if (!status.ok()) {
            return status;
        }
        add_timings(by.request.timings(), call.timings);
        first += count;
    }
    return {};
}

Status WorldRunner::answer_poses(const Call& call, Entry& entry) const {
    const WorldRequest& request = *entry.answer.request;
    World& world = call.world.world;
    if (request.clearance) {
        auto& clearances = become<std::vector<Clearance>>(entry.answer.records);
        clearances.resize(request.poses.size());
        ClearanceQuery query;
        query.shape = shape_of(entry);
        query.min_clearance = request.min_clearance;
        query.max_clearance = request.max_clearance;
        return world.find_clearances(query, request.poses, clearances, call.options);
    }
    auto& intersects = become<std::vector<std::uint8_t>>(entry.answer.records);
    intersects.resize(request.poses.size());
    const ShapeHandle shape = shape_of(entry);
    if (call.options.technique == Technique::cpu) {
        return world.test_poses(shape, request.poses, intersects, call.options);
    }
    return ask_device(call.world.tests, call, std::span<const Pose>(request.poses),
                      std::span(intersects), [&](nearfield::WorldRequest& by, auto poses) {
                          return world.submit(by, shape, poses, call.options);
                      });
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
template <class Input, class Hit, class Find>
Status WorldRunner::write_nearest(std::span<const Input> inputs, std::uint32_t count,
                                  std::vector<Hit>& scratch, NearestLists<Hit>& lists,
                                  const Find& find) {
    constexpr std::size_t hits_at_a_time = std::size_t{1} << 18U;
    lists.offsets.assign(1, 0);
    lists.hits.clear();
    const std::size_t part = std::max<std::size_t>(hits_at_a_time / count, 1);
    for (std::size_t first = 0; first < inputs.size(); first += part) {
        const auto asked = inputs.subspan(first, std::min(part, inputs.size() - first));
        scratch.resize(asked.size() * count);
        if (Status status = find(asked, std::span(scratch)); !status.ok()) {
            return status;
        }
        for (std::size_t i = 0; i < scratch.size(); ++i) {
            if (!(scratch[i].instance == InstanceHandle{})) {
                lists.hits.push_back(scratch[i]);
            }
            if ((i + 1) % count == 0) {
                lists.offsets.push_back(static_cast<std::uint32_t>(lists.hits.size()));
            }
        }
    }
    return {};
}

Status WorldRunner::answer_nearest(const Call& call, Entry& entry) {
    const WorldRequest& request = *entry.answer.request;
    World& world = call.world.world;
    const std::uint32_t count = wanted_hits(entry);
    const auto by_cpu = [&](const auto& query) {
        return [&](auto inputs, auto hits) {
            return world.find_nearest(query, inputs, hits, call.options);
        };
    };
    if (request.shape && request.kind == NearestKind::edges) {
        const ShapeEdgeQuery query{shape_of(entry), count, request.max_distance};
        return write_nearest(std::span<const Pose>(request.poses), count, edges_near_shape_,
                             become<NearestLists<ShapeEdgeHit>>(entry.answer.records),
                             by_cpu(query));
    }
    if (request.shape) {
        const ShapeNearestQuery query{shape_of(entry), count, request.max_distance};
        return write_nearest(std::span<const Pose>(request.poses), count, nearest_of_shape_,
                             become<NearestLists<Clearance>>(entry.answer.records), by_cpu(query));
    }
    const NearestQuery query{count, request.kind, request.max_distance};
    const std::span<const Vector2> points(request.points);
    auto& lists = become<NearestLists<NearestHit>>(entry.answer.records);
    if (call.options.technique == Technique::cpu) {
        return write_nearest(points, count, nearest_, lists, by_cpu(query));
    }
    return write_nearest(
        points, count, nearest_, lists, [&](auto some, std::span<NearestHit> hits) {
            return ask_device(call.world.nearest, call, some, hits,
                              [&](nearfield::WorldRequest& by, auto inputs) {
                                  return world.submit(by, query, inputs, call.options);
                              });
        });
}

Status WorldRunner::answer_rays(const Call& call, Entry& entry) const {
    const WorldRequest& request = *entry.answer.request;
    World& world = call.world.world;
    if (request.all_hits) {
        return world.cast_rays(request.segments, become<RayHits>(entry.answer.records),
                               call.options);
    }
    auto& hits = become<std::vector<RayHit>>(entry.answer.records);
    hits.resize(request.segments.size());
    if (call.options.technique == Technique::cpu) {
        return world.cast_rays(request.segments, hits, call.options);
    }
    return ask_device(call.world.rays, call, std::span<const Segment>(request.segments),
                      std::span(hits), [&](nearfield::WorldRequest& by, auto segments) {
                          return world.submit(by, segments, call.options);
                      });
}

Status WorldRunner::answer_cast(const Call& call, Entry& entry) const {
    const WorldRequest& request = *entry.answer.request;
    auto& hits = become<std::vector<ShapeCastHit>>(entry.answer.records);
    hits.resize(request.sweeps.size());
    ShapeCastQuery query;
    query.shape = shape_of(entry);
    query.tolerance = request.tolerance;
    query.contact_distance = request.contact_distance;
    return call.world.world.cast_shape(query, request.sweeps, hits, call.options);
}

Status WorldRunner::answer_overlap(const Call& call, Entry& entry) const {
    const WorldRequest& request = *entry.answer.request;
    World& world = call.world.world;
    auto& lists = become<InstanceLists>(entry.answer.records);
    if (request.shape) {
        return world.find_overlaps(shape_of(entry), request.poses, lists, call.options);
    }
    if (!request.points.empty()) {
        return world.find_overlaps(std::span<const Vector2>(request.points), lists, call.options);
    }
    return world.find_overlaps(std::span<const Rectangle>(request.rectangles), lists, call.options);
}

}  // namespace nearfield::tools
