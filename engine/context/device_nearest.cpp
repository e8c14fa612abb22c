// Points whose nearest instances the device finds.

#include <engine/base/interruption.hpp>
#include <engine/context/call_within.hpp>
#include <engine/context/device_query_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/plan/pair_search.hpp>
#include <engine/world/nearest_hits.hpp>
#include <engine/world/nearest_queries.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {

using geometry::Vector;

namespace {

/// Whether both are on the same edge, or at the same vertex.
bool is_same_feature(const PlacedInstance& instance, const world::NearestOnInstance& a,
                     const world::NearestOnInstance& b) {
    const auto feature_of = [&](const world::NearestOnInstance& found) {
        return records::feature_at(instance.polygon, found.edge, found.on_edge.parameter);
    };
    const Feature one = feature_of(a);
    const Feature other = feature_of(b);
    return one.kind == other.kind && one.index == other.index;
}

}  // namespace

struct DeviceNearest::Points : State {
    Points() : State(plan::WorldQuestion::nearest) {}

    void submit(ContextOnDevice& with, const WorldOnDevice& world, const NearestQuery& query,
                std::span<const Vector2> points);
    void collect(const char* call, std::span<NearestHit> hits);

private:
    void write(std::size_t i, std::byte* memory) const;
    [[nodiscard]] bool decide(std::size_t number, const plan::NearestAnswerData& answer,
                              NearestHit& hit) const;
    void find_by_cpu(std::span<const std::uint32_t> left, std::span<NearestHit> hits);

    NearestQuery query_;
    std::vector<Vector2> points_;
    std::vector<world::NearestQueries> queries_;  // by job
};

void DeviceNearest::Points::write(std::size_t i, std::byte* memory) const {
    plan::NearestData data;
    plan::split(points_[i], instances().origin(), data.at, data.low);
    std::memcpy(memory + i * sizeof(data), &data, sizeof(data));
}

void DeviceNearest::Points::submit(ContextOnDevice& with, const WorldOnDevice& world,
                                   const NearestQuery& query, std::span<const Vector2> points) {
    require_nearest_query(query);
    if (query.count != 1) {
        refuse("find_nearest",
               "the device finds one of each point, not " + std::to_string(query.count));
    }
    require_points("find_nearest", points);
    world.instances.require_own(query.filter.ignored, "find_nearest");
    plan::WorldQueryPush push{};
    push.largest = plan::rounded_up(query.max_distance);
    push.is_signed = query.kind == NearestKind::instances ? 1 : 0;
    State::submit(
        "find_nearest", with, world, query.filter, points.size(), push,
        [&](plan::WorldQueryPush& /*push*/) {
            query_ = query;
            points_.assign(points.begin(), points.end());
        },
        [&](std::size_t i, std::byte* memory) { write(i, memory); });
}

