#include <tools/common/library.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {

int exit_status_of(StatusCode code) noexcept {
    switch (code) {
        case StatusCode::invalid_shape:
        case StatusCode::invalid_query:
        case StatusCode::too_large:
            return exit_status::bad_input;
        case StatusCode::no_device:
        case StatusCode::unsupported_device:
        case StatusCode::unsupported_technique:
            return exit_status::no_device;
        case StatusCode::cancelled:
            return exit_status::stopped;
        default:
            return exit_status::other_error;
    }
}

void require(const Status& status, const std::string& subject) {
    if (!status.ok()) {
        throw LibraryError(status, (subject.empty() ? "" : subject + ": ") + status.text());
    }
}

namespace {

/// Why a shape of this ring alone is refused for the ring's own sake; empty if it is not. The
/// library's reason begins with the ring's number, 0.
std::string refusal_of(Context& context, const Ring& ring) {
    constexpr std::string_view name = "ring 0";
    const Expected<ShapeHandle> shape = context.add_shape({&ring, 1});
    if (shape.has_value()) {
        static_cast<void>(context.remove_shape(*shape));
        return {};
    }
    const std::string& reason = shape.error().message();
    return reason.starts_with(name) ? reason.substr(name.size()) : std::string();
}

/// "ring 7 from (3, 4) lies on one line"
std::string describe(std::size_t index, const Ring& ring, const std::string& reason) {
    std::string text = "ring " + std::to_string(index);
    if (!ring.empty()) {
        char place[80];
        std::snprintf(place, sizeof place, " from (%.17g, %.17g)", ring.front().x, ring.front().y);
        text += place;
    }
    return text + reason;
}

}  // namespace

Expected<ShapeHandle> add_shape(Context& context, std::span<const Ring> rings, double deviation) {
    constexpr std::size_t most_listed = 20;
    Expected<ShapeHandle> shape = context.add_shape(rings, deviation);
    if (shape.has_value() || shape.error().code() != StatusCode::invalid_shape) {
        return shape;
    }
    std::size_t count = 0;
    std::vector<std::string> bad;
    for (std::size_t index = 0; index < rings.size(); ++index) {
        const std::string reason = refusal_of(context, rings[index]);
        if (!reason.empty() && ++count <= most_listed) {
            bad.push_back(describe(index, rings[index], reason));
        }
    }
    if (count == 0) {  // refused as a whole
        return shape;
    }
    if (count > most_listed) {
        bad.push_back("and " + std::to_string(count - most_listed) + " more");
    }
    return Status(StatusCode::invalid_shape,
                  std::to_string(count) + " of " + std::to_string(rings.size()) +
                      (rings.size() == 1 ? " ring is bad" : " rings are bad"),
                  std::move(bad));
}

void add_timings(const Timings& more, Timings& sum) {
    sum.localize += more.localize;
    sum.plan += more.plan;
    sum.record += more.record;
    sum.device += more.device;
    sum.decode += more.decode;
    sum.total += more.total;
    sum.queries.insert(sum.queries.end(), more.queries.begin(), more.queries.end());
    for (const PassTime& pass : more.passes) {
        const auto found =
            std::find_if(sum.passes.begin(), sum.passes.end(),
                         [&pass](const PassTime& other) { return other.name == pass.name; });
        if (found == sum.passes.end()) {
            sum.passes.push_back(pass);
        } else {
            found->milliseconds += pass.milliseconds;
        }
    }
}

}  // namespace nearfield::tools
