# Turns a text file into a header with the array nearfield::embedded::SYMBOL. The file is read and
# written as a whole, because CMake would treat semicolons and brackets in the text as lists.
file(READ ${INPUT} text)
file(WRITE ${OUTPUT}
    "#pragma once\n\nnamespace nearfield::embedded {\n"
    "inline constexpr char ${SYMBOL}[] = R\"embedded(${text})embedded\";\n}\n")
