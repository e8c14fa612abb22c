#include <tools/common/library_error.hpp>

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

}  // namespace nearfield::tools