/// Answers a point that can only be near the edges that the device names. Returns false if the
/// device cannot tell, or if two of them are so near that rounding decides.
bool DeviceNearest::Points::decide(std::size_t number, const plan::NearestAnswerData& answer,
                                   NearestHit& hit) const {
    hit = {};
    if (answer.instance == plan::answered_by_cpu) {
        return false;
    }
    if (answer.instance == plan::no_instance) {
        return true;
    }
    const std::uint32_t instance = answer.instance & ~plan::point_in_instance;
    const bool is_inside = (answer.instance & plan::point_in_instance) != 0;
    const Vector point = geometry::to_vector(points_[number]);
    std::array<world::NearestOnInstance, plan::nearest_candidates> all;
    std::size_t found = 0;
    const PlacedInstance* own = nullptr;
    for (const std::uint32_t edge : answer.edges) {
        if (edge == plan::no_edge) {
            continue;
        }
        own = find_placed(instance, edge);
        if (own == nullptr) {
            return false;
        }
        const geometry::NearestOnSegment on_edge =
            records::nearest_on_edge(own->polygon, edge, point);
        all[found++] = {{}, std::sqrt(on_edge.squared_distance), edge, on_edge};
    }
    if (found == 0) {
        return false;
    }
    const auto candidates = std::span(all).first(found);
    world::NearestOnInstance nearest = *std::min_element(
        candidates.begin(), candidates.end(),
        [](const world::NearestOnInstance& a, const world::NearestOnInstance& b) {
            return a.distance != b.distance ? a.distance < b.distance : a.edge < b.edge;
        });
    // Of several features of an instance that are equally near, the CPU's search names any.
    const auto is_rival = [&](const world::NearestOnInstance& other) {
        return other.distance <= nearest.distance * (1.0 + 0x1p-40) + 8.0 * own->rounding &&
               !is_same_feature(*own, other, nearest);
    };
    if (query_.kind == NearestKind::instances &&
        std::any_of(candidates.begin(), candidates.end(), is_rival)) {
        return false;
    }
    if (nearest.distance <= query_.max_distance) {
        nearest.instance = own->handle;
        nearest.distance = is_inside ? -nearest.distance : nearest.distance;
        hit = world::hit_of(nearest, own->polygon, own->rounding);
    }
    return true;
}

void DeviceNearest::Points::find_by_cpu(std::span<const std::uint32_t> left,
                                        std::span<NearestHit> hits) {
    const world::Instances& all = instances_for_cpu();
    NearestQuery query = query_;
    query.filter = filter_for_cpu();
    queries_.resize(jobs().count());
    jobs().divide(left.size(), questions_of_part,
                  [&](std::uint32_t job, std::size_t first, std::size_t end) {
                      queries_[job].begin(all, query);
                      for (const std::uint32_t number : left.subspan(first, end - first)) {
                          checkpoint();
                          NearestHit& hit = hits[number];
                          queries_[job].find(points_[number], {&hit, 1});
                          hit.instance = handle_of(hit.instance);
                      }
                  });
}

void DeviceNearest::Points::collect(const char* call, std::span<NearestHit> hits) {
    require_submitted(call);
    require_lengths(call, "points", count, hits.size());
    State::collect<plan::NearestAnswerData>(
        [&](std::size_t i, const plan::NearestAnswerData* answer) {
            if (answer == nullptr) {
                hits[i] = {};
                return true;
            }
            return decide(i, *answer, hits[i]);
        },
        [&](std::span<const std::uint32_t> left) { find_by_cpu(left, hits); });
}

DeviceNearest::DeviceNearest() : DeviceQueryBase(std::make_unique<Points>()) {}

Status DeviceNearest::collect(std::span<NearestHit> hits, const Limits& limits) {
    return catch_within(limits, [&] { static_cast<Points&>(*state_).collect("collect", hits); });
}

void World::Implementation::submit(DeviceNearest& nearest, const NearestQuery& query,
                                   std::span<const Vector2> points) {
    static_cast<DeviceNearest::Points&>(*nearest.state_)
        .submit(*context_, {identity_, instances_}, query, points);
}

void World::Implementation::find_nearest(DeviceNearest& nearest, const NearestQuery& query,
                                         std::span<const Vector2> points,
                                         std::span<NearestHit> hits) {
    require_lengths("find_nearest", "points", points.size(), hits.size());
    submit(nearest, query, points);
    static_cast<DeviceNearest::Points&>(*nearest.state_).collect("find_nearest", hits);
}

Status World::submit(DeviceNearest& nearest, const NearestQuery& query,
                     std::span<const Vector2> points, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->submit(nearest, query, points); });
}

Status World::find_nearest(DeviceNearest& nearest, const NearestQuery& query,
                           std::span<const Vector2> points, std::span<NearestHit> hits,
                           const Limits& limits) {
    return catch_within(limits,
                        [&] { implementation_->find_nearest(nearest, query, points, hits); });
}

}  // namespace nearfield
