# Debian packages by CPack, one per component. Run `cpack -G DEB` in a build folder configured with
# -DCMAKE_INSTALL_PREFIX=/usr. dpkg-shlibdeps determines the dependencies.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME nearfield)
set(CPACK_PACKAGE_VENDOR nearfield)
set(CPACK_PACKAGE_CONTACT "nearfield contributors <contributors@nearfield.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL runtime development)
if(TARGET nearfield_program)
    list(APPEND CPACK_COMPONENTS_ALL tools)
endif()

set(library libnearfield${NEARFIELD_ABI_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
string(CONCAT about
    "nearfield answers intersection, signed distance, penetration depth, contact,\n"
    "closest point and separation queries between arbitrary polygons, on the\n"
    "Vulkan device of a host program or on the CPU.")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${library})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS libvulkan1)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "2D proximity queries on a Vulkan GPU: shared library\n${about}")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libnearfield-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${library} (= ${PROJECT_VERSION}), libhwy-dev, libvulkan-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "2D proximity queries on a Vulkan GPU: development files\n${about}")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME nearfield)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "libvulkan1, fonts-dejavu-core")
set(CPACK_DEBIAN_TOOLS_DESCRIPTION "2D proximity queries on a Vulkan GPU: command line\n${about}")

# dpkg-shlibdeps finds the library that a tool is linked with in the build folder.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
file(WRITE ${PROJECT_BINARY_DIR}/package/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/triggers)

set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_documents.cmake)
set(CPACK_NEARFIELD_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_NEARFIELD_PACKAGES runtime=${library} development=libnearfield-dev tools=nearfield)
include(CPack)
