#pragma once

#include <nearfield/on_device.hpp>
#include <nearfield/shape.hpp>

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>

/// \file
/// Pairs of a world that stay on the device (PairTable::on_device()), for the host's own
/// shaders. The GLSL header nearfield/nearfield.glsl declares the same structures.

namespace nearfield {

/// Where the results on the device of a PairTable go (PairTableInput::target), in place of
/// nearfield's own buffers. It has space for `size / sizeof(PairData)` pairs and
/// `size / sizeof(PointData)` points, of as many parts of a storage buffer as the device's shaders
/// reach; PairTable::found() of an earlier search tells how many there are.
///
/// Borrowed, as DevicePoses: the buffers must exist until the table is submitted, updated or
/// recorded with another target or none, or is destroyed.
///
///     const nearfield::PairTarget target{
///         .pairs = {.buffer = rows, .size = 4096 * sizeof(nearfield::PairData), .usage = usage},
///         .points = {.buffer = points, .size = points_size, .usage = usage}};
///     world.submit(table, {.target = &target});
struct PairTarget {
    BufferTarget pairs;   ///< of PairData; space for one at least
    BufferTarget points;  ///< of PointData; space for one at least

    /// True if all members are equal.
    friend bool operator==(const PairTarget&, const PairTarget&) = default;
};

/// One of the arrays of PairsOnDevice. A buffer of nearfield's own may be bound as a storage,
/// vertex or indirect buffer, and copied from.
struct ArrayOnDevice {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< borrowed. Or the host's
    VkDeviceSize offset = 0;           ///< of the array: 0, or the target's
    VkDeviceSize size = 0;             ///< of the array, in bytes
    std::uint32_t capacity = 0;        ///< maximum number of elements
    /// The number of elements. `overflow` is 1 if the memory was too small for the pairs, so that
    /// rows and points are missing. PairTable::collect() then grows the memory and searches again;
    /// for recorded commands the next World::record() grows it. It is also 1 if a target is too
    /// small; then the first pairs and points are there, and no pair names a point that is not.
    HeaderOnDevice header;
};

/// The rows of a PairTable whose query leaves results on the device (PenetrationQuery::on_device,
/// ContactQuery::on_device), as the device has found them, in ascending order as in the table. They
/// are not made exact: pairs that single precision cannot decide have a flag (pair_flags), and the
/// host's shaders count them or not.
///
/// Commands that the host submits to the same queue after World::submit() see them, as those of a
/// batch (on_device.hpp), and so do those that follow what World::record() has recorded. All
/// handles hold until the table is submitted, updated or recorded again, or collected after
/// World::submit(), by when the device must be done with these commands; frames in flight have two
/// tables, in turns.
///
/// Error of all positions and distances of a pair: at most 2^-17 of a sum of lengths plus 2^-44 of
/// the largest world coordinate, the origin's included. The lengths are both shapes' radii around
/// their centres, the distance of these centres, and that of the pair from the origin; if the poses
/// are the host's (DevicePoses), also the distances of the centres from the shapes' own (0, 0). The
/// error of a normal is at most twice this divided by the distance, where the point is neither
/// touching nor undecided.
///
/// Where pairs of contacts are searched in parts (PairTable), a point may be listed twice; a pair
/// names one.
struct PairsOnDevice {
    ArrayOnDevice pairs;   ///< of PairData
    ArrayOnDevice points;  ///< of PointData
    Vector2 origin;        ///< of all positions, world coordinates
    /// Once the device has executed the search, of nearfield's own buffers; those of a target are
    /// as its `after` states.
    OutputState state;
    std::uint64_t revision = 0;  ///< changes whenever a handle or a size does
};

/// The bits of PairData::flags.
namespace pair_flags {
/// It is not certain that the pair is hit.
inline constexpr std::uint32_t undecided = 4;
/// The pair is certainly hit; its count and deepest point are not certain.
inline constexpr std::uint32_t uncertain = 8;
/// Contacts: the shapes certainly intersect.
inline constexpr std::uint32_t intersects = 16;
}  // namespace pair_flags

/// NearfieldPair of the GLSL header (std430): a pair that is hit, or may be.
struct PairData {
    std::uint32_t a = 0;      ///< index of the instance's handle (InstanceHandle::index)
    std::uint32_t b = 0;      ///< index of the other instance's handle
    std::uint32_t count = 0;  ///< the number of points that certainly count
    std::uint32_t flags = 0;  ///< pair_flags
    /// Consecutive points, of A's boundary. Penetrations: those without
    /// feature_bits::inside do not count. Contacts: those farther than the contact distance do
    /// not.
    std::uint32_t first_point = 0;
    std::uint32_t point_count = 0;  ///< the number of these points
    std::uint32_t first_of_b = 0;   ///< contacts: those of points of B's boundary
    std::uint32_t count_of_b = 0;   ///< the number of these points
    /// Penetrations: the point of the greatest depth; no_point where it is not certain that there
    /// is one.
    std::uint32_t deepest = no_point;
    float depth = 0.0F;  ///< its depth
};
static_assert(sizeof(PairData) == 40 && offsetof(PairData, flags) == 12 &&
              offsetof(PairData, first_point) == 16 && offsetof(PairData, deepest) == 32);

}  // namespace nearfield
