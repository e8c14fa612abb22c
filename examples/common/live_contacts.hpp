#pragma once

#include "scene.hpp"

#include <nearfield/nearfield.hpp>

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <deque>
#include <stdexcept>
#include <utility>
#include <vector>

namespace nearfield::examples {

/// Half the diagonal of a grid cell, and how close counts as contact; world units.
inline constexpr double tolerance = 0.06;
inline constexpr double contact_distance = 0.2;

/// What there is to draw: contacts, and where the shapes were that they belong to.
struct Snapshot {
    std::uint64_t version = 0;  ///< Scene::version() then; 0 before there are any results
    std::array<Pose, 2> poses;
    std::vector<ContactRecord> contacts;
};

/// Finds the contacts of a scene on the device that draws it, in the host's own command buffers.
/// All of it on the host's render thread.
class LiveContacts {
public:
    LiveContacts(const HostDevice& host, std::uint32_t frames_in_flight, const Scene& scene);

    /// Records the search for the contacts of the scene as it is now. Takes over those of the frame
    /// `frames_in_flight` before, which the host knows to be done, as the snapshot to draw.
    void record(VkCommandBuffer commands, std::uint64_t frame, const Scene& scene);

    [[nodiscard]] const Snapshot& snapshot() const { return snapshot_; }

private:
    struct Pending {
        Ticket ticket;
        Snapshot asked;  ///< but for the contacts
    };

    void take_over(const Pending& pending);

    Context context_;
    std::uint32_t frames_in_flight_ = 0;
    std::array<ShapeHandle, 2> shapes_;
    // Kept from frame to frame, and with them their memory.
    Batch batch_;
    QueryHandle<ContactQuery> query_;
    Results results_;
    std::deque<Pending> pending_;  ///< oldest first
    Snapshot snapshot_;
};

/// The value, or the library's error thrown: an example has nothing better to do with it.
template <class Value>
Value value_of(Expected<Value> expected) {
    if (!expected.ok()) {
        throw std::runtime_error(expected.status().text());
    }
    return std::move(*expected);
}

}  // namespace nearfield::examples
