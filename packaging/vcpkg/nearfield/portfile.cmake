# An overlay port that uses the sources it is part of.
#   vcpkg install nearfield --overlay-ports=packaging/vcpkg
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)
vcpkg_add_to_path("${CURRENT_HOST_INSTALLED_DIR}/tools/glslang")

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS -DNEARFIELD_BUILD_TESTS=OFF -DNEARFIELD_BUILD_TOOLS=OFF -DNEARFIELD_WARNINGS_AS_ERRORS=OFF
            -DNEARFIELD_INSTALL=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/nearfield)
vcpkg_fixup_pkgconfig()

# A triplet has one kind of library, but the install step installs both.
if(VCPKG_LIBRARY_LINKAGE STREQUAL "static")
    set(unwanted lib/libnearfield.so* share/nearfield/nearfield-shared*)
else()
    set(unwanted lib/libnearfield.a share/nearfield/nearfield-static*)
endif()
foreach(pattern IN LISTS unwanted)
    file(GLOB files "${CURRENT_PACKAGES_DIR}/${pattern}" "${CURRENT_PACKAGES_DIR}/debug/${pattern}")
    file(REMOVE ${files})
endforeach()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
