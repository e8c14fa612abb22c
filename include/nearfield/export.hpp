#pragma once

/// \file
/// Symbol visibility: which functions and classes the shared library exports.

/// Marks the functions and classes of the public API that have code in the library. All other
/// symbols are hidden; plain structures and templates need no mark. The static and the shared
/// library consist of the same objects, so a host defines nothing for either. A host that is itself
/// a shared library and links the static one can keep these symbols out of its own exports with
/// `-Wl,--exclude-libs,libnearfield.a`.
#if defined(__GNUC__)
#define NEARFIELD_EXPORT [[gnu::visibility("default")]]
/// Hides a class nested in an exported one.
#define NEARFIELD_HIDDEN [[gnu::visibility("hidden")]]
#else
#define NEARFIELD_EXPORT
#define NEARFIELD_HIDDEN
#endif
