#pragma once

#include <nearfield/vulkan.hpp>

#include <tests/support/host_gpu.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::test {

/// An image of the host that nearfield is to write to, the last level and layer of it. The host's
/// own commands before and after use the transfer stage alone: they fill all of it with a pattern,
/// and copy the level out, with no barrier of the host's towards nearfield or back.
class HostImage {
public:
    /// `extent`: of the level that is written.
    HostImage(test_support::HostGpu& gpu, VkFormat format, VkExtent2D extent);

    [[nodiscard]] const ImageTarget& target() const { return target_; }
    /// Records the filling before nearfield's commands.
    void fill(VkCommandBuffer commands) const;
    /// Records what the host does next: a copy, then another filling.
    void use(VkCommandBuffer commands) const;
    /// The level as it was copied, row by row, once the device is done.
    [[nodiscard]] std::vector<std::uint32_t> words() const;

    static constexpr std::uint32_t pattern = 0xc640e400U;  // -12345 as a float

private:
    void clear(VkCommandBuffer commands, VkImageLayout from, std::uint32_t level,
               std::uint32_t layer) const;

    test_support::HostGpu* gpu_;
    VkExtent2D extent_;
    ImageTarget target_;
    test_support::HostGpu::Buffer copied_;
};

/// A buffer of the host, of which a range in the middle is to be written, and a header before it if
/// `has_header`; used like a HostImage.
class HostBuffer {
public:
    HostBuffer(test_support::HostGpu& gpu, std::uint64_t bytes, bool has_header = false);

    [[nodiscard]] const BufferTarget& target() const { return target_; }
    void fill(VkCommandBuffer commands) const;
    void use(VkCommandBuffer commands) const;
    /// The whole buffer as it was copied.
    [[nodiscard]] std::vector<std::uint32_t> words() const;

    static constexpr std::uint32_t pattern = 0xabcd1234U;

private:
    [[nodiscard]] std::uint64_t all() const {
        return target_.offset + target_.size + target_.offset;
    }

    test_support::HostGpu* gpu_;
    BufferTarget target_;
    test_support::HostGpu::Buffer copied_;
};

}  // namespace nearfield::test
