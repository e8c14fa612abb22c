# Writes a header with the commit of the sources at every build, but changes it only if the commit
# has changed. Outside a repository it contains the version.
execute_process(
    COMMAND git -C ${SOURCE} describe --always --dirty=\ with\ changes --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT failed EQUAL 0)
    set(commit "version ${VERSION}")
endif()
string(CONCAT text
    "#pragma once\n\nnamespace nearfield::embedded {\n"
    "inline constexpr char commit[] = \"${commit}\";\n}\n")
set(former "")
if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} former)
endif()
if(NOT text STREQUAL former)
    file(WRITE ${OUTPUT} "${text}")
endif()
