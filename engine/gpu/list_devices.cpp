#include <engine/base/catch_to_status.hpp>
#include <engine/gpu/instance.hpp>
#include <nearfield/diagnostics.hpp>

#include <string>
#include <utility>
#include <vector>

namespace nearfield {
namespace {

std::string dotted(std::uint32_t major, std::uint32_t minor, std::uint32_t patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::string driver_text(const VkPhysicalDeviceProperties& properties) {
    constexpr std::uint32_t nvidia = 0x10DE;
    const std::uint32_t driver = properties.driverVersion;
    const std::uint32_t api = properties.apiVersion;
    // The encoding is up to the driver; NVIDIA's differs from Vulkan's own packing enough to change
    // the well-known version number.
    const std::string version =
        properties.vendorID == nvidia
            ? dotted(driver >> 22U, (driver >> 14U) & 0xFFU, (driver >> 6U) & 0xFFU)
            : dotted(VK_API_VERSION_MAJOR(driver), VK_API_VERSION_MINOR(driver),
                     VK_API_VERSION_PATCH(driver));
    return "driver " + version + ", Vulkan " +
           dotted(VK_API_VERSION_MAJOR(api), VK_API_VERSION_MINOR(api), VK_API_VERSION_PATCH(api));
}

}  // namespace

Expected<std::vector<DeviceReport>> list_devices() {
    return catch_to_expected([] {
        std::vector<DeviceReport> reports;
        const gpu::Instance instance;
        for (gpu::Candidate& candidate : instance.candidates()) {
            DeviceReport& report = reports.emplace_back();
            report.name = candidate.properties.deviceName;
            report.driver = driver_text(candidate.properties);
            report.usable = candidate.requirements.met();
            report.missing = std::move(candidate.requirements.unmet);
            report.optional = std::move(candidate.requirements.optional);
            for (std::size_t i = 0; i < intersection_strategies; ++i) {
                const auto strategy = static_cast<IntersectionStrategy>(i);
                report.strategies.push_back(
                    {strategy, gpu::missing_for(strategy, candidate.support)});
            }
        }
        return reports;
    });
}

}  // namespace nearfield
