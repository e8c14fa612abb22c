#include "query_test.hpp"

#include <tests/support/vulkan_host.hpp>

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

namespace nearfield::test {
namespace {

/// Created once for the whole program and destroyed at its end, while Vulkan is still loaded. The
/// context is created on first use: its pipelines take seconds on some drivers.
class Device : public testing::Environment {
public:
    void SetUp() override { host_.emplace(); }
    void TearDown() override {
        context_.reset();
        for (const std::string& message : host_->close()) {
            ADD_FAILURE() << "validation: " << message;
        }
    }

    Context& context() {
        if (!context_) {
            Expected<Context> made = Context::create(host_->device(), drawing());
            if (!made) {
                throw std::runtime_error(made.error().text());
            }
            context_.emplace(std::move(*made));
        }
        return *context_;
    }

    std::optional<test_support::VulkanHost> host_;

private:
    std::optional<Context> context_;
};

/// Owned by GoogleTest.
Device& device() {
    static Device* const shared = new Device;
    return *shared;
}

const testing::Environment* const registered = testing::AddGlobalTestEnvironment(&device());

}  // namespace

CostModel equally_dear() {
    constexpr WorkCost dear{1.0, 1.0, 1.0};
    constexpr QueryCosts too_dear{dear, dear, dear, dear, dear};
    constexpr DeviceCosts device{1.0, 1.0, too_dear, too_dear, too_dear};
    return {device, device, {too_dear, too_dear}};
}

Settings drawing(Settings settings) {
    settings.costs = equally_dear();
    settings.costs->raster = {};
    settings.pipelines_on_demand = true;
    return settings;
}

Settings with_all_pipelines(Settings settings) {
    settings = drawing(settings);
    settings.pipelines_on_demand = false;
    return settings;
}

int random_cases(int usual) {
    const char* const asked = std::getenv("NEARFIELD_TEST_CASES");
    return asked != nullptr ? std::atoi(asked) : usual;
}

int first_case() {
    const char* const asked = std::getenv("NEARFIELD_TEST_FIRST");
    return asked != nullptr ? std::atoi(asked) : 0;
}

void QueryTest::TearDown() {
    for (const std::string& message : device().host_->messages()) {
        ADD_FAILURE() << "validation: " << message;
    }
    device().host_->clear_messages();
}

Context& QueryTest::context() {
    return device().context();
}

const HostDevice& QueryTest::host_device() {
    return device().host_->device();
}

}  // namespace nearfield::test
