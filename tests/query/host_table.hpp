#pragma once

#include <tests/query/query_test.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/vulkan_host.hpp>
#include <tests/support/watched_loader.hpp>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

// What a host wants of a library inside its Vulkan device: a test for each row of that table, named
// after it, in the files host_table_*_test.cpp. Every device there is under the validation layers.

namespace nearfield::test {

/// Two shapes of a context and what can be asked of them.
struct Scene {
    explicit Scene(Context& owner);

    [[nodiscard]] Batch every(bool recordable = false) const;
    [[nodiscard]] Batch small(double tolerance = 0.1) const;
    [[nodiscard]] Batch on_cpu() const;

    [[nodiscard]] std::vector<double> run(const Batch& batch) const;
    [[nodiscard]] std::vector<double> collect(const Expected<Ticket>& ticket) const;
    /// One frame of a host that records.
    [[nodiscard]] std::vector<double> record(const Batch& batch, test_support::HostFrames& host,
                                             std::uint64_t frame) const;

    Context* context;
    ShapeHandle a;
    ShapeHandle b;
};

class HostTable : public testing::Test {
protected:
    /// The device that a test is about; bare unless asked for.
    const HostDevice& make_host(const test_support::Enabled& enabled = {}) {
        host_.emplace(enabled);
        return host_->device();
    }
    [[nodiscard]] const HostDevice& host() const { return host_->device(); }

    /// Watches every call that contexts on the returned device make.
    const HostDevice& watch(std::function<void(const test_support::WatchedCall&)> watcher) {
        loader_.emplace(host(), test_support::watched(host(), std::move(watcher)));
        return loader_->host();
    }

    static Context make(const HostDevice& device, std::uint32_t frames = 2);

    void TearDown() override {
        loader_.reset();
        EXPECT_EQ(host_->close(), std::vector<std::string>{});
    }

private:
    std::optional<test_support::VulkanHost> host_;
    std::optional<test_support::FakeLoader> loader_;
};

/// A context whose host did not enable timeline semaphores says so to who has one signalled.
void expect_timelines_refused(Context& context, const Batch& batch);

/// The host, with every name noted that the library asks for: entry points, through the one
/// function that a host hands over. One at a time.
[[nodiscard]] HostDevice noting_names(const HostDevice& host, std::set<std::string>& names);

}  // namespace nearfield::test
