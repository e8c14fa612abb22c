#include <engine/base/status_exception.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/headless.hpp>
#include <engine/gpu/submission.hpp>
#include <nearfield/diagnostics.hpp>

#include <gtest/gtest.h>
#include <tests/support/environment.hpp>

#include <algorithm>
#include <string>

namespace nearfield {
namespace {

using test_support::Environment;

Status headless_status(const char* device_name) {
    try {
        const gpu::HeadlessDevice headless(HeadlessOptions{.device_name = device_name});
        return {};
    } catch (const StatusException& failure) {
        return failure.status();
    }
}

std::vector<DeviceReport> devices() {
    Expected<std::vector<DeviceReport>> reports = list_devices();
    EXPECT_TRUE(reports.has_value()) << reports.error().text();
    return reports.has_value() ? *reports : std::vector<DeviceReport>{};
}

void submit_nothing(const HostDevice& host) {
    const gpu::Device device(host);
    gpu::Submission submission(device);
    (void)submission.begin();
    submission.submit();
    submission.wait();
}

TEST(GpuHeadless, MakesADeviceThatWorks) {
    const gpu::HeadlessDevice headless(HeadlessOptions{});
    EXPECT_NE(headless.host().queue, VkQueue{VK_NULL_HANDLE});
    submit_nothing(headless.host());
}

// Without a messenger the layer prints to standard output.
TEST(GpuHeadless, ValidationHasNothingToSay) {
    const Environment layers("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation");
    testing::internal::CaptureStdout();
    {
        const gpu::HeadlessDevice headless(HeadlessOptions{});
        submit_nothing(headless.host());
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

// Shows that the test above would detect a message.
TEST(GpuHeadless, ValidationWouldBeHeard) {
    const Environment layers("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation");
    testing::internal::CaptureStdout();
    {
        const gpu::HeadlessDevice headless(HeadlessOptions{});
        const gpu::Device device(headless.host());
        VkFenceCreateInfo wrong{};
        VkFence fence = VK_NULL_HANDLE;
        (void)device.functions().vkCreateFence(device.handle(), &wrong, nullptr, &fence);
        device.functions().vkDestroyFence(device.handle(), fence, nullptr);
    }
    EXPECT_NE(testing::internal::GetCapturedStdout().find("VUID"), std::string::npos);
}

TEST(GpuHeadless, ListsDevicesWithoutMakingAny) {
    const std::vector<DeviceReport> reports = devices();
    ASSERT_FALSE(reports.empty());
    EXPECT_TRUE(std::any_of(reports.begin(), reports.end(),
                            [](const DeviceReport& report) { return report.usable; }));
    for (const DeviceReport& report : reports) {
        EXPECT_FALSE(report.name.empty());
        EXPECT_NE(report.driver.find("Vulkan 1."), std::string::npos) << report.driver;
        EXPECT_EQ(report.usable, report.missing.empty());
        ASSERT_EQ(report.strategies.size(), intersection_strategies);
        EXPECT_TRUE(report.strategies[0].missing.empty());
    }
}

TEST(GpuHeadless, FindsEveryUsableDeviceByAPartOfItsName) {
    for (const DeviceReport& report : devices()) {
        if (!report.usable) {
            continue;
        }
        SCOPED_TRACE(report.name);
        const std::string part = report.name.substr(1, report.name.size() / 2);
        const gpu::HeadlessDevice headless(HeadlessOptions{.device_name = part.c_str()});
        EXPECT_NE(gpu::Device(headless.host()).name().find(part), std::string::npos);
    }
}

TEST(GpuHeadless, UnknownNameListsWhatThereIs) {
    const std::vector<DeviceReport> reports = devices();
    const Status status = headless_status("no such device");
    EXPECT_EQ(status.code(), StatusCode::no_device);
    EXPECT_NE(status.message().find("'no such device'"), std::string::npos);
    ASSERT_EQ(status.reasons().size(), reports.size());
    for (std::size_t i = 0; i < reports.size(); ++i) {
        EXPECT_NE(status.reasons()[i].find(reports[i].name), std::string::npos);
    }
}

TEST(GpuHeadless, MachineWithoutDriversHasNoDevice) {
    const test_support::OnlyDrivers none("/nonexistent.json");
    const Status status = headless_status(nullptr);
    EXPECT_EQ(status.code(), StatusCode::no_device);
    EXPECT_NE(status.message().find("mesa-vulkan-drivers"), std::string::npos) << status.text();
    EXPECT_EQ(list_devices().error().code(), StatusCode::no_device);
}

}  // namespace
}  // namespace nearfield
