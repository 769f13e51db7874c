# One static library a folder, named tessera_<folder>. What a folder may include is what it links: headers of a folder
# that is not among DEPS are not on its include path.
#
#   tessera_library(voronoi SOURCES lloyd.cpp DEPS base image LINK PUBLIC hwy)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()

add_library(tessera_options INTERFACE)
# Same job, same bytes on every machine: no fused multiply-add, no reordered sums.
target_compile_options(tessera_options INTERFACE -Wall -Wextra -Werror -ffp-contract=off)
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")
  target_sources(tessera_options INTERFACE
    "$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${CMAKE_CURRENT_LIST_DIR}/seen_threads.cpp>")
endif()
if(TESSERA_CLANG_TIDY)
  find_program(CLANG_TIDY NAMES clang-tidy-14 clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY "${CLANG_TIDY}")
endif()

# Every folder's headers are seen through a link of its own, <build>/include/<target>/tessera/<folder>, so that a target
# sees its own folder and those of its DEPS and no other.
#
# The target is Tessera::voronoi where core is installed (packaging/); headers that only its own sources see stay out of
# what is exported.
function(tessera_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;LINK" ${ARGN})
  list(TRANSFORM ARG_LINK REPLACE "^(.+_header_only)$" "$<BUILD_INTERFACE:\\1>")
  set(target tessera_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:tessera_options>)
    target_compile_features(${target} PUBLIC cxx_std_20)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  set(view "${CMAKE_BINARY_DIR}/include/${name}")
  file(MAKE_DIRECTORY "${view}/tessera")
  file(CREATE_LINK "${CMAKE_CURRENT_SOURCE_DIR}" "${view}/tessera/${name}" SYMBOLIC)
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${view}>")
  list(TRANSFORM ARG_DEPS PREPEND tessera_)
  target_link_libraries(${target} ${scope} ${ARG_DEPS} ${ARG_LINK})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(Tessera::${name} ALIAS ${target})
endfunction()
