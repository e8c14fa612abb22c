# Wraps the array that glslang wrote into a namespace of the project's own.
file(READ ${INPUT} words)
string(REGEX REPLACE ".*const uint32_t words\\[\\] = " "" words "${words}")
file(WRITE ${OUTPUT}
    "#pragma once\n\n#include <cstdint>\n\nnamespace nearfield::shaders {\n"
    "inline constexpr std::uint32_t ${SYMBOL}[] = ${words}}\n")
