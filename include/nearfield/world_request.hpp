#pragma once

#include <nearfield/export.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/timings.hpp>
#include <nearfield/world_queries.hpp>

#include <cstdint>
#include <memory>
#include <span>

/// \file
/// Questions about a world that are submitted now and collected later.

namespace nearfield {

/// Segments, points or poses of one World::submit(), and memory for them, on the device too, which
/// is kept from one submission to the next. Answers are those of the world as it was when they were
/// submitted: instances and shapes may change meanwhile, and so may what was passed.
///
/// Used for questions of one kind about one world; with another kind, or another world, everything
/// is uploaded anew. What needs several answers at a time has as many requests.
///
/// Threads: as for the world. Lifetime: the world's context must outlive it. If it is destroyed
/// before it is collected, it waits for the device.
///
///     nearfield::WorldRequest rays;
///     const nearfield::WorldOptions by_device{.technique = nearfield::Technique::compute};
///     auto status = world.submit(rays, segments, by_device);
///     step_the_rest();  // the world may change
///     status = status.ok() ? rays.collect(hits) : status;
class NEARFIELD_EXPORT WorldRequest {
public:
    /// Without questions.
    WorldRequest() noexcept;
    ~WorldRequest();
    /// Takes the contents of another one, which is without questions then.
    WorldRequest(WorldRequest&&) noexcept;
    /// Drops what it has, as the destructor does, and takes the contents of another one.
    WorldRequest& operator=(WorldRequest&&) noexcept;
    WorldRequest(const WorldRequest&) = delete;
    WorldRequest& operator=(const WorldRequest&) = delete;

    /// Waits for the device, if it was asked, and writes the first hit of each segment. Fails with
    /// invalid_query, and may be called again, if there are not as many hits as segments; with
    /// not_ready if no segments were submitted, or they were collected before; if `limits` end the
    /// call; and as Context::run().
    Status collect(std::span<RayHit> hits, const Limits& limits = {});
    /// Waits for the device, if it was asked, and writes the hits of points, as many of each as the
    /// NearestQuery wants. Fails as for segments.
    Status collect(std::span<NearestHit> hits, const Limits& limits = {});
    /// Waits for the device, if it was asked, and writes 1 for each pose at which the shape and an
    /// instance share a point, otherwise 0. Fails as for segments.
    Status collect(std::span<std::uint8_t> intersects, const Limits& limits = {});

    /// The number of inputs that were submitted last.
    [[nodiscard]] std::uint32_t size() const noexcept;
    /// How many of those that were collected last the CPU answered by itself.
    [[nodiscard]] std::uint32_t left_to_cpu() const noexcept;
    /// True if collect() would not wait; never waits. Also true once the device is lost. False if
    /// nothing was submitted.
    [[nodiscard]] bool is_ready() const noexcept;
    /// Of the last submission. `plan`: inputs, and what has changed of the instances, are uploaded;
    /// `device`: the wait; `decode`: the CPU makes the answers; `total`: of both halves, without
    /// what is between them.
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
