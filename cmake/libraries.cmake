# Combines the modules into a static and a shared library, compiled once for both.

find_path(NEARFIELD_VULKAN_INCLUDE vulkan/vulkan_core.h REQUIRED
          DOC "Where the headers of Vulkan are (package libvulkan-dev)")

# Settings common to both libraries. After installation, the host provides the Vulkan headers itself
# (nearfield-config.cmake).
function(nearfield_library target)
    add_library(nearfield::${target} ALIAS ${target})
    foreach(module IN LISTS ARGN)
        target_sources(${target} PRIVATE $<TARGET_OBJECTS:nearfield_${module}>)
    endforeach()
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
    target_include_directories(${target} SYSTEM PUBLIC $<BUILD_INTERFACE:${NEARFIELD_VULKAN_INCLUDE}>)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_link_libraries(${target} PUBLIC $<INSTALL_INTERFACE:nearfield::vulkan_headers>
        PRIVATE hwy::hwy ${CMAKE_DL_LIBS})
    if(NEARFIELD_SANITIZE)
        target_link_options(${target} PRIVATE -fsanitize=${NEARFIELD_SANITIZE})
    endif()
    set_target_properties(${target} PROPERTIES
        OUTPUT_NAME nearfield LINKER_LANGUAGE CXX LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
        ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
endfunction()

# nearfield_libraries(MODULE...) makes nearfield_static and nearfield_shared; nearfield::nearfield
# is the one that BUILD_SHARED_LIBS selects. In another project, the other one is built only on
# demand.
function(nearfield_libraries)
    add_library(nearfield_static STATIC)
    nearfield_library(nearfield_static ${ARGN})

    add_library(nearfield_shared SHARED)
    nearfield_library(nearfield_shared ${ARGN})
    set(symbols ${PROJECT_SOURCE_DIR}/cmake/exported_symbols.map)
    target_link_options(nearfield_shared PRIVATE LINKER:--version-script=${symbols})
    if(NOT NEARFIELD_SANITIZE)  # Clang's sanitizers are found in the program only
        target_link_options(nearfield_shared PRIVATE LINKER:--no-undefined)
    endif()
    set_target_properties(nearfield_shared PROPERTIES
        VERSION ${PROJECT_VERSION} SOVERSION ${NEARFIELD_ABI_VERSION} LINK_DEPENDS ${symbols})

    set(chosen static)
    set(other shared)
    if(BUILD_SHARED_LIBS)
        set(chosen shared)
        set(other static)
    endif()
    add_library(nearfield::nearfield ALIAS nearfield_${chosen})
    if(NOT PROJECT_IS_TOP_LEVEL)
        set_target_properties(nearfield_${other} PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
endfunction()
