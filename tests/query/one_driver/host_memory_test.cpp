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

/// Device memory from an engine's own allocator, on a real driver under validation.
TEST_F(HostTable, DeviceMemoryIsTheHosts) {
    make_host();
    HostAllocator allocator(host());
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
