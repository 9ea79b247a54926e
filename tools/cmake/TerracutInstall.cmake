# cmake --install: the rooms as libraries terracut::<room>, their headers as <terracut/<room>/x.hpp>,
# the program, and what find_package(terracut) reads.
include(CMakePackageConfigHelpers)
set(terracut_rooms rt calib pipeline firmware_io)
list(TRANSFORM terracut_rooms PREPEND terracut_ OUTPUT_VARIABLE terracut_libraries)

install(TARGETS ${terracut_libraries} EXPORT terracut_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS terracut_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${terracut_rooms} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/terracut
  FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/firmware_io/can/terracut_health.dbc
  DESTINATION ${CMAKE_INSTALL_DATADIR}/terracut)

set(terracut_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/terracut)
install(EXPORT terracut_targets FILE terracut-targets.cmake NAMESPACE terracut::
  DESTINATION ${terracut_package_dir})
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/tools/cmake/terracut-config.cmake.in
  ${PROJECT_BINARY_DIR}/terracut-config.cmake
  INSTALL_DESTINATION ${terracut_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/terracut-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/terracut-config.cmake
  ${PROJECT_BINARY_DIR}/terracut-config-version.cmake
  ${PROJECT_SOURCE_DIR}/tools/cmake/TerracutPcap.cmake
  DESTINATION ${terracut_package_dir})
