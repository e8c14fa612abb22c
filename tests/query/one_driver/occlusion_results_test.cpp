#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/polygons.hpp>
#include <tests/support/vulkan_host.hpp>

#include <vector>

namespace nearfield::test {
namespace {

using test_support::FakeLoader;
using test_support::Lies;

/// The flags with which occlusion results were copied.
std::vector<VkQueryResultFlags> copied_with;

void VKAPI_CALL copy_results(VkCommandBuffer commands, VkQueryPool pool, std::uint32_t first,
                             std::uint32_t count, VkBuffer target, VkDeviceSize offset,
                             VkDeviceSize stride, VkQueryResultFlags flags) {
    copied_with.push_back(flags);
    reinterpret_cast<PFN_vkCmdCopyQueryPoolResults>(test_support::true_device_function(
        "vkCmdCopyQueryPoolResults"))(commands, pool, first, count, target, offset, stride, flags);
}

/// The drivers of these tests have results as soon as they are asked for; others may not.
TEST(OcclusionResults, AreWaitedForOnTheDevice) {
    test_support::VulkanHost host;
    copied_with.clear();
    {
        Lies lies;
        lies.entry_points["vkCmdCopyQueryPoolResults"] =
            reinterpret_cast<PFN_vkVoidFunction>(&copy_results);
        const FakeLoader fake(host.device(), lies);
        Expected<Context> context = Context::create(fake.host(), on_demand());
        ASSERT_TRUE(context.has_value()) << context.error().text();
        const Expected<ShapeHandle> square = context->add_shape(rectangle({0, 0}, {1, 1}));
        ASSERT_TRUE(square.has_value());
        IntersectionQuery query{{*square, {}}, {*square, {{0.2, 0.1}, 0.0}}, 0.003};
        query.technique = Technique::raster;
        const IntersectionResult result = run_alone(*context, query);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_TRUE(result.intersects);
    }
    EXPECT_FALSE(copied_with.empty());
    for (const VkQueryResultFlags flags : copied_with) {
        EXPECT_NE(flags & VK_QUERY_RESULT_WAIT_BIT, 0U);
        EXPECT_EQ(flags & (VK_QUERY_RESULT_PARTIAL_BIT | VK_QUERY_RESULT_64_BIT), 0U);
    }
    EXPECT_EQ(host.close(), std::vector<std::string>{});
}

}  // namespace
}  // namespace nearfield::test
