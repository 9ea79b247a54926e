# Builds the Debian package of this build and looks into it.
cmake_minimum_required(VERSION 3.22)
find_program(SHLIBDEPS dpkg-shlibdeps)
find_program(FILE_UTILITY file)
if(NOT DPKG_DEB OR NOT SHLIBDEPS OR NOT FILE_UTILITY)
  message("skipped: dpkg-deb, dpkg-shlibdeps (dpkg-dev) or file is not installed")
  return()
endif()
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})

function(run output)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER}
    RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${text}${error}")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# Compressed quickly: how small it gets is not the question here.
run(ignored ${CPACK} -G DEB --config ${BUILD_DIR}/CPackConfig.cmake -B ${FOLDER}
    -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip)
file(GLOB packages ${FOLDER}/*.deb)
list(LENGTH packages count)
if(NOT count EQUAL 1 OR NOT packages MATCHES "/terracut_${VERSION}_[a-z0-9]+\\.deb$")
  message(FATAL_ERROR "expected one package terracut_${VERSION}_ARCH.deb, found: ${packages}")
endif()

run(content ${DPKG_DEB} -c ${packages})
foreach(path
    ./usr/bin/terracut
    ./usr/lib/systemd/system/terracut.service
    ./etc/terracut/terracut.yaml
    ./usr/share/doc/terracut/docs/guide/real_time.md
    ./usr/share/doc/terracut/docs/reference/configuration.md
    ./usr/share/doc/terracut/examples/read_frames.py
    ./usr/share/doc/terracut/copyright
    ./usr/share/terracut/terracut_health.dbc
    ./usr/share/terracut/grafana.json
    ./usr/share/terracut/presets/car.yaml
    ./usr/share/terracut/ros2/terracut_ros/package.xml
    ./usr/include/terracut/segmenter.hpp
    libterracut_pipeline.a
    terracut/terracut-config.cmake)
  string(FIND "${content}" "${path}\n" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "the package has no ${path}:\n${content}")
  endif()
endforeach()
if(content MATCHES "(${BUILD_DIR}|\\./usr/local)")
  message(FATAL_ERROR "the package has files in places of this machine:\n${content}")
endif()

run(ignored ${DPKG_DEB} --raw-extract ${packages} ${FOLDER}/extracted)
file(READ ${FOLDER}/extracted/DEBIAN/conffiles conffiles)
if(NOT conffiles STREQUAL "/etc/terracut/terracut.yaml\n")
  message(FATAL_ERROR "conffiles: ${conffiles}")
endif()
run(depends ${DPKG_DEB} -f ${packages} Depends)
if(NOT depends MATCHES "libc6")
  message(FATAL_ERROR "the package depends on: ${depends}")
endif()
# The program of the package reads the configuration of the package.
run(configuration ${FOLDER}/extracted/usr/bin/terracut
    --config ${FOLDER}/extracted/etc/terracut/terracut.yaml config)
file(READ ${FOLDER}/extracted/etc/terracut/terracut.yaml expected)
if(NOT configuration STREQUAL expected)
  message(FATAL_ERROR "the program prints another configuration than its package has")
endif()
foreach(script postinst prerm postrm)
  run(ignored sh -n ${FOLDER}/extracted/DEBIAN/${script})
endforeach()
# Recordings outlive the package, until it is purged.
set(root ${FOLDER}/root)
file(WRITE ${root}/var/lib/private/terracut/dumps/one.pcap "packets")
foreach(action remove purge)
  run(ignored ${CMAKE_COMMAND} -E env DPKG_ROOT=${root}
      sh ${FOLDER}/extracted/DEBIAN/postrm ${action})
  if(action STREQUAL remove AND NOT EXISTS ${root}/var/lib/private/terracut/dumps/one.pcap)
    message(FATAL_ERROR "removing the package removed the recordings")
  endif()
endforeach()
if(EXISTS ${root}/var/lib/private/terracut)
  message(FATAL_ERROR "purging the package left the recordings")
endif()

if(LINTIAN)
  run(ignored ${LINTIAN} --fail-on error
      --suppress-tags embedded-library,static-library-has-unneeded-sections ${packages})
endif()
