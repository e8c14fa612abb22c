#pragma once

#include <nearfield/status.hpp>

#include <stdexcept>
#include <utility>

namespace nearfield::examples {

/// Returns the value or throws the library's error; examples have no better error handling.
template <class Value>
Value value_of(Expected<Value> expected) {
    if (!expected) {
        throw std::runtime_error(expected.error().text());
    }
    return std::move(*expected);
}

}  // namespace nearfield::examples
