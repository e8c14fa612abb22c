# Run by CPack on what is about to be packed: each Debian package has its copyright and changelog.
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
    execute_process(
        COMMAND gzip --best --no-name --stdout ${CPACK_NEARFIELD_SOURCE}/CHANGELOG.md
        OUTPUT_FILE ${folder}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
endforeach()
