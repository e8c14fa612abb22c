#pragma once

#include <engine/base/status_exception.hpp>
#include <engine/batch/context_implementation.hpp>
#include <engine/geometry/ring_check.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/world/instances.hpp>
#include <nearfield/query.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/world.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

/// \file Checks of what the calls of a world are given, before any work. They throw.

namespace nearfield {

[[noreturn]] inline void refuse(const char* call, const std::string& why) {
    throw StatusException({StatusCode::invalid_query, std::string(call) + ": " + why});
}

[[noreturn]] inline void refuse_technique(const char* call, Technique technique) {
    throw StatusException({StatusCode::unsupported_technique,
                           std::string(call) + ": Technique::" + to_string(technique) +
                               " does not answer this question of a world; Technique::cpu does"});
}

/// Refuses techniques other than the CPU's, which alone answers a call.
inline void require_cpu(const char* call, Technique technique) {
    if (technique != Technique::cpu && technique != Technique::automatic) {
        refuse_technique(call, technique);
    }
}

/// Refuses a query whose numbers, or whose technique in this context, cannot be used.
template <class Query>
void require_answered(const char* call, const Query& query,
                      const Context::Implementation& context) {
    const DeviceTechniques& techniques = context.techniques();
    const queries::AvailableTechniques available{.device = context.device() != nullptr,
                                                 .raster = techniques.raster,
                                                 .compute = techniques.compute};
    if (const Status status = queries::check_query(query, available); !status.ok()) {
        throw StatusException({status.code(), std::string(call) + ": " + status.message()});
    }
}

/// Refuses Technique::compute where this context does without it, for questions that have no other
/// number and that it answers in no batch.
inline void require_answered_by_compute(const char* call, const Context::Implementation& context) {
    require_answered(call, PenetrationQuery{.tolerance = 1.0, .technique = Technique::compute},
                     context);
}

inline void require_lengths(const char* call, const char* what, std::size_t in, std::size_t out) {
    if (in != out) {
        refuse(call, "there are " + std::to_string(in) + " " + what + " and space for " +
                         std::to_string(out) + " answers");
    }
}

inline void require_pose(const char* call, const char* what, std::size_t i, const Pose& pose) {
    if (Status status = queries::check_pose(pose, what); !status.ok()) {
        refuse(call, status.message() + " (number " + std::to_string(i) + ")");
    }
}

inline void require_point(const char* call, const char* what, std::size_t i, const Vector2& point) {
    if (!geometry::usable(point)) {
        refuse(call, std::string(what) + " " + std::to_string(i) + " is (" +
                         geometry::number(point.x) + ", " + geometry::number(point.y) +
                         "); coordinates must be finite and at most " +
                         geometry::number(largest_coordinate) + " in magnitude");
    }
}

inline void require_poses(const char* call, std::span<const Pose> poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
        require_pose(call, "the shape", i, poses[i]);
    }
}

inline void require_points(const char* call, std::span<const Vector2> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        require_point(call, "point", i, points[i]);
    }
}

inline void require_segments(const char* call, std::span<const Segment> segments) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
        require_point(call, "the start of segment", i, segments[i].from);
        require_point(call, "the end of segment", i, segments[i].to);
    }
}

/// Of find_nearest(). `inputs`: the number of poses or points; `hits`: of entries in the caller's
/// memory.
inline void require_room_for_nearest(const char* call, std::uint32_t count, const char* what,
                                     std::size_t inputs, std::size_t hits) {
    if (count == 0 || hits / count != inputs || hits % count != 0) {
        refuse(call, "there are " + std::to_string(inputs) + " " + what + ", " +
                         std::to_string(count) + " hits are wanted of each, and " +
                         std::to_string(hits) + " have space");
    }
}

inline void require_reach_of_nearest(double max_distance) {
    if (!(max_distance >= 0.0)) {
        refuse("find_nearest", "the largest distance is " + geometry::number(max_distance) +
                                   "; it must be at least 0");
    }
}

/// Refuses moves unless every instance exists and has a pose that can be used.
inline void require_moves(const char* call, const world::Instances& instances,
                          std::span<const InstanceHandle> moving, std::span<const Pose> poses) {
    if (moving.size() != poses.size()) {
        refuse(call, "there are " + std::to_string(moving.size()) + " instances and " +
                         std::to_string(poses.size()) + " poses");
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
        static_cast<void>(instances.find(moving[i], call));
        require_pose(call, "an instance", i, poses[i]);
    }
}

}  // namespace nearfield
