// What a header needs that is both GLSL and C++: shaders and the library include the same
// declarations, so that each is written once.
//
// C++ lays the structures out as std430 does, because vec2 has the same alignment. Members have a
// default value in C++ only. Constants of integers need no macro.
#ifndef NEARFIELD_SHADERS_SHARED_H
#define NEARFIELD_SHADERS_SHARED_H

#ifdef __cplusplus

#include <cstddef>
#include <cstdint>

#define NEARFIELD_SHARED_BEGIN namespace nearfield::shaders {
#define NEARFIELD_SHARED_END }
#define NEARFIELD_DEFAULT(value) = value
#define NEARFIELD_FLOAT inline constexpr float
#define NEARFIELD_CHECK(condition) static_assert(condition);

NEARFIELD_SHARED_BEGIN
using uint = std::uint32_t;
struct alignas(8) vec2 {  // NOLINT(readability-identifier-naming): GLSL's name
    float x = 0.0F, y = 0.0F;
};
NEARFIELD_SHARED_END

#else

#define NEARFIELD_SHARED_BEGIN
#define NEARFIELD_SHARED_END
#define NEARFIELD_DEFAULT(value)
#define NEARFIELD_FLOAT const float
#define NEARFIELD_CHECK(condition)

// Column and row, or width and height, from one word.
uvec2 unpacked(uint word) {
    return uvec2(word & 0xffffu, word >> 16);
}

#endif

#endif
