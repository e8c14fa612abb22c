#pragma once

#include <nearfield/export.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/status.hpp>
#include <nearfield/timings.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <memory>
#include <span>

/// \file
/// Queries of a world that the device answers: many segments, points or poses at once.

namespace nearfield {

/// What DeviceRays, DeviceNearest and DevicePoseTests have in common: memory for one submission, on
/// the device too, which is kept from one to the next.
///
/// The device walks over boxes of instances and edges in single precision, and names, for each
/// question, the edges that the answer may be about. The CPU computes the answer from these, in
/// double precision. Where single precision cannot tell, the CPU answers by itself. So answers are
/// those of the same query on the CPU (world.hpp), bit for bit, at the instances as they were when
/// the questions were submitted.
///
/// Limits: 2^18 instances; as many questions as Settings::memory_limit allows, and as a buffer of
/// the device has room for: at least 4 million, where an answer takes 32 bytes.
///
/// Used with one world at a time; with another one, everything is uploaded anew. Technique::compute
/// is needed. Threads: as for the world. Lifetime: the world's context must outlive it. If it is
/// destroyed before it is collected, it waits for the device.
class NEARFIELD_EXPORT DeviceQueryBase {
public:
    /// The number of questions that were submitted last.
    [[nodiscard]] std::uint32_t size() const noexcept;
    /// How many of those that were collected last the CPU answered by itself.
    [[nodiscard]] std::uint32_t left_to_cpu() const noexcept;
    /// True if the device has finished what was submitted; never waits. Also true once the device
    /// is lost. False if nothing was submitted.
    [[nodiscard]] bool is_ready() const noexcept;
    /// Of the last submission. `plan`: questions, and what has changed of the instances, are
    /// uploaded; `device`: the wait; `decode`: the CPU makes the answers; `total`: of both halves,
    /// without what is between them.
    [[nodiscard]] const Timings& timings() const noexcept;

protected:
    struct State;
    explicit DeviceQueryBase(std::unique_ptr<State> state) noexcept;  ///< of one kind of question
    ~DeviceQueryBase();
    /// Takes the contents of another one, which can then only be destroyed or assigned to.
    DeviceQueryBase(DeviceQueryBase&&) noexcept;
    /// Likewise.
    DeviceQueryBase& operator=(DeviceQueryBase&&) noexcept;

    friend class World;
    std::unique_ptr<State> state_;  ///< never null, unless moved from
};

/// Segments whose first hits the device finds: World::cast_rays(), or World::submit() and
/// collect().
class NEARFIELD_EXPORT DeviceRays : public DeviceQueryBase {
public:
    /// Without segments.
    DeviceRays();

    /// Waits for the device after World::submit(), and writes the first hit of each segment. Fails
    /// with invalid_query, and may be called again, if there are not as many hits as segments; with
    /// not_ready if nothing was submitted, or it was collected before; otherwise as
    /// World::submit().
    Status collect(std::span<RayHit> hits, const Limits& limits = {});

private:
    friend class World;
    struct NEARFIELD_HIDDEN Rays;
};

/// Points whose nearest instances, or edges, the device finds: World::find_nearest(), or
/// World::submit() and collect(). One of each point: NearestQuery::count is 1.
class NEARFIELD_EXPORT DeviceNearest : public DeviceQueryBase {
public:
    /// Without points.
    DeviceNearest();

    /// Waits for the device after World::submit(), and writes the hit of each point. Otherwise as
    /// DeviceRays::collect().
    Status collect(std::span<NearestHit> hits, const Limits& limits = {});

private:
    friend class World;
    struct NEARFIELD_HIDDEN Points;
};

/// Poses of a shape that the device tests: World::test_poses(), or World::submit() and collect().
class NEARFIELD_EXPORT DevicePoseTests : public DeviceQueryBase {
public:
    /// Without poses.
    DevicePoseTests();

    /// Waits for the device after World::submit(), and writes 1 for each pose at which the shape
    /// and an instance share a point, otherwise 0. Otherwise as DeviceRays::collect().
    Status collect(std::span<std::uint8_t> intersects, const Limits& limits = {});

private:
    friend class World;
    struct NEARFIELD_HIDDEN Tests;
};

}  // namespace nearfield
