# Compile options for every target of the project, and how a module becomes a target.

add_library(nearfield_options INTERFACE)
target_include_directories(nearfield_options INTERFACE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
target_compile_definitions(nearfield_options INTERFACE VK_NO_PROTOTYPES)
target_compile_options(nearfield_options INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    -Wold-style-cast -Woverloaded-virtual)
# When several files are compiled as one, a local name may shadow another file's.
if(NOT CMAKE_UNITY_BUILD)
    target_compile_options(nearfield_options INTERFACE -Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(nearfield_options INTERFACE -Wshadow=local)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # A false alarm on string concatenation in libstdc++ 12 (GCC bug 105651).
    target_compile_options(nearfield_options INTERFACE -Wno-restrict)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    # By default GCC resets and copies structures of some hundred bytes with `rep stos` or `rep
    # movs`, whose start-up costs tens of cycles: a tenth of a frame of small shapes.
    set(few_at_once vector_loop:512:noalign,libcall:-1:noalign)
    target_compile_options(nearfield_options INTERFACE
        -mmemset-strategy=${few_at_once} -mmemcpy-strategy=${few_at_once})
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    # Kernels keep vectors in structures, which those of unknown length (SVE) cannot be in.
    target_compile_definitions(nearfield_options INTERFACE
        "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
endif()
if(NEARFIELD_WARNINGS_AS_ERRORS)
    target_compile_options(nearfield_options INTERFACE -Werror)
endif()
if(NEARFIELD_SHADER_RELOAD)
    target_compile_definitions(nearfield_options INTERFACE NEARFIELD_SHADER_RELOAD)
endif()
if(NEARFIELD_SANITIZE)
    target_compile_options(nearfield_options INTERFACE
        -fsanitize=${NEARFIELD_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    if(NEARFIELD_SANITIZE MATCHES undefined)
        # The address checks cover what these would find, and these take as long to compile as all
        # others together.
        target_compile_options(nearfield_options INTERFACE
            -fno-sanitize=null,alignment,object-size)
    endif()
    target_link_options(nearfield_options INTERFACE -fsanitize=${NEARFIELD_SANITIZE})
endif()

# For code that decides answers: the same bits on every machine and by every compiler.
add_library(nearfield_same_bits INTERFACE)
target_compile_options(nearfield_same_bits INTERFACE -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # Where GCC 12 makes a vector of two numbers, it drops the rounding of a conversion to float and
    # back (tests/unit/base/rounding.cpp).
    target_compile_options(nearfield_same_bits INTERFACE -fno-tree-slp-vectorize)
endif()

# nearfield_module(NAME [LINK MODULE|LIBRARY...] [OPTIONAL MODULE...]) makes the object library
# nearfield_NAME from all sources in engine/NAME, or in the top-level folder NAME. It links the
# modules directly below it. A file may include files of those and of all modules below them; the
# tests of a module link nothing else. Optional modules are linked where there are such, and
# NEARFIELD_HAS_MODULE is then defined in NAME.
set_property(GLOBAL PROPERTY NEARFIELD_MODULES "")
function(nearfield_module name)
    cmake_parse_arguments(PARSE_ARGV 1 module "" "" "LINK;OPTIONAL")
    set(folder ${PROJECT_SOURCE_DIR}/engine/${name})
    if(NOT IS_DIRECTORY ${folder})
        set(folder ${PROJECT_SOURCE_DIR}/${name})
    endif()
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp ${folder}/*.hpp)
    add_library(nearfield_${name} OBJECT ${sources})
    target_link_libraries(nearfield_${name} PUBLIC nearfield_options PRIVATE nearfield_same_bits)
    foreach(optional IN LISTS module_OPTIONAL)
        if(TARGET nearfield_${optional})
            list(APPEND module_LINK ${optional})
            string(TOUPPER ${optional} upper)
            target_compile_definitions(nearfield_${name} PRIVATE NEARFIELD_HAS_${upper})
        endif()
    endforeach()
    set(below "")
    foreach(library IN LISTS module_LINK)
        if(TARGET nearfield_${library})
            target_link_libraries(nearfield_${name} PUBLIC nearfield_${library})
            get_target_property(further nearfield_${library} NEARFIELD_BELOW)
            list(APPEND below ${library} ${further})
        else()
            target_link_libraries(nearfield_${name} PUBLIC ${library})
        endif()
    endforeach()
    list(REMOVE_DUPLICATES below)
    set_target_properties(nearfield_${name} PROPERTIES NEARFIELD_BELOW "${below}")
    set_property(GLOBAL APPEND PROPERTY NEARFIELD_MODULES ${name})
endfunction()

# nearfield_link_module(TARGET MODULE) links the objects of a module and of all modules below it.
function(nearfield_link_module target module)
    get_target_property(below nearfield_${module} NEARFIELD_BELOW)
    foreach(name IN ITEMS ${module} LISTS below)
        target_link_libraries(${target} PRIVATE nearfield_${name})
    endforeach()
endfunction()
