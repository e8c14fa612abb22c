#include "two_drivers.hpp"

#include <tests/query/device_offers.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/environment.hpp>

#include <stdexcept>
#include <utility>

namespace nearfield::test {
namespace {

void make_host(std::optional<test_support::VulkanHost>& host, const std::string& manifest) {
    test_support::Enabled wanted;
    wanted.features.logicOp = VK_TRUE;
    const test_support::OnlyDrivers only(manifest);
    host.emplace(wanted);
}

Context make_context(const HostDevice& device) {
    Expected<Context> made = Context::create(device, on_demand());
    if (!made) {
        throw std::runtime_error(made.error().text());
    }
    return std::move(*made);
}

}  // namespace

TwoDrivers::TwoDrivers(const std::string& first, const std::string& second) {
    make_host(hosts_[0], first);
    make_host(hosts_[1], second);
    if (sub_pixel_bits(hosts_[0]->device()) < sub_pixel_bits(hosts_[1]->device())) {
        hosts_[0].reset();
        hosts_[1].reset();
        make_host(hosts_[0], second);
        make_host(hosts_[1], first);
    }
    const std::uint32_t bits = sub_pixel_bits(host(coarser));
    test_support::Lies lies;
    lies.properties = [bits](VkPhysicalDeviceProperties& properties) {
        properties.limits.subPixelPrecisionBits = bits;
    };
    coarsening_.emplace(host(finer), std::move(lies));
    contexts_[finer].emplace(make_context(host(finer)));
    contexts_[coarser].emplace(make_context(host(coarser)));
    contexts_[finer_on_coarser_grid].emplace(make_context(coarsening_->host()));
}

std::vector<std::string> TwoDrivers::close() {
    for (std::optional<Context>& context : contexts_) {
        context.reset();
    }
    coarsening_.reset();
    std::vector<std::string> messages;
    for (std::optional<test_support::VulkanHost>& host : hosts_) {
        for (std::string& message : host->close()) {
            messages.push_back(std::move(message));
        }
    }
    return messages;
}

}  // namespace nearfield::test
