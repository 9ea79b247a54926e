# cpack -G DEB in a Release build: the packages terracut (the components `program` and `service`: that, its configuration,
# manual pages and documents), libterracut-dev (`development`) and, where the Python module is built, python3-terracut
# (`python`). What belongs below / and /etc is in `service`, and so only in a package.
set(terracut_service ${PROJECT_SOURCE_DIR}/tools/build/service)
set(in_package COMPONENT service EXCLUDE_FROM_ALL)
install(FILES ${terracut_service}/terracut.service DESTINATION lib/systemd/system ${in_package})
install(FILES ${terracut_service}/terracut.yaml DESTINATION /etc/terracut ${in_package})
install(CODE "set(PROGRAM $<TARGET_FILE:terracut_cli>)
set(VERSION ${PROJECT_VERSION})
include(${CMAKE_CURRENT_LIST_DIR}/ManPages.cmake)" ${in_package})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION share/doc/terracut
  ${in_package} FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg")
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/examples/read_frames.py
  ${PROJECT_SOURCE_DIR}/tools/examples/labels_in_numpy.py
  DESTINATION share/doc/terracut/examples ${in_package})
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/fleet/parallel ${PROJECT_SOURCE_DIR}/tools/fleet/relabel.sbatch
  ${PROJECT_SOURCE_DIR}/tools/fleet/submit ${PROJECT_SOURCE_DIR}/tools/fleet/throughput
  DESTINATION share/doc/terracut/fleet ${in_package})
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION share/doc/terracut ${in_package})

# Debian wants the licence and the changes under names of its own, the latter compressed.
file(WRITE ${PROJECT_BINARY_DIR}/package/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: terracut

Files: *
Copyright: 2026 The terracut authors
License: Apache-2.0
 On Debian systems the full text of the Apache License, Version 2.0, is in
 /usr/share/common-licenses/Apache-2.0.
")
set(notes ${PROJECT_BINARY_DIR}/package/copyright)
find_program(TERRACUT_GZIP gzip)
mark_as_advanced(TERRACUT_GZIP)
if(TERRACUT_GZIP)
  execute_process(COMMAND ${TERRACUT_GZIP} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/package/changelog.gz)
  list(APPEND notes ${PROJECT_BINARY_DIR}/package/changelog.gz)
endif()

set(CPACK_PACKAGE_VENDOR "The terracut authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_CONTACT "The terracut authors <terracut@localhost>")
set(CPACK_SET_DESTDIR ON)  # of absolute places, as /etc is
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# terracut_deb(NAME PACKAGE SECTION TITLE TEXT components...): its variables are CPACK_DEBIAN_<NAME>_...
macro(terracut_deb name package section title text)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${name}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${name}_DESCRIPTION "${title}\n${text}")
  foreach(component ${ARGN})
    string(TOUPPER ${component} upper)
    set(CPACK_COMPONENT_${upper}_GROUP ${name})
    list(APPEND CPACK_COMPONENTS_ALL ${component})
    set(last ${component})
  endforeach()
  install(FILES ${notes} DESTINATION share/doc/${package} COMPONENT ${last} EXCLUDE_FROM_ALL)
endmacro()

terracut_deb(MAIN terracut science "real-time LiDAR ground segmentation"
"Labels every return of a spinning LiDAR ground or obstacle, from packets of
the network or of captures, before a deadline and in fixed memory. With the
service terracut.service, which is not enabled at installation." program service)
set(CPACK_DEBIAN_MAIN_PACKAGE_SUGGESTS "chrony, linuxptp")
set(CPACK_DEBIAN_MAIN_PACKAGE_CONTROL_EXTRA
  ${terracut_service}/debian/conffiles ${terracut_service}/debian/postinst
  ${terracut_service}/debian/prerm ${terracut_service}/debian/postrm)

terracut_deb(DEV libterracut-dev libdevel "real-time LiDAR ground segmentation, C++ libraries"
"Static libraries and headers, with what find_package(terracut) of CMake and
pkg-config read." development)
set(needs libeigen3-dev libexpected-dev libfmt-dev libpcap-dev libpng-dev libpugixml-dev libyaml-cpp-dev libzstd-dev
  zlib1g-dev)
if(LZ4_FOUND)
  list(APPEND needs liblz4-dev)
endif()
if(SQLite3_FOUND)
  list(APPEND needs libsqlite3-dev)
endif()
list(JOIN needs ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEV_PACKAGE_REPLACES "terracut (<< 0.3)")  # which had these files

if(TERRACUT_PYTHON)
  terracut_deb(PYTHON python3-terracut python "real-time LiDAR ground segmentation, Python module"
"Labelled frames of captures and live sensors, and labels of clouds, in numpy
arrays." python)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
endif()
include(CPack)
