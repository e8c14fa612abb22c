#pragma once

#include "examples/common/painter.hpp"
#include "examples/common/resources.hpp"

#include <nearfield/host.hpp>

#include <tests/support/host_frames.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace nearfield::test {

/// The images of a frame of the engine.
struct EngineFrame {
    std::vector<std::uint32_t> color;  ///< 0xAABBGGRR
    std::vector<std::uint16_t> depth;

    friend bool operator==(const EngineFrame&, const EngineFrame&) = default;
};

/// A minimal Vulkan engine: three frames in flight on one queue, and one colour and one depth image
/// that all frames share. Each frame is one command buffer: a pass of its own, then the guest's
/// commands, then another pass that continues with colour and depth of the first, then copies.
class MinimalEngine {
public:
    static constexpr std::uint32_t frames_in_flight = 3;
    /// Records commands between the engine's passes.
    using Guest = std::function<void(VkCommandBuffer)>;

    MinimalEngine(const HostDevice& host, VkExtent2D extent);

    /// Waits only for its own frames, then recreates its images.
    void resize(VkExtent2D extent);

    /// Waits for the frame `frames_in_flight` before, records this one and submits it.
    void draw(std::uint64_t frame, const Guest& guest);

    /// Waits for one of the last `frames_in_flight` frames and returns its images. Every frame
    /// looks different.
    [[nodiscard]] EngineFrame look_at(std::uint64_t frame);

private:
    struct Slot {
        examples::HostBuffer color;
        examples::HostBuffer depth;
    };

    void begin(VkCommandBuffer commands, VkRenderPass pass);
    void clear_square(VkCommandBuffer commands, std::uint32_t at);
    void copy(VkCommandBuffer commands, const Slot& slot);
    [[nodiscard]] Slot& slot_of(std::uint64_t frame) { return slots_[frame % frames_in_flight]; }

    HostDevice host_;
    VkExtent2D extent_{};
    vk::UniqueRenderPass first_pass_;
    vk::UniqueRenderPass second_pass_;
    examples::Painter first_painter_;
    examples::Painter second_painter_;
    examples::DeviceImage color_;
    examples::DeviceImage depth_;
    vk::UniqueFramebuffer framebuffer_;
    std::array<Slot, frames_in_flight> slots_;
    std::uint64_t next_frame_ = 0;
    test_support::HostFrames frames_;  // last member: waits for what is in flight before the rest
                                       // is destroyed
};

}  // namespace nearfield::test
