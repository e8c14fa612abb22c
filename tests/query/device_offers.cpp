#include "device_offers.hpp"

#include <engine/geometry/mesh.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

namespace nearfield::test {

PhysicalDevice physical_device_of(const HostDevice& host) {
    PhysicalDevice device;
    device.instance = host.instance;
    device.physical_device = host.physical_device;
    device.get_instance_proc_addr = host.get_instance_proc_addr;
    device.debug_utils = host.debug_utils;
    return device;
}

bool offers(const HostDevice& host, const char* part) {
    const Expected<Requirements> found = requirements(physical_device_of(host));
    EXPECT_TRUE(found.has_value()) << found.error().text();
    const OptionalPart* const optional = found.has_value() ? found->find(part) : nullptr;
    EXPECT_NE(optional, nullptr) << part << " is no optional part";
    return optional != nullptr && optional->available;
}

std::uint32_t sub_pixel_bits(const HostDevice& host) {
    const Expected<Requirements> found = requirements(physical_device_of(host));
    EXPECT_TRUE(found.has_value()) << found.error().text();
    for (const RequiredLimit& limit : found->limits) {
        if (std::string_view(limit.name) == "subPixelPrecisionBits") {
            return limit.offered;
        }
    }
    ADD_FAILURE() << "the limit is not among the requirements";
    return 0;
}

bool has_grid_of_cpu(const HostDevice& host) {
    return std::exp2(sub_pixel_bits(host)) == geometry::cpu_grid.steps;
}

void expect_logic_op_refused(const IntersectionResult& result) {
    const Status& refusal = result.status;
    EXPECT_EQ(refusal.code(), StatusCode::unsupported_strategy);
    EXPECT_NE(refusal.message().find("logic_op"), std::string::npos) << refusal.text();
    ASSERT_EQ(refusal.reasons().size(), 1U) << refusal.text();
    EXPECT_EQ(refusal.reasons()[0].find("feature logicOp: "), 0U) << refusal.text();
    EXPECT_EQ(result.count, 0U);
    EXPECT_TRUE(result.samples.empty());
}

}  // namespace nearfield::test
