# The Vulkan drivers that tests request by name, so that none runs on an arbitrary driver: a list of
# NAME=MANIFEST, where the manifest is the JSON file through which the loader finds a driver. All
# tests that need a device run on the first; those whose answers depend on the driver run on the
# others too.
set(NEARFIELD_TEST_DRIVERS "" CACHE STRING
    "Vulkan drivers to test on, NAME=MANIFEST each; empty: lavapipe and SwiftShader, as Debian has them")

# nearfield_find_driver(RESULT NAME FOLDER PACKAGE FILE...) finds the manifest in the folder, or
# reports what to install.
function(nearfield_find_driver result name folder package)
    find_file(manifest NAMES ${ARGN} PATHS ${folder} NO_DEFAULT_PATH NO_CACHE)
    if(NOT manifest)
        list(JOIN ARGN " or " files)
        message(FATAL_ERROR
            "The tests run on the Vulkan driver ${name}, and there is no ${files} in ${folder}: install "
            "the Debian package ${package}, name other drivers (-DNEARFIELD_TEST_DRIVERS=NAME=MANIFEST), "
            "or build without tests (-DNEARFIELD_BUILD_TESTS=OFF).")
    endif()
    set(${result} ${name}=${manifest} PARENT_SCOPE)
endfunction()

set(drivers ${NEARFIELD_TEST_DRIVERS})
if(NOT drivers)
    nearfield_find_driver(lavapipe lavapipe /usr/share/vulkan/icd.d mesa-vulkan-drivers
                          lvp_icd.${CMAKE_SYSTEM_PROCESSOR}.json lvp_icd.json)
    nearfield_find_driver(swiftshader swiftshader /usr/lib/chromium chromium-common
                          vk_swiftshader_icd.json)
    set(drivers ${lavapipe} ${swiftshader})
endif()

# Chromium, which Debian's SwiftShader comes with, has a newer validation layer than Debian. It sees
# hazards between dispatches and between submissions, so ctest runs all tests but those of windows
# under it where it is there.
find_file(newer_layer libVkLayer_khronos_validation.so PATHS /usr/lib/chromium NO_DEFAULT_PATH NO_CACHE)
if(newer_layer)
    set(layers ${PROJECT_BINARY_DIR}/layers)
    file(CONFIGURE OUTPUT ${layers}/validation.json CONTENT [=[
{"file_format_version": "1.2.0",
 "layer": {"name": "VK_LAYER_KHRONOS_validation", "type": "GLOBAL", "library_path": "@newer_layer@",
  "api_version": "1.4.0", "implementation_version": "1", "description": "the newer validation layer",
  "instance_extensions": [{"name": "VK_EXT_debug_utils", "spec_version": "2"},
                          {"name": "VK_EXT_validation_features", "spec_version": "6"}]}}
]=] @ONLY)
    file(CONFIGURE OUTPUT ${layers}/environment.cmake CONTENT [=[
set(ENV{VK_LAYER_PATH} "@layers@")
set(ENV{VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC} 1)  # which buffers a dispatch accesses
set(ENV{VK_LAYER_ENABLE_MESSAGE_LIMIT} 0)               # every message, not the first ten of a kind
]=] @ONLY)
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${layers}/environment.cmake)
endif()

set(names "")
set(nearfield_manifests "")
foreach(driver IN LISTS drivers)
    string(REGEX MATCH "^([A-Za-z0-9_]+)=(/.+)$" is_pair "${driver}")
    set(name "${CMAKE_MATCH_1}")
    set(manifest "${CMAKE_MATCH_2}")
    if(NOT is_pair OR NOT EXISTS "${manifest}" OR name IN_LIST names)
        message(FATAL_ERROR
            "NEARFIELD_TEST_DRIVERS: '${driver}' is not NAME=MANIFEST with a name of its own and the full "
            "path of a file that exists (for example nvidia=/usr/share/vulkan/icd.d/nvidia_icd.json).")
    endif()
    list(APPEND names ${name})
    list(APPEND nearfield_manifests ${manifest})
    set(nearfield_manifest_of_${name} ${manifest})
endforeach()
list(POP_FRONT names first)
set(nearfield_other_drivers ${names})

# ENVIRONMENT_MODIFICATION of a test that runs on the first driver.
set(nearfield_on_first_driver VK_DRIVER_FILES=set:${nearfield_manifest_of_${first}})

# nearfield_test(NAME COMMAND...) adds a test on the first driver.
function(nearfield_test name)
    add_test(NAME ${name} COMMAND ${ARGN})
    set_tests_properties(${name} PROPERTIES
        TIMEOUT 300 ENVIRONMENT_MODIFICATION ${nearfield_on_first_driver})
endfunction()

# The COST of tests that take longest: ctest starts them first, so that none runs alone at the end.
set(nearfield_long 100)

# nearfield_test_on_others(NAME COMMAND...) adds the same test for each other driver, as NAME.DRIVER.
function(nearfield_test_on_others name)
    foreach(driver IN LISTS nearfield_other_drivers)
        add_test(NAME ${name}.${driver} COMMAND ${ARGN})
        set_tests_properties(${name}.${driver} PROPERTIES TIMEOUT 1200 COST ${nearfield_long}
            ENVIRONMENT_MODIFICATION VK_DRIVER_FILES=set:${nearfield_manifest_of_${driver}})
    endforeach()
endfunction()
