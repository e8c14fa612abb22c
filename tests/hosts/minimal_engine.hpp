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

/// What a frame of the engine looks like.
struct EngineFrame {
    std::vector<std::uint32_t> color;  ///< 0xAABBGGRR
    std::vector<std::uint16_t> depth;

    friend bool operator==(const EngineFrame&, const EngineFrame&) = default;
};

/// A Vulkan engine in small: three frames in flight on one queue, one image of colour and one of
/// depth that all frames share. Each frame is one command buffer: a pass of its own, then whatever
/// a guest records, then another pass that goes on with colour and depth of the first, then copies.
class MinimalEngine {
public:
    static constexpr std::uint32_t frames_in_flight = 3;
    /// Records between the engine's passes.
    using Guest = std::function<void(VkCommandBuffer)>;

    MinimalEngine(const HostDevice& host, VkExtent2D extent);

    /// Waits for its own frames alone, then makes its images anew.
    void resize(VkExtent2D extent);

    /// Waits for the frame `frames_in_flight` before, records this one and submits it.
    void draw(std::uint64_t frame, const Guest& guest);

    /// Waits for a frame, of the last `frames_in_flight`. Every frame looks different.
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
    examples::RenderPass first_pass_;
    examples::RenderPass second_pass_;
    examples::Painter first_painter_;
    examples::Painter second_painter_;
    examples::DeviceImage color_;
    examples::DeviceImage depth_;
    examples::Framebuffer framebuffer_;
    std::array<Slot, frames_in_flight> slots_;
    std::uint64_t next_frame_ = 0;
    test_support::HostFrames frames_;  // last: waits for what is in flight before the rest goes
};

}  // namespace nearfield::test
