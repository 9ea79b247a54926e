# Builds the Debian packages of this build and looks into them.
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
file(GLOB packages RELATIVE ${FOLDER} ${FOLDER}/*.deb)
list(TRANSFORM packages REPLACE "_${VERSION}_[a-z0-9]+\\.deb$" "")
set(expected libterracut-dev terracut)
if(WITH_PYTHON)
  list(PREPEND expected python3-terracut)
  list(SORT expected)
endif()
if(NOT packages STREQUAL expected)
  message(FATAL_ERROR "expected the packages ${expected}, found: ${packages}")
endif()

# check_content(PACKAGE paths...): it holds these, beside its licence, and nothing in places of this machine.
function(check_content package)
  file(GLOB file ${FOLDER}/${package}_${VERSION}_*.deb)
  run(content ${DPKG_DEB} -c ${file})
  foreach(path ${ARGN} ./usr/share/doc/${package}/copyright)
    string(FIND "${content}" "${path}\n" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "${package} has no ${path}:\n${content}")
    endif()
  endforeach()
  if(content MATCHES "(${BUILD_DIR}|\\./usr/local)")
    message(FATAL_ERROR "${package} has files in places of this machine:\n${content}")
  endif()
  run(ignored ${DPKG_DEB} --raw-extract ${file} ${FOLDER}/${package})
  run(depends ${DPKG_DEB} -f ${file} Depends)
  set(content "${content}" PARENT_SCOPE)
  set(depends "${depends}" PARENT_SCOPE)
endfunction()

check_content(libterracut-dev ./usr/include/terracut/segmenter.hpp libterracut_pipeline.a terracut/terracut-config.cmake)
if(content MATCHES "/usr/bin" OR NOT depends MATCHES "libeigen3-dev.*libyaml-cpp-dev")
  message(FATAL_ERROR "libterracut-dev depends on ${depends} and holds:\n${content}")
endif()
if(WITH_PYTHON)
  check_content(python3-terracut ./usr/lib/python3/dist-packages/terracut/__init__.py)
  if(NOT content MATCHES "/_terracut\\.cpython" OR NOT depends MATCHES "python3-numpy.*libc6")
    message(FATAL_ERROR "python3-terracut depends on ${depends} and holds:\n${content}")
  endif()
endif()
check_content(terracut
  ./usr/bin/terracut
  ./usr/lib/systemd/system/terracut.service
  ./etc/terracut/terracut.yaml
  ./usr/share/doc/terracut/docs/guide/real_time.md
  ./usr/share/doc/terracut/docs/reference/configuration.md
  ./usr/share/doc/terracut/examples/read_frames.py
  ./usr/share/terracut/terracut_health.dbc
  ./usr/share/terracut/grafana.json
  ./usr/share/terracut/presets/car.yaml
  ./usr/share/terracut/ros2/terracut_ros/package.xml
  ./usr/share/bash-completion/completions/terracut)
if(content MATCHES "/usr/include" OR NOT depends MATCHES "libc6")
  message(FATAL_ERROR "terracut depends on ${depends} and holds:\n${content}")
endif()

set(extracted ${FOLDER}/terracut)
file(READ ${extracted}/DEBIAN/conffiles conffiles)
if(NOT conffiles STREQUAL "/etc/terracut/terracut.yaml\n")
  message(FATAL_ERROR "conffiles: ${conffiles}")
endif()
# The program of the package reads the configuration of the package.
run(configuration ${extracted}/usr/bin/terracut --config ${extracted}/etc/terracut/terracut.yaml config)
file(READ ${extracted}/etc/terracut/terracut.yaml expected)
if(NOT configuration STREQUAL expected)
  message(FATAL_ERROR "the program prints another configuration than its package has")
endif()
# A page of the manual for the program and for each command, the first and the last among them, with that command's options.
if(HELP2MAN)
  foreach(page terracut terracut-replay terracut-doctor)
    run(text gzip -dc ${extracted}/usr/share/man/man1/${page}.1.gz)
    if(NOT text MATCHES "\n${page} [^\n]*- ")
      message(FATAL_ERROR "the manual page of ${page} is:\n${text}")
    endif()
  endforeach()
  run(text gzip -dc ${extracted}/usr/share/man/man1/terracut-replay.1.gz)
  if(NOT text MATCHES "mount.-height")
    message(FATAL_ERROR "the manual page of replay lacks --mount-height:\n${text}")
  endif()
endif()
# bash asks the program for its commands, options and words of choice.
find_program(BASH bash)
if(BASH)
  # check_completion(EXPECTED words...): of the last word.
  function(check_completion expected)
    run(found ${BASH} -c ". $0 && COMP_WORDS=(\"$@\") && COMP_CWORD=$(($# - 1)) && _terracut && echo -n \"\${COMPREPLY[*]}\""
        ${extracted}/usr/share/bash-completion/completions/terracut ${extracted}/usr/bin/terracut ${ARGN})
    if(NOT found STREQUAL expected)
      message(FATAL_ERROR "bash completes 'terracut ${ARGN}' by '${found}', and not by '${expected}'")
    endif()
  endfunction()
  check_completion("replay relabel" re)
  check_completion("--mount-height --mount-roll --mount-pitch --mount-guess" replay --mo)
  check_completion("vlp16 vlp32c vls128" live --sensor vl)
  check_completion("" replay --config te)
endif()
foreach(script postinst prerm postrm)
  run(ignored sh -n ${extracted}/DEBIAN/${script})
endforeach()
# Recordings outlive the package, until it is purged.
set(root ${FOLDER}/root)
file(WRITE ${root}/var/lib/private/terracut/dumps/one.pcap "packets")
foreach(action remove purge)
  run(ignored ${CMAKE_COMMAND} -E env DPKG_ROOT=${root} sh ${extracted}/DEBIAN/postrm ${action})
  if(action STREQUAL remove AND NOT EXISTS ${root}/var/lib/private/terracut/dumps/one.pcap)
    message(FATAL_ERROR "removing the package removed the recordings")
  endif()
endforeach()
if(EXISTS ${root}/var/lib/private/terracut)
  message(FATAL_ERROR "purging the package left the recordings")
endif()

if(LINTIAN)
  file(GLOB files ${FOLDER}/*.deb)
  run(ignored ${LINTIAN} --fail-on error
      --suppress-tags bogus-mail-host,embedded-library,static-library-has-unneeded-sections ${files})
endif()
