#include "query_test.hpp"

#include <tests/support/vulkan_host.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

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
            Expected<Context> made = Context::create(host_->device(), on_demand());
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

void expect_answers(const Results& results) {
    for (std::size_t i = 0; i < results.results.size(); ++i) {
        std::visit(
            [&](const auto& result) {
                EXPECT_TRUE(result.status.ok()) << i << ": " << result.status.text();
            },
            results.results[i]);
    }
}

Rectangle box_of(const std::vector<IntersectionSample>& samples) {
    Rectangle box{samples.front().position, samples.front().position};
    for (const IntersectionSample& sample : samples) {
        box.min = {std::min(box.min.x, sample.position.x), std::min(box.min.y, sample.position.y)};
        box.max = {std::max(box.max.x, sample.position.x), std::max(box.max.y, sample.position.y)};
    }
    return box;
}

Settings on_demand(Settings settings) {
    settings.pipelines_on_demand = true;
    return settings;
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
