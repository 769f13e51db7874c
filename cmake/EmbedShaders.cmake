# Puts shader files into a header as string literals, so that no program looks for them at run time.
#
#   embed_shaders(tessera_gpu shaders.h ${PROJECT_SOURCE_DIR}/shaders/site.vert ...)
#
# The header lies in the target's own generated folder; site.vert becomes tessera::shaders::kSiteVert.
function(embed_shaders target header)
  set(body "")
  foreach(file IN LISTS ARGN)
    # The build configures itself again when a shader changes.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
    cmake_path(GET file FILENAME name)
    string(REGEX MATCHALL "[A-Za-z0-9]+" words "${name}")
    set(constant k)
    foreach(word IN LISTS words)
      string(SUBSTRING "${word}" 0 1 initial)
      string(SUBSTRING "${word}" 1 -1 rest)
      string(TOUPPER "${initial}" initial)
      string(APPEND constant "${initial}${rest}")
    endforeach()
    file(READ "${file}" text)
    string(APPEND body "inline constexpr const char ${constant}[] = R\"glsl(${text})glsl\";\n\n")
  endforeach()
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/generated")
  file(CONFIGURE OUTPUT "${folder}/${header}" @ONLY CONTENT
       "// Made by the build from the files in shaders/.\n#pragma once\n\nnamespace tessera::shaders {\n\n@body@}  // namespace tessera::shaders\n")
  target_include_directories(${target} PRIVATE "${folder}")
endfunction()
