# lz4::lz4, for the build and for consumers alike: Debian's liblz4-dev has no CMake package.
if(NOT TARGET lz4::lz4)
  find_path(LZ4_INCLUDE_DIR lz4frame.h)
  find_library(LZ4_LIBRARY lz4)
  mark_as_advanced(LZ4_INCLUDE_DIR LZ4_LIBRARY)
  if(LZ4_INCLUDE_DIR AND LZ4_LIBRARY)
    set(LZ4_FOUND ON)
    add_library(lz4::lz4 UNKNOWN IMPORTED)
    set_target_properties(lz4::lz4 PROPERTIES
      IMPORTED_LOCATION "${LZ4_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${LZ4_INCLUDE_DIR}")
  endif()
endif()
