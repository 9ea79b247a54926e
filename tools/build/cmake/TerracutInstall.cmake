# cmake --install: the component `program`, and the component `development`, which is the libraries with their public
# headers as <terracut/x.hpp> and what find_package(terracut) reads. What is heavier is in an export of its own, so that
# segmentation alone asks for no libpcap and no libpng.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(terracut_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/terracut)

# terracut_install(EXPORT targets...): as terracut-<export>-targets.cmake.
function(terracut_install export)
  install(TARGETS ${ARGN} EXPORT terracut_${export}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  install(EXPORT terracut_${export} FILE terracut-${export}-targets.cmake NAMESPACE terracut::
    DESTINATION ${terracut_package_dir} COMPONENT development)
endfunction()
terracut_install(segmentation terracut_rt terracut_calib terracut_frame terracut_ground)
terracut_install(drivers terracut_firmware_io)
terracut_install(live terracut_pipeline)

install(TARGETS terracut_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${PROJECT_SOURCE_DIR}/pipeline/health/terracut_health.dbc
  ${PROJECT_SOURCE_DIR}/tools/build/service/grafana.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/terracut)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/presets ${PROJECT_SOURCE_DIR}/tools/ros2
  DESTINATION ${CMAKE_INSTALL_DATADIR}/terracut)

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/tools/build/cmake/terracut-config.cmake.in
  ${PROJECT_BINARY_DIR}/terracut-config.cmake
  INSTALL_DESTINATION ${terracut_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/terracut-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/terracut-config.cmake
  ${PROJECT_BINARY_DIR}/terracut-config-version.cmake
  ${PROJECT_SOURCE_DIR}/tools/build/cmake/TerracutLz4.cmake
  ${PROJECT_SOURCE_DIR}/tools/build/cmake/TerracutPcap.cmake
  ${PROJECT_SOURCE_DIR}/tools/build/cmake/TerracutZstd.cmake
  DESTINATION ${terracut_package_dir} COMPONENT development)

# For builds without CMake: all of the libraries, which are static, and what they need of others.
set(terracut_requires fmt libpcap libpng libzstd pugixml yaml-cpp zlib)
if(LZ4_FOUND)
  list(APPEND terracut_requires liblz4)
endif()
if(SQLite3_FOUND)
  list(APPEND terracut_requires sqlite3)
endif()
list(JOIN terracut_requires " " terracut_requires)
file(RELATIVE_PATH terracut_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${PROJECT_SOURCE_DIR}/tools/build/cmake/terracut.pc.in ${PROJECT_BINARY_DIR}/terracut.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/terracut.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

install(FILES ${PROJECT_SOURCE_DIR}/tools/build/completion/terracut
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
