#pragma once

#include <nearfield/export.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/timings.hpp>
#include <nearfield/world_queries.hpp>

#include <cstdint>
#include <memory>
#include <span>

/// \file
/// Inputs of a world's queries that are submitted now and collected later.

namespace nearfield {

/// Segments, points or poses of one World::submit(), and memory for them, on the device too, which
/// is kept from one submission to the next. Answers describe the world as it was at submission:
/// instances, shapes and the caller's input may change meanwhile.
///
/// A request is best used for inputs of one kind and one world; with another kind or world
/// everything is uploaded anew. Several answers at a time need several requests.
///
/// Threads: as for the world. Lifetime: a request keeps what it needs of the world's context. A
/// request that is destroyed before it is collected waits for the device.
///
///     nearfield::WorldRequest rays;
///     const nearfield::WorldOptions by_device{.technique = nearfield::Technique::compute};
///     auto status = world.submit(rays, segments, by_device);
///     step_the_rest();  // the world may change
///     status = status.ok() ? rays.collect(hits) : status;
class NEARFIELD_EXPORT WorldRequest {
public:
    /// Makes a request without inputs.
    WorldRequest() noexcept;
    ~WorldRequest();
    /// Takes the contents of another request, which then has no inputs.
    WorldRequest(WorldRequest&&) noexcept;
    /// Drops its contents, as the destructor does, and takes those of another request.
    WorldRequest& operator=(WorldRequest&&) noexcept;
    WorldRequest(const WorldRequest&) = delete;
    WorldRequest& operator=(const WorldRequest&) = delete;

    /// Waits for the device, if it answers, and writes the first hit of each segment. Fails with
    /// invalid_query, and may be called again, if there are not as many hits as segments; with
    /// not_ready if no segments were submitted, or they were collected before; if `limits` end the
    /// call; and as Context::run().
    Status collect(std::span<RayHit> hits, const Limits& limits = {});
    /// Waits for the device, if it answers, and writes the hits of points, NearestQuery::count for
    /// each. Fails as for segments.
    Status collect(std::span<NearestHit> hits, const Limits& limits = {});
    /// Waits for the device, if it answers, and writes 1 for each pose at which the shape and an
    /// instance share a point, otherwise 0. Fails as for segments.
    Status collect(std::span<std::uint8_t> intersects, const Limits& limits = {});

    /// The number of inputs that were submitted last.
    [[nodiscard]] std::uint32_t size() const noexcept;
    /// The number of inputs collected last that the CPU answered alone.
    [[nodiscard]] std::uint32_t left_to_cpu() const noexcept;
    /// True if collect() would not wait; never waits. Also true once the device is lost. False if
    /// nothing was submitted.
    [[nodiscard]] bool is_ready() const noexcept;
    /// The times of the last submission. `plan`: the upload of inputs and changed instances;
    /// `device`: the wait; `decode`: the CPU makes the answers; `total`: both halves, without the
    /// time between them.
    [[nodiscard]] const Timings& timings() const noexcept;

private:
    friend class World;
    struct NEARFIELD_HIDDEN State;
    template <class Kind>
    struct NEARFIELD_HIDDEN Of;
    struct NEARFIELD_HIDDEN Rays;
    struct NEARFIELD_HIDDEN Points;
    struct NEARFIELD_HIDDEN Poses;
    std::unique_ptr<State> state_;  // null: nothing was ever submitted
};

}  // namespace nearfield
