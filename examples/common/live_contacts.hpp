#pragma once

#include "scene.hpp"

#include <nearfield/vulkan.hpp>

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

namespace nearfield::examples {

/// Half the diagonal of a grid cell, and the contact distance; world units.
inline constexpr double tolerance = 0.06;
inline constexpr double contact_distance = 0.2;

/// The data for drawing: contacts, and the poses that they belong to.
struct Snapshot {
    std::uint64_t version = 0;  ///< Scene::version() at that time; 0 before the first results
    std::array<Pose, 2> poses;
    std::vector<ContactPoint> contacts;
};

/// Finds the contacts of a scene on the device that draws it, in the host's own command buffers.
/// Use it on the host's render thread only.
class LiveContacts {
public:
    LiveContacts(const HostDevice& host, std::uint32_t frames_in_flight, const Scene& scene);
    /// The device has finished all frames, or never begins them.
    ~LiveContacts();
    LiveContacts(const LiveContacts&) = delete;
    LiveContacts& operator=(const LiveContacts&) = delete;

    /// Records the contact query for the current scene. The contacts of the frame
    /// `frames_in_flight` earlier, which the host knows to be complete, become the snapshot to
    /// draw.
    void record(VkCommandBuffer commands, std::uint64_t frame, const Scene& scene);

    [[nodiscard]] const Snapshot& snapshot() const { return snapshot_; }

private:
    struct Pending {
        Ticket ticket;
        QueryHandle<ContactQuery> query;
        Snapshot asked;  ///< without the contacts
    };

    void take_over(const Pending& pending);

    Context context_;
    std::uint32_t frames_in_flight_ = 0;
    std::uint64_t last_frame_ = 0;
    std::array<ShapeHandle, 2> shapes_;
    // Kept from frame to frame to reuse the memory.
    Batch batch_;
    Results results_;
    std::deque<Pending> pending_;  ///< oldest first
    Snapshot snapshot_;
};

}  // namespace nearfield::examples
