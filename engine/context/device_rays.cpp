// Segments whose first hits the device finds.

#include <engine/context/call_within.hpp>
#include <engine/context/device_query_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/plan/pair_search.hpp>
#include <engine/world/ray_hits.hpp>
#include <engine/world/ray_queries.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {
using geometry::Vector;

struct DeviceRays::Rays : State {
    Rays() : State(plan::WorldQuestion::rays) {}

    void submit(ContextOnDevice& with, const WorldOnDevice& world,
                std::span<const Segment> segments, const WorldFilter& filter);
    void collect(const char* call, std::span<RayHit> hits);

private:
    void write(std::size_t i, std::byte* memory) const;
    [[nodiscard]] bool decide(std::size_t number, const plan::RayAnswerData& answer,
                              RayHit& hit) const;
    void hit_by_cpu(std::span<const std::uint32_t> left, std::span<RayHit> hits);

    std::vector<Segment> segments_;
    std::vector<std::uint32_t> left_;         // numbers of those that the CPU follows
    std::vector<world::RayQueries> queries_;  // by job
};

void DeviceRays::Rays::write(std::size_t i, std::byte* memory) const {
    const Vector& origin = instances().origin();
    plan::RayData data;
    plan::split(segments_[i].from, origin, data.from, data.from_low);
    plan::split(segments_[i].to, origin, data.to, data.to_low);
    std::memcpy(memory + i * sizeof(data), &data, sizeof(data));
}

void DeviceRays::Rays::submit(ContextOnDevice& with, const WorldOnDevice& world,
                              std::span<const Segment> segments, const WorldFilter& filter) {
    require_segments("cast_rays", segments);
    world.instances.require_own(filter.ignored, "cast_rays");
    State::submit(
        "cast_rays", with, world, filter, segments.size(), {},
        [&](plan::WorldQueryPush& /*push*/) { segments_.assign(segments.begin(), segments.end()); },
        [&](std::size_t i, std::byte* memory) { write(i, memory); });
}

/// Answers a segment that can only hit the edges that the device names. Returns false if the device
/// cannot tell.
bool DeviceRays::Rays::decide(std::size_t number, const plan::RayAnswerData& answer,
                              RayHit& hit) const {
    if (answer.instances[0] == plan::answered_by_cpu) {
        return false;
    }
    const Vector from = geometry::to_vector(segments_[number].from);
    const Vector to = geometry::to_vector(segments_[number].to);
    const double rounding = world::rounding_along(from, to);
    world::EdgeHit first;
    std::uint32_t first_number = plan::no_instance;
    for (std::uint32_t i = 0; i < plan::ray_candidates; ++i) {
        const std::uint32_t instance = answer.instances[i];
        if (instance == plan::no_instance) {
            continue;
        }
        const std::uint32_t edge = answer.edges[i];
        const PlacedInstance* const own = find_placed(instance, edge);
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
            first_number == plan::no_instance || parameter < first.parameter ||
            (parameter == first.parameter &&
             (instance < first_number || (instance == first_number && edge < first.edge)));
        if (is_first) {
            first = {start, end, both, polygon.deviation(), own->handle, edge, parameter};
            first_number = instance;
        }
    }
    if (first_number == plan::no_instance) {
        hit = {};
        return true;
    }
    world::write_hit(from, to, first, hit);
    return true;
}

void DeviceRays::Rays::hit_by_cpu(std::span<const std::uint32_t> left, std::span<RayHit> hits) {
    const world::Instances& all = instances_for_cpu();
    const WorldFilter filter = filter_for_cpu();
    queries_.resize(jobs().count());
    jobs().divide(left.size(), questions_of_part,
                  [&](std::uint32_t job, std::size_t first, std::size_t end) {
                      const auto numbers = left.subspan(first, end - first);
                      queries_[job].begin(all, filter);
                      queries_[job].find_first(segments_, numbers, hits);
                      for (const std::uint32_t number : numbers) {
                          hits[number].instance = handle_of(hits[number].instance);
                      }
                  });
}

void DeviceRays::Rays::collect(const char* call, std::span<RayHit> hits) {
    require_submitted(call);
    require_lengths(call, "segments", count, hits.size());
    State::collect<plan::RayAnswerData>(
        [&](std::size_t i, const plan::RayAnswerData* answer) {
            if (answer == nullptr) {
                hits[i] = {};
                return true;
            }
            return decide(i, *answer, hits[i]);
        },
        [&](std::span<const std::uint32_t> left) { hit_by_cpu(left, hits); });
}

DeviceRays::DeviceRays() : DeviceQueryBase(std::make_unique<Rays>()) {}

Status DeviceRays::collect(std::span<RayHit> hits, const Limits& limits) {
    return catch_within(limits, [&] { static_cast<Rays&>(*state_).collect("collect", hits); });
}

void World::Implementation::submit(DeviceRays& rays, std::span<const Segment> segments,
                                   const WorldFilter& filter) {
    static_cast<DeviceRays::Rays&>(*rays.state_)
        .submit(*context_, {identity_, instances_}, segments, filter);
}

void World::Implementation::cast_rays(DeviceRays& rays, std::span<const Segment> segments,
                                      std::span<RayHit> hits, const WorldFilter& filter) {
    require_lengths("cast_rays", "segments", segments.size(), hits.size());
    submit(rays, segments, filter);
    static_cast<DeviceRays::Rays&>(*rays.state_).collect("cast_rays", hits);
}

Status World::submit(DeviceRays& rays, std::span<const Segment> segments, const WorldFilter& filter,
                     const Limits& limits) {
    return catch_within(limits, [&] { implementation_->submit(rays, segments, filter); });
}

Status World::cast_rays(DeviceRays& rays, std::span<const Segment> segments, std::span<RayHit> hits,
                        const WorldFilter& filter, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->cast_rays(rays, segments, hits, filter); });
}

}  // namespace nearfield
