# A header from the system's packages as a target of its own, for every target of the build. Nothing of it depends on
# the machine, so that a cross build may take the same file; but not its neighbours in /usr/include, therefore a link.
#
#   find_path(STB_INCLUDE_DIR stb/stb_image_write.h ${ANY_TARGET} REQUIRED)
#   header_only(stb "${STB_INCLUDE_DIR}" stb)
set(ANY_TARGET PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH)

function(header_only name folder entry)
  set(view "${CMAKE_BINARY_DIR}/include/${name}")
  file(MAKE_DIRECTORY "${view}")
  file(CREATE_LINK "${folder}/${entry}" "${view}/${entry}" SYMBOLIC)
  add_library(${name}_header_only INTERFACE)
  target_include_directories(${name}_header_only SYSTEM INTERFACE "${view}")
endfunction()
