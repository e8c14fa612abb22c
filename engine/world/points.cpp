// The nearest instances, or edges, of points.

#include <engine/base/prefetch.hpp>
#include <engine/device_input/pair_search.hpp>
#include <engine/world/nearest_hits.hpp>
#include <engine/world/nearest_queries.hpp>
#include <engine/world/requests.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nearfield {

using geometry::Vector;

namespace {

/// Whether both are on the same edge, or at the same vertex.
bool is_same_feature(const PlacedInstance& instance, const world::NearestOnInstance& a,
                     const world::NearestOnInstance& b) {
    const auto feature_of = [&](const world::NearestOnInstance& found) {
        return solvers::feature_at(instance.polygon, found.edge, found.on_edge.parameter);
    };
    const Feature one = feature_of(a);
    const Feature other = feature_of(b);
    return one.kind == other.kind && one.index == other.index;
}

}  // namespace

/// Points, of which the nearest instances or edges are wanted.
struct WorldRequest::Points {
    NearestQuery query;

    static constexpr device_input::WorldQuestion question = device_input::WorldQuestion::nearest;
    static constexpr const char* call = "find_nearest";
    using Input = Vector2;
    using Answer = NearestHit;
    using Data = shaders::NearestData;
    using Found = shaders::NearestAnswerData;
    using Solver = world::NearestQueries;

    void require_room(const char* from, std::size_t points, std::size_t hits) const {
        require_room_for_nearest(from, query.count, "points", points, hits);
    }
    [[nodiscard]] std::uint32_t answers_each() const { return query.count; }
    void require(const World::State& /*world*/, std::span<const Vector2> points) const {
        require_reach_of_nearest(query.max_distance);
        if (query.kind != NearestKind::instances && query.kind != NearestKind::edges) {
            refuse(call, "the kind is no enumerator");
        }
        require_points(call, points);
    }

    void answer(World::State& world, std::span<const Vector2> points, std::span<NearestHit> hits,
                const WorldFilter& filter) const {
        // The more are sorted together, the nearer are neighbours to each other, and the farther
        // from each other in memory.
        constexpr std::size_t at_a_time = std::size_t{1} << 18U;
        world.divide_places(
            points.size(), at_a_time, [&](std::size_t i) -> const Vector2& { return points[i]; },
            [&](World::State::Job& job, std::size_t block, std::span<const std::uint32_t> numbers) {
                answer_some(job.nearest, world.instances, filter, points.subspan(block), numbers,
                            hits.subspan(block * query.count));
            });
    }

    void take_down(const State& /*device*/, shaders::WorldQueryPush& push) const {
        push.largest = device_input::rounded_up(query.max_distance);
        push.is_signed = query.kind == NearestKind::instances ? 1 : 0;
    }
    static Data data_of(const State& device, const Vector2& point) {
        Data data;
        device_input::split(point, device.instances().origin(), data.at, data.low);
        return data;
    }
    /// Answers a point that can only be near the edges that the device names. Returns false if the
    /// device cannot tell, or if two of them are so near that rounding decides.
    bool decide(const State& device, const Vector2& at, const Found& named, NearestHit& hit) const {
        hit = {};
        if (named.instance == shaders::answered_by_cpu) {
            return false;
        }
        if (named.instance == shaders::no_instance) {
            return true;
        }
        const std::uint32_t instance = named.instance & ~shaders::point_in_instance;
        const bool is_inside = (named.instance & shaders::point_in_instance) != 0;
        const Vector point = geometry::to_vector(at);
        std::array<world::NearestOnInstance, shaders::nearest_candidates> all;
        std::size_t found = 0;
        const PlacedInstance* own = nullptr;
        for (const std::uint32_t edge : named.edges) {
            if (edge == shaders::no_edge) {
                continue;
            }
            own = device.find_placed(instance, edge);
            if (own == nullptr) {
                return false;
            }
            const geometry::NearestOnSegment on_edge =
                solvers::nearest_on_edge(own->polygon, edge, point);
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
        if (query.kind == NearestKind::instances &&
            std::any_of(candidates.begin(), candidates.end(), is_rival)) {
            return false;
        }
        if (nearest.distance <= query.max_distance) {
            nearest.instance = own->handle;
            nearest.distance = is_inside ? -nearest.distance : nearest.distance;
            hit = world::hit_of(nearest, own->polygon, own->rounding);
        }
        return true;
    }

    void answer_some(world::NearestQueries& solver, const world::Instances& instances,
                     const WorldFilter& filter, std::span<const Vector2> points,
                     std::span<const std::uint32_t> numbers, std::span<NearestHit> hits) const {
        constexpr std::size_t ahead = 8;
        const std::size_t count = query.count;
        solver.begin(instances, query, filter);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            checkpoint();
            // Points that are close are not close in memory.
            const std::size_t later = numbers[std::min(i + ahead, numbers.size() - 1)];
            prefetch(&points[later]);
            prefetch(&hits[later * count]);
            solver.find(points[numbers[i]], hits.subspan(numbers[i] * count, count));
        }
    }
};

Status World::find_nearest(const NearestQuery& query, std::span<const Vector2> points,
                           std::span<NearestHit> hits, const WorldOptions& options) {
    return WorldRequest::Of<WorldRequest::Points>::answer(*state_, state_->points, {query}, points,
                                                          hits, options);
}

Status World::submit(WorldRequest& request, const NearestQuery& query,
                     std::span<const Vector2> points, const WorldOptions& options) {
    return WorldRequest::Of<WorldRequest::Points>::submit(*state_, request, {query}, points,
                                                          options);
}

Status WorldRequest::collect(std::span<NearestHit> hits, const Limits& limits) {
    return Of<Points>::collect(*this, hits, limits);
}

}  // namespace nearfield
