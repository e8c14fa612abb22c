#pragma once

/// \file
/// What the shared library exports.

/// Stands before every function and class of the public interface that the library has code for.
/// Everything else in the library is hidden; plain structures and templates need none of it. The
/// static and the shared library are made of the same objects, so a host defines nothing for
/// either. A host that is itself a shared library, links the static one and does not want to pass
/// these symbols on links with `-Wl,--exclude-libs,libnearfield.a`.
#if defined(__GNUC__)
#define NEARFIELD_EXPORT [[gnu::visibility("default")]]
/// Takes that back for a class inside an exported one.
#define NEARFIELD_HIDDEN [[gnu::visibility("hidden")]]
#else
#define NEARFIELD_EXPORT
#define NEARFIELD_HIDDEN
#endif
