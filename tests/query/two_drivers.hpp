#pragma once

#include <nearfield/vulkan.hpp>

#include <tests/support/fake_loader.hpp>
#include <tests/support/vulkan_host.hpp>

#include <array>
#include <optional>
#include <string>

namespace nearfield::test {

/// A context on each of two Vulkan drivers in one process, validated, with the feature logicOp if
/// available. A third context is on the driver with the finer sub-pixel grid but assumes the
/// coarser one: vertices on the coarser grid are on the finer one too, so the raster draws them
/// exactly, and both drivers can have the same plan. One at a time, as with FakeLoader.
class TwoDrivers {
public:
    /// The drivers of two manifests (VK_DRIVER_FILES). Throws std::runtime_error if one has no
    /// usable device.
    TwoDrivers(const std::string& first, const std::string& second);

    enum Which { finer, coarser, finer_on_coarser_grid };
    static constexpr std::array all{finer, coarser, finer_on_coarser_grid};

    [[nodiscard]] Context& context(Which which) { return *contexts_[which]; }
    [[nodiscard]] const HostDevice& host(Which which) const {
        return hosts_[which == coarser ? 1U : 0U]->device();
    }

    /// Destroys everything. Returns the messages of the validation layers for each driver.
    [[nodiscard]] std::vector<std::string> close();

private:
    std::array<std::optional<test_support::VulkanHost>, 2> hosts_;  // finer, coarser
    std::optional<test_support::FakeLoader> coarsening_;
    std::array<std::optional<Context>, 3> contexts_;
};

}  // namespace nearfield::test
