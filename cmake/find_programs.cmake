# nearfield_require_program(VARIABLE NAME PACKAGE WHY) finds a program that tests run. If it is
# missing, configuration fails with the name of its Debian package.
function(nearfield_require_program variable name package why)
    find_program(${variable} ${name} DOC "${why}")
    mark_as_advanced(${variable})
    if(NOT ${variable})
        message(FATAL_ERROR "The tests need the program ${name} (${why}): install Debian's package "
                "${package}, or all that the tests need by tools/scripts/setup.sh test")
    endif()
endfunction()
