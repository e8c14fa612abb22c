#include <engine/gpu/memory.hpp>

#include <gtest/gtest.h>
#include <tests/unit/gpu/fixture.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace nearfield {
namespace {

using gpu::DeviceMemory;
using gpu::MemoryKind;

class GpuMemory : public test_support::GpuTest {};

constexpr gpu::MemoryWish visible_wish{VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT, 0};
constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20U;

DeviceMemory take(const gpu::Device& device, std::uint64_t bytes, std::uint64_t alignment = 16,
                  MemoryKind kind = MemoryKind::mapped_buffer) {
    return device.memory().allocate({bytes, alignment, ~0U}, visible_wish, kind, "a test");
}

TEST_F(GpuMemory, PiecesOfABlockDoNotOverlapWhateverIsGivenBack) {
    const gpu::Device device(host_.device());
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::vector<DeviceMemory> taken;
        std::uint64_t asked = 0;
        for (int step = 0; step < 400; ++step) {
            if (random() % 3 == 0 && !taken.empty()) {
                std::swap(taken[random() % taken.size()], taken.back());
                taken.pop_back();
                continue;
            }
            const std::uint64_t bytes = 1 + random() % (random() % 20 == 0 ? 3 * mebibyte : 90'000);
            const std::uint64_t alignment = std::uint64_t{1} << (random() % 13);
            const auto kind = static_cast<MemoryKind>(random() % 3);
            taken.push_back(take(device, bytes, alignment, kind));
            EXPECT_GE(taken.back().size(), bytes);
            EXPECT_EQ(taken.back().offset() % alignment, 0U);
            EXPECT_EQ(taken.back().data() != nullptr, kind == MemoryKind::mapped_buffer);
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(taken.back().data()) % 64, 0U);
            if (kind == MemoryKind::mapped_buffer) {  // flushing a piece touches no other
                const std::uint64_t atom = device.limits().nonCoherentAtomSize;
                EXPECT_EQ(taken.back().offset() % atom, 0U);
                EXPECT_EQ(taken.back().size() % atom, 0U);
            }
            asked += bytes;
        }
        std::map<VkDeviceMemory, std::vector<std::pair<std::uint64_t, std::uint64_t>>> pieces;
        for (const DeviceMemory& piece : taken) {
            pieces[piece.get()].emplace_back(piece.offset(), piece.offset() + piece.size());
        }
        for (auto& [memory, in_it] : pieces) {
            std::sort(in_it.begin(), in_it.end());
            for (std::size_t i = 1; i < in_it.size(); ++i) {
                EXPECT_LE(in_it[i - 1].second, in_it[i].first);
            }
        }
        EXPECT_LT(pieces.size(), 24U);
        EXPECT_GT(device.memory_count().in_use(), 0U);
        taken.clear();
        EXPECT_EQ(device.memory_count().in_use(), 0U) << "empty blocks are freed";
        EXPECT_GT(asked, mebibyte);
    }
}

TEST_F(GpuMemory, GapsAreUsedAgain) {
    const gpu::Device device(host_.device());
    const DeviceMemory first = take(device, 500'000);
    DeviceMemory middle = take(device, 500'000);
    const DeviceMemory last = take(device, 500'000);
    EXPECT_EQ(first.get(), last.get());
    const std::uint64_t gap = middle.offset();
    middle.reset();
    EXPECT_EQ(middle.get(), VkDeviceMemory{VK_NULL_HANDLE});
    const DeviceMemory larger = take(device, 510'000);
    EXPECT_NE(larger.offset(), gap);
    const DeviceMemory again = take(device, 490'000);
    EXPECT_EQ(again.offset(), gap);
    EXPECT_EQ(again.get(), first.get());
    EXPECT_EQ(device.memory_count().in_use(), 2 * mebibyte);
}

TEST_F(GpuMemory, ImagesMappedAndOtherBuffersHaveBlocksOfTheirOwn) {
    const gpu::Device device(host_.device());
    const DeviceMemory mapped = take(device, 100);
    const DeviceMemory buffer = take(device, 100, 16, MemoryKind::buffer);
    const DeviceMemory image = take(device, 100, 16, MemoryKind::image);
    EXPECT_NE(mapped.get(), buffer.get());
    EXPECT_NE(mapped.get(), image.get());
    EXPECT_NE(buffer.get(), image.get());
}

TEST_F(GpuMemory, BlocksGrowWithWhatIsHeld) {
    const gpu::Device device(host_.device());
    std::vector<DeviceMemory> taken;
    std::map<VkDeviceMemory, int> blocks;
    for (int i = 0; i < 100; ++i) {
        taken.push_back(take(device, mebibyte));
        ++blocks[taken.back().get()];
    }
    EXPECT_LE(blocks.size(), 8U);
    EXPECT_LE(device.memory_count().in_use(), 200 * mebibyte);
    const DeviceMemory huge = take(device, 100 * mebibyte);
    EXPECT_EQ(blocks.count(huge.get()), 0U);
}

}  // namespace
}  // namespace nearfield
