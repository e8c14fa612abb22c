#pragma once

#include <nearfield/on_device.hpp>
#include <nearfield/shape.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>

/// \file
/// Poses that the host's own commands write, in a buffer on the device.

namespace nearfield {

/// The poses of a world's instances in a buffer of the host's, on the context's device:
/// PairTableInput::poses of a PairTable that the device answers. The host writes them
/// by commands submitted earlier to the same queue, for example by its own simulation; the CPU does
/// not see them before the table is collected.
///
/// The pose of an instance is the element with the index of its handle (InstanceHandle::index):
/// four floats, which are x and y of its position, and cosine and sine of its angle. The angle is
/// exactly that of the direction (cosine, sine), whose squared length may differ from 1 by 1/64.
///
/// Borrowed: the buffer must exist until the table is updated with other poses, or is destroyed,
/// because commands are kept for the next submission and a new buffer may have the handle of a
/// destroyed one. The poses are read once, by the commands of World::submit(), or by each execution
/// of those of World::record(). Commands that overwrite it after these, on the same queue, need a
/// barrier that waits for the compute shader stage, and no access.
struct DevicePoses {
    VkBuffer buffer = VK_NULL_HANDLE;  ///< not null
    VkDeviceSize offset = 0;           ///< of element 0; see minStorageBufferOffsetAlignment
    VkDeviceSize size = 0;             ///< bytes from `offset` on that may be read
    VkBufferUsageFlags usage = 0;      ///< as created; contains VK_BUFFER_USAGE_STORAGE_BUFFER_BIT
    std::uint32_t stride = 16;         ///< bytes from one element to the next: 16, 20, ...
    /// Added to all positions, world coordinates: those of a world far from (0, 0) are as precise
    /// as floats are near it.
    Vector2 origin = {};
    /// How the host has written them; its layout is ignored.
    TargetState before = {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT};

    /// True if all members are equal.
    friend bool operator==(const DevicePoses&, const DevicePoses&) = default;
};

}  // namespace nearfield
