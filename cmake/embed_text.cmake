# Makes a header of a text file: the array nearfield::embedded::SYMBOL. Semicolons and brackets in
# the text would be lists to CMake, but for a file that is read and written whole.
file(READ ${INPUT} text)
file(WRITE ${OUTPUT}
    "#pragma once\n\nnamespace nearfield::embedded {\n"
    "inline constexpr char ${SYMBOL}[] = R\"embedded(${text})embedded\";\n}\n")
