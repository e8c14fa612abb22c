#include <engine/gpu/buffer.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>
#include <tests/unit/gpu/compute_task.hpp>
#include <tests/unit/gpu/fixture.hpp>

#include <cstring>
#include <random>
#include <vector>

namespace nearfield {
namespace {

using gpu::Direction;
using gpu::MappedBuffer;
using test_support::FakeLoader;
using test_support::Lies;

constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

class GpuBuffer : public test_support::GpuTest {};

void expect_round_trip(const gpu::Device& device, std::uint32_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    constexpr std::uint32_t count = 50000;
    std::mt19937 random(seed);
    std::vector<std::uint32_t> values(count);
    for (std::uint32_t& value : values) {
        value = static_cast<std::uint32_t>(random());
    }
    MappedBuffer source(device, storage, Direction::upload, "source");
    MappedBuffer target(device, storage, Direction::readback, "target");
    test_support::ComputeTask task(device);
    gpu::Submission submission(device);
    // Twice, so that the second pass uses buffers that have grown.
    for (const std::uint32_t used : {100U, count}) {
        const std::size_t bytes = used * sizeof(std::uint32_t);
        EXPECT_TRUE(source.reserve(bytes));
        EXPECT_TRUE(target.reserve(bytes));
        std::memcpy(source.data(), values.data(), bytes);
        source.flush();
        task.bind(source, target);
        task.record(submission.begin(), used);
        submission.submit();
        submission.wait();
        target.invalidate();
        std::vector<std::uint32_t> results(used);
        std::memcpy(results.data(), target.data(), bytes);
        for (std::uint32_t i = 0; i < used; ++i) {
            ASSERT_EQ(results[i], 2 * values[i] + 1) << "element " << i << " of " << used;
        }
    }
}

TEST_F(GpuBuffer, GrowsGeometricallyAndKeepsWhatSuffices) {
    const gpu::Device device(host_.device());
    MappedBuffer buffer(device, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, Direction::upload, "vertices");
    EXPECT_EQ(buffer.handle(), VkBuffer{VK_NULL_HANDLE});
    EXPECT_TRUE(buffer.reserve(0));
    EXPECT_GE(buffer.capacity(), 1U);
    std::uint64_t replaced = 0;
    for (std::uint64_t bytes = 1; bytes < 4'000'000; bytes += 999) {
        const VkBuffer former = buffer.handle();
        const std::uint64_t capacity = buffer.capacity();
        const bool grew = buffer.reserve(bytes);
        EXPECT_EQ(grew, bytes > capacity);
        EXPECT_GE(buffer.capacity(), bytes);
        EXPECT_EQ(buffer.capacity() % 65536, 0U);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.data()) % 64, 0U);
        if (grew) {
            ++replaced;
            EXPECT_GE(2 * buffer.capacity(), 3 * capacity);
            std::memset(buffer.data(), 0xAB, buffer.capacity());
        } else {
            EXPECT_EQ(buffer.handle(), former);
        }
    }
    EXPECT_GE(replaced, 1U);
    EXPECT_LE(replaced, 12U);
}

std::uint32_t flushes = 0;
std::uint32_t invalidations = 0;

VkResult VKAPI_CALL counted_flush(VkDevice device, std::uint32_t count,
                                  const VkMappedMemoryRange* ranges) {
    ++flushes;
    return reinterpret_cast<PFN_vkFlushMappedMemoryRanges>(
        test_support::true_device_function("vkFlushMappedMemoryRanges"))(device, count, ranges);
}

VkResult VKAPI_CALL counted_invalidate(VkDevice device, std::uint32_t count,
                                       const VkMappedMemoryRange* ranges) {
    ++invalidations;
    return reinterpret_cast<PFN_vkInvalidateMappedMemoryRanges>(test_support::true_device_function(
        "vkInvalidateMappedMemoryRanges"))(device, count, ranges);
}

TEST_F(GpuBuffer, FlushesAndInvalidatesOnlyWhatIsNotCoherent) {
    for (const bool coherent : {false, true}) {
        SCOPED_TRACE(coherent ? "coherent" : "not coherent");
        Lies lies;
        lies.memory = [coherent](VkPhysicalDeviceMemoryProperties& memory) {
            for (std::uint32_t i = 0; i < memory.memoryTypeCount && !coherent; ++i) {
                memory.memoryTypes[i].propertyFlags &=
                    ~static_cast<VkMemoryPropertyFlags>(VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
            }
        };
        lies.entry_points["vkFlushMappedMemoryRanges"] =
            reinterpret_cast<PFN_vkVoidFunction>(&counted_flush);
        lies.entry_points["vkInvalidateMappedMemoryRanges"] =
            reinterpret_cast<PFN_vkVoidFunction>(&counted_invalidate);
        flushes = 0;
        invalidations = 0;
        const FakeLoader fake(host_.device(), lies);
        const gpu::Device device(fake.host());
        expect_round_trip(device, 2);
        EXPECT_EQ(flushes, coherent ? 0U : 2U);
        EXPECT_EQ(invalidations, coherent ? 0U : 2U);
    }
}

}  // namespace
}  // namespace nearfield
