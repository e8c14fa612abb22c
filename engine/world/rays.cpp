// What segments hit.

#include <engine/device_input/pair_search.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/world/ray_hits.hpp>
#include <engine/world/ray_queries.hpp>
#include <engine/world/requests.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace nearfield {

using geometry::Vector;

/// Segments, of which the first hits are wanted.
struct WorldRequest::Rays {
    static constexpr device_input::WorldQuestion question = device_input::WorldQuestion::rays;
    static constexpr const char* call = "cast_rays";
    using Input = Segment;
    using Answer = RayHit;
    using Data = shaders::RayData;
    using Found = shaders::RayAnswerData;
    using Solver = world::RayQueries;

    static void require_room(const char* from, std::size_t segments, std::size_t hits) {
        require_lengths(from, "segments", segments, hits);
    }
    static std::uint32_t answers_each() { return 1; }
    static void require(const World::State& /*world*/, std::span<const Segment> segments) {
        require_segments(call, segments);
    }

    static void answer(World::State& world, std::span<const Segment> segments,
                       std::span<RayHit> hits, const WorldFilter& filter) {
        // The more are sorted together, the nearer are neighbours to each other, and the farther
        // from each other in memory. Rays hit edges anywhere, so they gain less than points.
        constexpr std::size_t at_a_time = std::size_t{1} << 16U;
        world.divide_places(
            segments.size(), at_a_time,
            [&](std::size_t i) -> const Vector2& { return segments[i].from; },
            [&](World::State::Job& job, std::size_t block, std::span<const std::uint32_t> numbers) {
                job.rays.begin(world.instances, filter);
                job.rays.find_first(segments.subspan(block), numbers, hits.subspan(block));
            });
    }

    static void take_down(const State& /*device*/, shaders::WorldQueryPush& /*push*/) {}
    static Data data_of(const State& device, const Segment& segment) {
        const Vector& origin = device.instances().origin();
        Data data;
        device_input::split(segment.from, origin, data.from, data.from_low);
        device_input::split(segment.to, origin, data.to, data.to_low);
        return data;
    }
    /// Answers a segment that can only hit the edges that the device names. Returns false if the
    /// device cannot tell.
    static bool decide(const State& device, const Segment& segment, const Found& found,
                       RayHit& hit) {
        if (found.instances[0] == shaders::answered_by_cpu) {
            return false;
        }
        const Vector from = geometry::to_vector(segment.from);
        const Vector to = geometry::to_vector(segment.to);
        const double rounding = world::rounding_along(from, to);
        world::EdgeHit first;
        std::uint32_t first_number = shaders::no_instance;
        for (std::uint32_t i = 0; i < shaders::ray_candidates; ++i) {
            const std::uint32_t instance = found.instances[i];
            if (instance == shaders::no_instance) {
                continue;
            }
            const std::uint32_t edge = found.edges[i];
            const PlacedInstance* const own = device.find_placed(instance, edge);
            if (own == nullptr) {
                return false;
            }
            const geometry::Polygon& polygon = own->polygon.polygon();
            const Vector start = own->polygon.vertex(edge);
            const Vector end = own->polygon.vertex(polygon.next(edge));
            const double both = own->rounding + rounding;
            const double parameter = geometry::first_meeting(from, to, start, end, both);
            if (!(parameter <= 1.0) || world::is_repeated_vertex(start, end, polygon, edge)) {
                continue;
            }
            const bool is_first =
                first_number == shaders::no_instance || parameter < first.parameter ||
                (parameter == first.parameter &&
                 (instance < first_number || (instance == first_number && edge < first.edge)));
            if (is_first) {
                first = {start, end, both, polygon.deviation(), own->handle, edge, parameter};
                first_number = instance;
            }
        }
        if (first_number == shaders::no_instance) {
            hit = {};
            return true;
        }
        world::write_hit(from, to, first, hit);
        return true;
    }

    static void answer_some(world::RayQueries& solver, const world::Instances& instances,
                            const WorldFilter& filter, std::span<const Segment> segments,
                            std::span<const std::uint32_t> numbers, std::span<RayHit> hits) {
        solver.begin(instances, filter);
        solver.find_first(segments, numbers, hits);
    }
};

Status World::cast_rays(std::span<const Segment> segments, std::span<RayHit> hits,
                        const WorldOptions& options) {
    return WorldRequest::Of<WorldRequest::Rays>::answer(*state_, state_->rays, {}, segments, hits,
                                                        options);
}

Status World::submit(WorldRequest& request, std::span<const Segment> segments,
                     const WorldOptions& options) {
    return WorldRequest::Of<WorldRequest::Rays>::submit(*state_, request, {}, segments, options);
}

Status WorldRequest::collect(std::span<RayHit> hits, const Limits& limits) {
    return Of<Rays>::collect(*this, hits, limits);
}

Status World::cast_rays(std::span<const Segment> segments, RayHits& hits,
                        const WorldOptions& options) {
    return catch_within(options.limits, [&] {
        require_cpu("cast_rays", options.technique);
        require_segments("cast_rays", segments);
        State& state = *state_;
        state.prepare(options.filter, "cast_rays");
        for (State::Job& job : state.scratch) {
            job.rays.begin(state.instances, options.filter);
        }
        expect_answers(segments.size());
        state.ray_lists.write(state.jobs, segments.size(), hits.offsets, hits.hits,
                              [&](std::uint32_t job, std::size_t i, std::vector<RayHit>& found) {
                                  state.scratch[job].rays.find_all(segments[i], found);
                                  finish_answers(1);
                              });
    });
}

}  // namespace nearfield
