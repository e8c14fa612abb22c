#pragma once

#include <gtest/gtest.h>
#include <tests/support/vulkan_host.hpp>

#include <string>
#include <vector>

namespace nearfield::test_support {

/// A bare device under validation; at the end there must be no messages and no leaked objects.
class GpuTest : public ::testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(host_.close(), std::vector<std::string>{}); }

    VulkanHost host_;
};

}  // namespace nearfield::test_support
