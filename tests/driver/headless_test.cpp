#include <nearfield/vulkan.hpp>

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/driver_errors.hpp>

#include <map>
#include <stdexcept>

namespace nearfield::test {
namespace {

using test_support::errors_of;
using test_support::MockDriver;
using test_support::name_of;

/// Our own Vulkan loader with the usual name, which the library finds because it is already loaded;
/// below it is the mock driver.
class Headless : public ::testing::Test {
protected:
    Headless() : library_(dlopen(NEARFIELD_FAKE_VULKAN, RTLD_NOW | RTLD_LOCAL)) {
        if (library_ == nullptr) {
            throw std::runtime_error(dlerror());
        }
        *target() = driver_.host().get_instance_proc_addr;
        driver_.go_without_host();
    }
    ~Headless() override {
        expect_nothing_left();
        *target() = nullptr;
        dlclose(library_);
    }

    void expect_nothing_left() {
        EXPECT_EQ(driver_.alive(), std::vector<std::string>{});
        EXPECT_EQ(driver_.breaches(), std::vector<std::string>{});
    }
    /// The calls of a run without failures.
    template <class Act>
    std::vector<std::string_view> calls_of(const Act& act) {
        driver_.forget_calls();
        const Status status = act();
        EXPECT_TRUE(status.ok()) << status.text();
        return driver_.calls();
    }
    /// Makes each call of a run fail with each of its errors; of frequent calls only the first and
    /// last ones. `expected`: the library's status for it.
    template <class Act, class Expect>
    void try_all(const Act& act, const Expect& expected) {
        std::map<std::string_view, std::size_t> total, count;
        const std::vector<std::string_view> calls = calls_of(act);
        for (const std::string_view call : calls) {
            ++total[call];
        }
        for (const std::string_view call : calls) {
            const std::size_t before = count[call]++;
            if (before > 1 && before + 1 < total[call]) {
                continue;
            }
            for (const VkResult error : errors_of(call)) {
                SCOPED_TRACE(::testing::Message()
                             << "call " << before << " of " << call << " says " << name_of(error));
                driver_.fail(call, before, error, MockDriver::Failing::once);
                const Status status = act();
                ASSERT_TRUE(driver_.has_failed());
                expected(status, call, before, error);
                expect_nothing_left();
            }
        }
    }

    MockDriver driver_;

private:
    [[nodiscard]] PFN_vkGetInstanceProcAddr* target() const {
        return static_cast<PFN_vkGetInstanceProcAddr*>(dlsym(library_, "nearfield_fake_target"));
    }

    void* library_;
};

Status create_and_destroy() {
    return Context::create_headless().error();
}

/// The status code for a failing call, if it differs from that of the error itself.
StatusCode code_of_call(std::string_view call, std::size_t before, VkResult error) {
    if (call == "vkCreateInstance") {
        return StatusCode::no_device;
    }
    if (call == "vkCreateDevice") {
        return StatusCode::unsupported_device;
    }
    // This is how some loaders report that no driver has a device.
    const bool counting = call == "vkEnumeratePhysicalDevices" && before == 0;
    return counting && error == VK_ERROR_INITIALIZATION_FAILED ? StatusCode::no_device
                                                               : code_of(error);
}

TEST_F(Headless, CreationThatFailsIsNamedAndLeaksNothing) {
    try_all(create_and_destroy, [](const Status& status, std::string_view call, std::size_t before,
                                   VkResult error) {
        EXPECT_EQ(status.code(), code_of_call(call, before, error)) << status.text();
        if (call == "vkEnumeratePhysicalDevices" && status.code() == StatusCode::no_device) {
            return;
        }
        EXPECT_NE(status.text().find(call), std::string::npos) << status.text();
        EXPECT_NE(status.text().find(name_of(error)), std::string::npos) << status.text();
    });
    EXPECT_TRUE(create_and_destroy().ok());
}

TEST_F(Headless, ContextAnswersAndGoes) {
    Expected<Context> context = Context::create_headless();
    ASSERT_TRUE(context.has_value()) << context.error().text();
    const Expected<ShapeHandle> shape = context->add_shape({{{{0, 0}, {1, 0}, {0, 1}}}});
    ASSERT_TRUE(shape.has_value());
    Batch batch;
    batch.add(IntersectionQuery{{*shape, {}}, {*shape, {}}, 0.1});
    Results results;
    const Status status = context->run(batch, results);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(context->device_name(), "nearfield mock driver");
}

TEST_F(Headless, DevicesThatCannotBeListedAreNamed) {
    const auto list = [] {
        const auto devices = list_devices();
        EXPECT_TRUE(!devices || devices->size() < 2);
        return devices.error();
    };
    try_all(list,
            [](const Status& status, std::string_view call, std::size_t before, VkResult error) {
                const bool none = call == "vkEnumeratePhysicalDevices" && before == 0 &&
                                  error == VK_ERROR_INITIALIZATION_FAILED;
                EXPECT_EQ(status.code(), none ? StatusCode::ok : code_of_call(call, before, error))
                    << status.text();
                EXPECT_TRUE(none || status.text().find(call) != std::string::npos) << status.text();
            });
}

/// Entry points of loader and instance; those of the device are fetched as on a host's device.
TEST_F(Headless, CallsThatTheLoaderDoesNotKnowAreNamed) {
    for (const std::string call :
         {"vkEnumerateInstanceExtensionProperties", "vkCreateInstance",
          "vkEnumeratePhysicalDevices", "vkCreateDevice", "vkGetDeviceQueue", "vkDestroyDevice"}) {
        SCOPED_TRACE(call);
        driver_.hide(call);
        const Status status = create_and_destroy();
        EXPECT_EQ(status.code(), StatusCode::no_device) << status.text();
        EXPECT_NE(status.message().find(call), std::string::npos) << status.text();
        expect_nothing_left();
    }
    driver_.hide({});
    EXPECT_TRUE(create_and_destroy().ok());
}

}  // namespace
}  // namespace nearfield::test
