#pragma once

#include <nearfield/status.hpp>

#include <stdexcept>
#include <utility>

namespace nearfield::examples {

/// The value, or the library's error thrown: an example has nothing better to do with it.
template <class Value>
Value value_of(Expected<Value> expected) {
    if (!expected.ok()) {
        throw std::runtime_error(expected.status().text());
    }
    return std::move(*expected);
}

}  // namespace nearfield::examples
