# cpack -G DEB in a Release build: what `cmake --install` gives, and the service with its
# configuration, which belong below / and /etc and so only into a package.
set(terracut_service ${PROJECT_SOURCE_DIR}/tools/build/service)
install(FILES ${terracut_service}/terracut.service
  DESTINATION lib/systemd/system COMPONENT service EXCLUDE_FROM_ALL)
install(FILES ${terracut_service}/terracut.yaml
  DESTINATION /etc/terracut COMPONENT service EXCLUDE_FROM_ALL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION share/doc/terracut
  COMPONENT service EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/examples/read_frames.py
  ${PROJECT_SOURCE_DIR}/tools/examples/labels_in_numpy.py
  DESTINATION share/doc/terracut/examples COMPONENT service EXCLUDE_FROM_ALL)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/fleet/parallel ${PROJECT_SOURCE_DIR}/tools/fleet/relabel.sbatch
  ${PROJECT_SOURCE_DIR}/tools/fleet/submit ${PROJECT_SOURCE_DIR}/tools/fleet/throughput
  DESTINATION share/doc/terracut/fleet COMPONENT service EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION share/doc/terracut
  COMPONENT service EXCLUDE_FROM_ALL)

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
install(FILES ${PROJECT_BINARY_DIR}/package/copyright DESTINATION share/doc/terracut
  COMPONENT service EXCLUDE_FROM_ALL)
find_program(TERRACUT_GZIP gzip)
mark_as_advanced(TERRACUT_GZIP)
if(TERRACUT_GZIP)
  execute_process(COMMAND ${TERRACUT_GZIP} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/package/changelog.gz)
  install(FILES ${PROJECT_BINARY_DIR}/package/changelog.gz DESTINATION share/doc/terracut
    COMPONENT service EXCLUDE_FROM_ALL)
endif()

set(CPACK_PACKAGE_NAME terracut)
set(CPACK_PACKAGE_VENDOR "The terracut authors")
set(CPACK_PACKAGE_CONTACT "The terracut authors <terracut@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "real-time LiDAR ground segmentation")
set(CPACK_PACKAGE_DESCRIPTION
"Labels every return of a Velodyne HDL-64E or RoboSense RS-Ruby128 ground or
obstacle, from packets of the network or of captures, before a deadline and in
fixed memory. With the service terracut.service, which is not enabled at
installation, and the C++ libraries.")
set(CPACK_SET_DESTDIR ON)  # of absolute places, as /etc is
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL Unspecified service)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "chrony, linuxptp, libeigen3-dev, libexpected-dev, libpugixml-dev, libyaml-cpp-dev, libfmt-dev, libpng-dev, libpcap-dev, libzstd-dev, zlib1g-dev, liblz4-dev, libsqlite3-dev")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${terracut_service}/debian/conffiles ${terracut_service}/debian/postinst
  ${terracut_service}/debian/prerm ${terracut_service}/debian/postrm)
include(CPack)
