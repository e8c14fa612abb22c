# Run by CPack on the staged files: gives each Debian package its copyright file and a changelog in
# Debian's format, which refers to the project's changelog.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(pair IN LISTS CPACK_NEARFIELD_PACKAGES)
    string(REPLACE "=" ";" pair ${pair})
    list(GET pair 0 component)
    list(GET pair 1 package)
    set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component})
    if(NOT IS_DIRECTORY ${root})
        continue()
    endif()
    set(folder ${root}${CPACK_PACKAGING_INSTALL_PREFIX}/share/doc/${package})
    file(MAKE_DIRECTORY ${folder})
    file(COPY_FILE ${CPACK_NEARFIELD_SOURCE}/LICENSE ${folder}/copyright)
    string(CONCAT text
        "nearfield (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
        "  * libnearfield-dev has CHANGELOG.md, which says what is new.\n\n"
        " -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
    file(WRITE ${folder}/changelog "${text}")
    execute_process(COMMAND gzip --best --no-name ${folder}/changelog COMMAND_ERROR_IS_FATAL ANY)
endforeach()
