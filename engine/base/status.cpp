#include <nearfield/status.hpp>

#include <utility>

namespace nearfield {

const char* to_string(StatusCode code) noexcept {
    switch (code) {
        case StatusCode::ok:
            return "ok";
        case StatusCode::invalid_shape:
            return "invalid_shape";
        case StatusCode::invalid_query:
            return "invalid_query";
        case StatusCode::unknown_shape:
            return "unknown_shape";
        case StatusCode::unknown_instance:
            return "unknown_instance";
        case StatusCode::invalid_settings:
            return "invalid_settings";
        case StatusCode::invalid_submission:
            return "invalid_submission";
        case StatusCode::unknown_ticket:
            return "unknown_ticket";
        case StatusCode::ring_full:
            return "ring_full";
        case StatusCode::not_ready:
            return "not_ready";
        case StatusCode::not_executed:
            return "not_executed";
        case StatusCode::too_large:
            return "too_large";
        case StatusCode::no_device:
            return "no_device";
        case StatusCode::unsupported_device:
            return "unsupported_device";
        case StatusCode::unsupported_strategy:
            return "unsupported_strategy";
        case StatusCode::unsupported_technique:
            return "unsupported_technique";
        case StatusCode::out_of_memory:
            return "out_of_memory";
        case StatusCode::device_lost:
            return "device_lost";
        case StatusCode::device_error:
            return "device_error";
        case StatusCode::unavailable:
            return "unavailable";
        case StatusCode::invalid_shader:
            return "invalid_shader";
        case StatusCode::cancelled:
            return "cancelled";
        case StatusCode::budget_exhausted:
            return "budget_exhausted";
        case StatusCode::overflow:
            return "overflow";
    }
    return "unknown";
}

struct Status::Words {
    std::string message;
    std::vector<std::string> reasons;
};

Status::Status(StatusCode code, std::string message, std::vector<std::string> reasons)
    : code_(code),
      words_(std::make_shared<const Words>(Words{std::move(message), std::move(reasons)})) {}

const std::string& Status::message() const noexcept {
    return words().message;
}

const std::vector<std::string>& Status::reasons() const noexcept {
    return words().reasons;
}

const Status::Words& Status::words() const noexcept {
    static const Words none;
    return words_ ? *words_ : none;
}

std::string Status::text() const {
    std::string text = std::string(to_string(code_)) + ": " + message();
    for (const std::string& reason : reasons()) {
        text += "\n  - " + reason;
    }
    return text;
}

}  // namespace nearfield
