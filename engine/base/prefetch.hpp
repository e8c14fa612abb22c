#pragma once

namespace nearfield {

/// Begins to load what will soon be read or written; does nothing where the compiler cannot say so.
inline void prefetch([[maybe_unused]] const void* memory) {
#if defined(__GNUC__)
    __builtin_prefetch(memory);
#endif
}

}  // namespace nearfield
