#pragma once

#include <nearfield/export.hpp>

/// \file
/// Which nearfield a program was compiled with, and which it runs with.

/// Of the headers: raised where something is taken away or changes its meaning (while it is 0, the
/// minor number is).
#define NEARFIELD_VERSION_MAJOR 0
/// Of the headers: raised where something is added.
#define NEARFIELD_VERSION_MINOR 1
/// Of the headers: raised where something is mended.
#define NEARFIELD_VERSION_PATCH 0
/// Of the headers: all three numbers as text.
#define NEARFIELD_VERSION "0.1.0"
/// Of the headers: raised where a program compiled before no longer fits the shared library; the
/// number in its file name (libnearfield.so.0).
#define NEARFIELD_ABI_VERSION 0

namespace nearfield {

/// A version of nearfield, as the macros of this header have it for the headers.
struct Version {
    int major = 0;          ///< NEARFIELD_VERSION_MAJOR
    int minor = 0;          ///< NEARFIELD_VERSION_MINOR
    int patch = 0;          ///< NEARFIELD_VERSION_PATCH
    int abi = 0;            ///< NEARFIELD_ABI_VERSION
    const char* text = "";  ///< NEARFIELD_VERSION; lives as long as the library
};

/// The version of the library that the program runs with. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Version version() noexcept;

}  // namespace nearfield
