# The files that `cmake --install` installs, in three components, which become packages:
#   runtime      the shared library
#   development  headers, the static library, files for CMake and pkg-config, documents
#   tools        the command line
# Installed files contain no path of the build or of the sources; the installed tree may be moved.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/nearfield)
install(DIRECTORY include/nearfield DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.hpp" PATTERN "*.glsl" PATTERN "*.hlsl")
foreach(linkage IN ITEMS static shared)
    install(TARGETS nearfield_${linkage} EXPORT nearfield_${linkage}
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
            INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    install(EXPORT nearfield_${linkage} NAMESPACE nearfield:: FILE nearfield-${linkage}.cmake
            DESTINATION ${package_folder} COMPONENT development)
endforeach()
if(TARGET nearfield_program)
    if(BUILD_SHARED_LIBS)  # the tool finds the library from where it lies itself
        file(RELATIVE_PATH to_library ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
        set_target_properties(nearfield_program PROPERTIES INSTALL_RPATH "$ORIGIN/${to_library}")
    endif()
    install(TARGETS nearfield_program
            RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
endif()

configure_package_config_file(cmake/nearfield-config.cmake.in
    ${PROJECT_BINARY_DIR}/package/nearfield-config.cmake
    INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_INCLUDEDIR
    NO_SET_AND_CHECK_MACRO)
# While the major version is 0, a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/nearfield-config-version.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/nearfield-config.cmake
              ${PROJECT_BINARY_DIR}/package/nearfield-config-version.cmake
        DESTINATION ${package_folder} COMPONENT development)

# The pkg-config file finds the tree relative to its own location.
set(pkg_config_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
foreach(folder IN ITEMS "" INCLUDE LIB)
    file(RELATIVE_PATH to_${folder}
         ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_${folder}DIR})
    string(REGEX REPLACE "/$" "" to_${folder} ${to_${folder}})
endforeach()
configure_file(cmake/nearfield.pc.in ${PROJECT_BINARY_DIR}/package/nearfield.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/package/nearfield.pc
        DESTINATION ${pkg_config_folder} COMPONENT development)

install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE third_party_notes.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
# What the documents link to, so that no link is dead (tools/scripts/check_links.py).
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
foreach(file IN ITEMS tests/data/layouts/sheet.svg tests/data/scenes/strip.json)
    cmake_path(GET file PARENT_PATH folder)
    install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT development)
endforeach()
install(DIRECTORY tools/debug/ DESTINATION ${CMAKE_INSTALL_DATADIR}/nearfield/gdb
        COMPONENT development FILES_MATCHING PATTERN "*.py")

include(cmake/debian.cmake)
