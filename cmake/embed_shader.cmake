# Wraps the array written by glslang in a namespace of the project.
file(READ ${INPUT} words)
string(REGEX REPLACE ".*const uint32_t words\\[\\] = " "" words "${words}")
file(WRITE ${OUTPUT}
    "#pragma once\n\n#include <cstdint>\n\nnamespace nearfield::shaders {\n"
    "inline constexpr std::uint32_t ${SYMBOL}[] = ${words}}\n")
