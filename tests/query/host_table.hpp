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

// A host's requirements for a library inside its Vulkan device: a test for each row of that table,
// named after it, in the files host_table_*_test.cpp. Every available device is tested under the
// validation layers.

namespace nearfield::test {

/// Two shapes of a context and queries on them.
struct Scene {
    explicit Scene(Context& owner);

    [[nodiscard]] Batch every() const;
    [[nodiscard]] Batch small(double tolerance = 0.1) const;
    [[nodiscard]] Batch on_cpu() const;

    [[nodiscard]] std::vector<double> run(const Batch& batch) const;
    [[nodiscard]] std::vector<double> collect(const Expected<Ticket>& ticket) const;
    /// Records one frame of a host.
    [[nodiscard]] std::vector<double> record(const Batch& batch, test_support::HostFrames& host,
                                             std::uint64_t frame) const;

    Context* context;
    ShapeHandle a;
    ShapeHandle b;
};

class HostTable : public testing::Test {
protected:
    /// The device under test; bare by default.
    const HostDevice& make_host(const test_support::Enabled& enabled = {}) {
        host_.emplace(enabled);
        return host_->device();
    }
    [[nodiscard]] const HostDevice& host() const { return host_->device(); }

    /// Watches every call of contexts on the returned device.
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

/// A context whose host did not enable timeline semaphores rejects a submission that signals one.
void expect_timelines_refused(Context& context, const Batch& batch);

/// The host, recording all names of entry points that the library requests through the host's
/// function. One at a time.
[[nodiscard]] HostDevice noting_names(const HostDevice& host, std::set<std::string>& names);

}  // namespace nearfield::test
