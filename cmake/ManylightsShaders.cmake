# Shaders are compiled to SPIR-V at build time and linked into the program as arrays of words.

find_program(MANYLIGHTS_GLSLC glslc)
if(NOT MANYLIGHTS_GLSLC)
  message(FATAL_ERROR "MANYLIGHTS_LAB needs glslc (package glslc, or the Vulkan SDK); scripts/setup installs it, or configure with -DMANYLIGHTS_LAB=OFF")
endif()

# manylights_add_shaders(target shader.comp shader.frag ...): makes <shader file name>.inc available to the target, e.g.
#     constexpr std::uint32_t kShadeCode[] =
#     #include "shade.comp.inc"
#     ;
function(manylights_add_shaders target)
  foreach(shader ${ARGN})
    get_filename_component(name ${shader} NAME)
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
    set(output ${CMAKE_CURRENT_BINARY_DIR}/shaders/${name}.inc)
    add_custom_command(
      OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/shaders
      COMMAND ${MANYLIGHTS_GLSLC} -O --target-env=vulkan1.3 -Werror -mfmt=c -MD -MF ${output}.d -MT ${output}
              -I ${PROJECT_SOURCE_DIR}/shaders -I ${PROJECT_SOURCE_DIR} ${source} -o ${output}
      DEPENDS ${source}
      DEPFILE ${output}.d
      COMMENT "Compiling shader ${shader}"
      VERBATIM)
    target_sources(${target} PRIVATE ${output})
  endforeach()
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/shaders)
endfunction()
