#pragma once

#include <nearfield/status.hpp>

#include <exception>
#include <utility>

namespace nearfield {

/// Carries a Status from deep inside the engine to the public API, where it becomes a return value.
/// Thrown only inside the library; no exception crosses the public interface.
class StatusException : public std::exception {
public:
    explicit StatusException(Status status) : status_(std::move(status)) {}

    [[nodiscard]] const Status& status() const noexcept { return status_; }
    [[nodiscard]] const char* what() const noexcept override { return status_.message().c_str(); }

private:
    Status status_;
};

}  // namespace nearfield
