# httplib::httplib, as Debian builds it: a shared library with its header split off. The switches
# decide on the layout of its classes, so they must be those that the library was built with.
if(NOT TARGET httplib::httplib)
  find_path(HTTPLIB_INCLUDE_DIR httplib.h)
  find_library(HTTPLIB_LIBRARY cpp-httplib)
  mark_as_advanced(HTTPLIB_INCLUDE_DIR HTTPLIB_LIBRARY)
  if(HTTPLIB_INCLUDE_DIR AND HTTPLIB_LIBRARY)
    set(HTTPLIB_FOUND ON)
    add_library(httplib::httplib UNKNOWN IMPORTED)
    set_target_properties(httplib::httplib PROPERTIES
      IMPORTED_LOCATION "${HTTPLIB_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${HTTPLIB_INCLUDE_DIR}"
      INTERFACE_COMPILE_DEFINITIONS
        "CPPHTTPLIB_OPENSSL_SUPPORT;CPPHTTPLIB_ZLIB_SUPPORT;CPPHTTPLIB_BROTLI_SUPPORT")
  endif()
endif()
