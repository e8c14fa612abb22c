# What every target of the project is compiled with, and how a room of the house becomes a target.

add_library(nearfield_options INTERFACE)
target_include_directories(nearfield_options INTERFACE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
target_compile_definitions(nearfield_options INTERFACE VK_NO_PROTOTYPES)
target_compile_options(nearfield_options INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    -Wold-style-cast -Woverloaded-virtual)
# Where several files are compiled as one, a local name may shadow another file's.
if(NOT CMAKE_UNITY_BUILD)
    target_compile_options(nearfield_options INTERFACE -Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(nearfield_options INTERFACE -Wshadow=local)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarm on string concatenation in libstdc++ 12 (GCC bug 105651).
    target_compile_options(nearfield_options INTERFACE -Wno-restrict)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    # GCC's usual way to reset or copy a structure of some hundred bytes is `rep stos` or `rep movs`,
    # which take tens of cycles to begin with: a tenth of a frame of small shapes.
    set(few_at_once vector_loop:512:noalign,libcall:-1:noalign)
    target_compile_options(nearfield_options INTERFACE
        -mmemset-strategy=${few_at_once} -mmemcpy-strategy=${few_at_once})
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
        # What these would find addresses are watched for as well; they take as long to compile as
        # all others together.
        target_compile_options(nearfield_options INTERFACE
            -fno-sanitize=null,alignment,object-size)
    endif()
    target_link_options(nearfield_options INTERFACE -fsanitize=${NEARFIELD_SANITIZE})
endif()

# nearfield_room(NAME FOLDER [LINK LIBRARY...]) makes the object library nearfield_NAME from all
# sources of FOLDER.
function(nearfield_room name folder)
    cmake_parse_arguments(PARSE_ARGV 2 room "" "" "LINK")
    file(GLOB sources CONFIGURE_DEPENDS
         ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
    add_library(nearfield_${name} OBJECT ${sources})
    target_link_libraries(nearfield_${name} PUBLIC nearfield_options ${room_LINK})
endfunction()
