#include <engine/base/status_exception.hpp>
#include <engine/gpu/device.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>
#include <tests/unit/gpu/fixture.hpp>

namespace nearfield {
namespace {

class GpuDevice : public test_support::GpuTest {};

constexpr VkMemoryPropertyFlags device_local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
constexpr VkMemoryPropertyFlags coherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

// The memory types of a discrete card, plus two that need a feature, placed where a careless search
// would select them.
test_support::Lies discrete_card() {
    test_support::Lies lies;
    lies.memory = [](VkPhysicalDeviceMemoryProperties& memory) {
        const VkMemoryPropertyFlags all = device_local | visible | coherent | cached;
        const std::vector<VkMemoryPropertyFlags> types{
            all | VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD,
            device_local | VK_MEMORY_PROPERTY_PROTECTED_BIT,
            device_local,
            visible | coherent,
            device_local | visible | coherent,
            visible | coherent | cached,
        };
        memory.memoryTypeCount = static_cast<std::uint32_t>(types.size());
        for (std::size_t i = 0; i < types.size(); ++i) {
            memory.memoryTypes[i] = {types[i], 0};
        }
    };
    return lies;
}

TEST_F(GpuDevice, MemoryTypeHasWhatIsRequiredAndMostOfWhatIsPreferred) {
    const test_support::FakeLoader fake(host_.device(), discrete_card());
    const gpu::Device device(fake.host());
    constexpr std::uint32_t any = ~0U;
    EXPECT_EQ(device.memory_type(any, device_local, 0), 2U);
    EXPECT_EQ(device.memory_type(any, visible, 0), 3U);
    EXPECT_EQ(device.memory_type(any, visible, device_local | coherent), 4U);
    EXPECT_EQ(device.memory_type(any, visible, cached | coherent), 5U);
    EXPECT_EQ(device.memory_type(1U << 3U, visible, cached | device_local), 3U);
    EXPECT_EQ(device.memory_flags(5), visible | coherent | cached);
    EXPECT_THROW((void)device.memory_type(1U << 2U, visible, 0), StatusException);
    EXPECT_THROW((void)device.memory_type(1U << 0U, visible, 0), StatusException);
    EXPECT_THROW((void)device.memory_type(0, 0, 0), StatusException);
}

}  // namespace
}  // namespace nearfield
