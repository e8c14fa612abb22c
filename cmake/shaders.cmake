# glslang compiles shaders to SPIR-V at build time, and they are embedded as arrays of words. It is
# a build tool only.

find_program(NEARFIELD_GLSLANG NAMES glslangValidator glslang REQUIRED
             DOC "glslang, to compile shaders (package glslang-tools)")

# nearfield_shader_sources(FOLDER SHADER...): in addition to the output of nearfield_shaders(),
# makes a header <FOLDER/sources.hpp> with the source path of each shader and the compiler for it.
function(nearfield_shader_sources folder)
    set(includes "")
    set(rows "")
    foreach(shader IN LISTS ARGN)
        string(REPLACE "." "_" symbol ${shader})
        string(APPEND includes "#include <${folder}/${symbol}.hpp>\n")
        string(APPEND rows "    {\"${shader}\", ${symbol}},\n")
    endforeach()
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${folder}/sources.hpp @ONLY CONTENT [[
#pragma once

@includes@
#include <cstdint>
#include <span>

namespace nearfield::shaders {
struct Source {
    const char* file;
    std::span<const std::uint32_t> built;
};
inline constexpr Source sources[] = {
@rows@};
inline constexpr const char* compiler = R"(@NEARFIELD_GLSLANG@)";
inline constexpr const char* source_folder = R"(@PROJECT_SOURCE_DIR@/@folder@)";
inline constexpr const char* include_folder = R"(@PROJECT_SOURCE_DIR@/include)";
}
]])
endfunction()

# nearfield_shaders(TARGET FOLDER SHADER...): each FOLDER/NAME.STAGE of the project becomes a header
# <FOLDER/NAME_STAGE.hpp> with the array nearfield::shaders::NAME_STAGE.
function(nearfield_shaders target folder)
    set(output_folder ${PROJECT_BINARY_DIR}/generated/${folder})
    file(MAKE_DIRECTORY ${output_folder})
    file(GLOB includes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.glsl
         ${PROJECT_SOURCE_DIR}/${folder}/*.h ${PROJECT_SOURCE_DIR}/include/nearfield/*.glsl)
    foreach(shader IN LISTS ARGN)
        string(REPLACE "." "_" symbol ${shader})
        set(source ${PROJECT_SOURCE_DIR}/${folder}/${shader})
        set(header ${output_folder}/${symbol}.hpp)
        add_custom_command(
            OUTPUT ${header}
            COMMAND ${NEARFIELD_GLSLANG} --quiet --target-env vulkan1.1
                    -I${PROJECT_SOURCE_DIR}/${folder} -I${PROJECT_SOURCE_DIR}/include --vn words -o ${header}.words ${source}
            COMMAND ${CMAKE_COMMAND} -DINPUT=${header}.words -DOUTPUT=${header} -DSYMBOL=${symbol}
                    -P ${PROJECT_SOURCE_DIR}/cmake/embed_shader.cmake
            DEPENDS ${source} ${includes} ${PROJECT_SOURCE_DIR}/cmake/embed_shader.cmake
            COMMENT "Shader ${shader}"
            VERBATIM)
        list(APPEND headers ${header})
    endforeach()
    add_custom_target(${target}_spirv DEPENDS ${headers})
    add_dependencies(${target} ${target}_spirv)
    target_sources(${target} PRIVATE ${headers})
    target_include_directories(${target} PUBLIC ${PROJECT_BINARY_DIR}/generated)
endfunction()
