# Emscripten's own toolchain file, wherever emcc is from; and, where WASM_DEPENDENCIES names a prefix, the libraries
# that scripts/wasm-dependencies has put there, and no others.
find_program(EM_CONFIG em-config REQUIRED)
execute_process(COMMAND "${EM_CONFIG}" EMSCRIPTEN_ROOT OUTPUT_VARIABLE EMSCRIPTEN_HOME
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES WASM_DEPENDENCIES)
include("${EMSCRIPTEN_HOME}/cmake/Modules/Platform/Emscripten.cmake")
if(WASM_DEPENDENCIES)
  list(PREPEND CMAKE_FIND_ROOT_PATH "${WASM_DEPENDENCIES}")
  set(OpenCV_DIR "${WASM_DEPENDENCIES}/lib/cmake/opencv4")
endif()
