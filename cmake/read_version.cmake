# nearfield_read_version(HEADER) reads NEARFIELD_VERSION and NEARFIELD_ABI_VERSION from the macros
# of the public header, which is the only place that defines them.
function(nearfield_read_version header)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
    file(STRINGS ${header} lines REGEX "^#define NEARFIELD_(ABI_)?VERSION ")
    foreach(line IN LISTS lines)
        string(REGEX MATCH "NEARFIELD_[A-Z_]+" name "${line}")
        string(REGEX MATCH "[0-9.]+" value "${line}")
        set(${name} ${value} PARENT_SCOPE)
    endforeach()
endfunction()
