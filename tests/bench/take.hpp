#pragma once

#include <nearfield/status.hpp>

#include <stdexcept>
#include <utility>

namespace nearfield::bench {

/// Throws std::runtime_error if the status is an error.
inline void require(const Status& status) {
    if (!status.ok()) {
        throw std::runtime_error(status.text());
    }
}

/// Returns the value or throws std::runtime_error.
template <class Value>
[[nodiscard]] Value take(Expected<Value> value) {
    require(value.error());
    return std::move(*value);
}

}  // namespace nearfield::bench
