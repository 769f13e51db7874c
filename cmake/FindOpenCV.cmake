# Finds the modules of OpenCV that are asked for, as targets opencv_core, opencv_imgproc. OpenCV's own configuration
# file, as Debian packages it, wants every module to be installed, which are 300 packages more. It is used where
# OpenCV_DIR names it: a build of one's own, with static libraries that need others.
if(OpenCV_DIR)
  find_package(OpenCV CONFIG REQUIRED COMPONENTS ${OpenCV_FIND_COMPONENTS})
  return()
endif()

find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(required OpenCV_INCLUDE_DIR)
foreach(component IN LISTS OpenCV_FIND_COMPONENTS)
  find_library(OpenCV_${component}_LIBRARY opencv_${component})
  list(APPEND required OpenCV_${component}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS ${required})
mark_as_advanced(${required})

if(OpenCV_FOUND)
  foreach(component IN LISTS OpenCV_FIND_COMPONENTS)
    if(NOT TARGET opencv_${component})
      add_library(opencv_${component} UNKNOWN IMPORTED)
      set_target_properties(opencv_${component} PROPERTIES
        IMPORTED_LOCATION "${OpenCV_${component}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenCV_INCLUDE_DIR}")
    endif()
  endforeach()
endif()
