#pragma once

#include <stdexcept>

namespace nearfield::tools {

/// Bad input or usage. The message names the file or option, the position and the reason. The
/// program ends with exit status 2.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace nearfield::tools
