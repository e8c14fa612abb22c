#include <engine/base/status_exception.hpp>
#include <engine/gpu/timestamps.hpp>

#include <algorithm>
#include <array>

namespace nearfield::gpu {
namespace {

void add(std::vector<PassTime>& times, const char* name, double milliseconds) {
    const auto known = std::find_if(times.begin(), times.end(),
                                    [name](const PassTime& time) { return time.name == name; });
    if (known != times.end()) {
        known->milliseconds = std::max(known->milliseconds, 0.0) + milliseconds;
    } else {
        times.push_back({name, milliseconds});
    }
}

}  // namespace

Timestamps::Timestamps(const Device& device, std::uint32_t capacity, bool on)
    : device_(&device), on_(on && device.timestamp_bits() > 0), capacity_(capacity) {
    if (!on_ || capacity == 0) {
        return;
    }
    names_.reserve(capacity);
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 2 * capacity;
    pool_ = make_object(device, info, "the timestamps of the passes", "timestamps");
}

void Timestamps::reserve(std::uint32_t capacity) {
    if (capacity > capacity_) {
        *this = Timestamps(*device_, capacity, on_);
    }
}

void Timestamps::reset(VkCommandBuffer commands) {
    names_.clear();
    if (pool_) {
        device_->functions().vkCmdResetQueryPool(commands, pool_.get(), 0, 2 * capacity_);
    }
}

void Timestamps::begin(VkCommandBuffer commands, const char* name) {
    if (!on_) {
        return;
    }
    if (names_.size() == capacity_) {
        throw StatusException(Status(StatusCode::device_error,
                                     std::string("no timestamps left for pass '") + name +
                                         "': there are " + std::to_string(capacity_) + " pairs"));
    }
    const auto query = static_cast<std::uint32_t>(2 * names_.size());
    names_.push_back(name);
    device_->functions().vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                             pool_.get(), query);
}

void Timestamps::end(VkCommandBuffer commands) {
    if (pool_) {
        const auto query = static_cast<std::uint32_t>(2 * names_.size() - 1);
        device_->functions().vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT,
                                                 pool_.get(), query);
    }
}

void Timestamps::collect(std::vector<PassTime>& times) const {
    const std::uint32_t bits = device_->timestamp_bits();
    const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    const double milliseconds_per_tick =
        static_cast<double>(device_->limits().timestampPeriod) * 1e-6;
    std::uint32_t query = 0;
    for (const char* name : names_) {
        std::array<std::uint64_t, 2> ticks{};
        const VkResult result = device_->functions().vkGetQueryPoolResults(
            device_->handle(), pool_.get(), query, 2, sizeof(ticks), ticks.data(), sizeof(ticks[0]),
            VK_QUERY_RESULT_64_BIT);
        check(result, "vkGetQueryPoolResults", name);
        if (result == VK_NOT_READY) {
            return;  // a driver that drops timestamps does not invalidate results
        }
        // Modulo the valid bits, the difference is correct across a wrap of the counter, too.
        const std::uint64_t elapsed = (ticks[1] - ticks[0]) & mask;
        add(times, name, static_cast<double>(elapsed) * milliseconds_per_tick);
        query += 2;
    }
}

}  // namespace nearfield::gpu
