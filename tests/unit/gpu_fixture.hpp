#pragma once

#include <gtest/gtest.h>
#include <tests/support/vulkan_host.hpp>

#include <string>
#include <vector>

namespace nearfield::test_support {

/// A bare device under validation; afterwards nothing may have been complained about or left
/// behind.
class GpuTest : public ::testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(host_.close(), std::vector<std::string>{}); }

    VulkanHost host_;
};

}  // namespace nearfield::test_support
