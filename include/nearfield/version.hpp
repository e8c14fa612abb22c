#pragma once

#include <nearfield/export.hpp>

/// \file
/// The version of the headers that a program was compiled with, and of the library that it runs
/// with.

/// Version of the headers, major number: raised when something is removed or changes its meaning
/// (as long as it is 0, the minor number is raised instead).
#define NEARFIELD_VERSION_MAJOR 0
/// Minor number: raised when something is added.
#define NEARFIELD_VERSION_MINOR 1
/// Patch number: raised when something is fixed.
#define NEARFIELD_VERSION_PATCH 0
/// All three numbers as text.
#define NEARFIELD_VERSION "0.1.0"
/// ABI version, the number in the shared library's file name (libnearfield.so.0): raised when
/// programs compiled before are no longer compatible.
#define NEARFIELD_ABI_VERSION 0

namespace nearfield {

/// A version of nearfield, in the numbers of the macros above.
struct Version {
    int major = 0;          ///< NEARFIELD_VERSION_MAJOR
    int minor = 0;          ///< NEARFIELD_VERSION_MINOR
    int patch = 0;          ///< NEARFIELD_VERSION_PATCH
    int abi = 0;            ///< NEARFIELD_ABI_VERSION
    const char* text = "";  ///< NEARFIELD_VERSION; valid as long as the library is loaded
};

/// The version of the library that the program runs with. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Version version() noexcept;

}  // namespace nearfield
