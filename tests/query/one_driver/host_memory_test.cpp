#include <tests/query/host_table.hpp>
#include <tests/support/host_allocator.hpp>

#include <map>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostAllocator;
using test_support::HostFrames;
using test_support::WatchedCall;

/// Device memory from an engine's own allocator, on a real driver under validation; it may not tell
/// what type of memory it gives.
class HostMemory : public HostTable, public testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(WhoseTypesAre, HostMemory, testing::Bool(), [](const auto& told) {
    return std::string(told.param ? "Told" : "NotTold");
});

TEST_P(HostMemory, IsWhereAllIsKept) {
    make_host();
    HostAllocator allocator(host());
    if (!GetParam()) {
        allocator.bend = [](const MemoryRequest&, MemoryAllocation& given) {
            given.memory_type = unknown_memory_type;
            return VK_SUCCESS;
        };
    }
    std::map<std::string, int> calls;
    std::vector<double> expected;
    {
        Context context = make(host());
        expected = Scene(context).run(Scene(context).every());
    }
    {
        HostDevice device =
            watch([&](const WatchedCall& call) { ++calls[std::string(call.name)]; });
        device.memory = allocator.functions();
        Context context = make(device);
        const Scene scene(context);
        HostFrames frames(host(), 1);
        EXPECT_EQ(scene.run(scene.every()), expected);
        (void)scene.record(scene.every(), frames, 0);
        (void)scene.run(scene.small(0.002));
        EXPECT_EQ(context.memory_use().in_use, allocator.bytes());
        EXPECT_FALSE(allocator.gaps_are_written());

        const std::size_t requests = allocator.requests();
        EXPECT_EQ(scene.run(scene.every()), expected);
        EXPECT_EQ(allocator.requests(), requests) << "a frame like those before it";

        const std::uint64_t before = allocator.bytes();
        context.trim();
        EXPECT_LT(allocator.bytes(), before / 4);
        EXPECT_EQ(scene.run(scene.every()), expected);
        EXPECT_EQ(context.memory_use().in_use, allocator.bytes());
    }
    EXPECT_EQ(calls["vkAllocateMemory"] + calls["vkFreeMemory"] + calls["vkMapMemory"], 0);
    EXPECT_GT(calls["vkBindBufferMemory"], 0);
    EXPECT_GT(allocator.requests(), 20U);
    EXPECT_TRUE(allocator.given().empty());
    EXPECT_EQ(allocator.mistakes(), std::vector<std::string>{});
}

}  // namespace
}  // namespace nearfield::test
