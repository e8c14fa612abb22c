#pragma once

#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <string>

namespace nearfield {

/// The error for a handle that names no shape of the context of this number. `where`: for the
/// message, which begins with it.
[[nodiscard]] Status unknown_shape(const std::string& where, ShapeHandle handle,
                                   std::uint32_t context);

}  // namespace nearfield
