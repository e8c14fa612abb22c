#pragma once

/// \file
/// What every header needs: the language version, and symbol visibility (which functions and
/// classes the shared library exports).

#if __cplusplus < 202002L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "nearfield needs C++20: compile with -std=c++20 (CMake: target_compile_features cxx_std_20)"
#endif

/// Marks the functions and classes of the public API that have code in the library. All other
/// symbols are hidden. Plain structures and templates need no mark, except PairTable, whose code is
/// in the library, and its queries. The static and the shared library consist of the same objects,
/// so a host defines nothing for either. A host that is itself a shared library and links the
/// static one can keep these symbols out of its own exports with
/// `-Wl,--exclude-libs,libnearfield.a`.
#if defined(__GNUC__)
#define NEARFIELD_EXPORT [[gnu::visibility("default")]]
/// Hides a class nested in an exported one.
#define NEARFIELD_HIDDEN [[gnu::visibility("hidden")]]
#else
#define NEARFIELD_EXPORT
#define NEARFIELD_HIDDEN
#endif
