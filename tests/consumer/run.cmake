# Installs the build in BUILD_DIR to a staging folder, builds the consumer programs against it and runs them:
# cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DCXX=... -P run.cmake
set(work ${BUILD_DIR}/consumer)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${work}/stage)

# Nothing is installed but the public headers.
file(GLOB_RECURSE headers RELATIVE ${work}/stage/include ${work}/stage/include/*)
list(SORT headers)
set(public calibration decoder error frame free_way ground_grid live_run object outputs packet_pipeline segmenter sensor)
list(TRANSFORM public PREPEND terracut/)
list(TRANSFORM public APPEND .hpp)
if(NOT headers STREQUAL public)
  message(FATAL_ERROR "installed headers are ${headers}; expected ${public}")
endif()

foreach(only OFF ON)
  run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${work}/build_${only} -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_PREFIX_PATH=${work}/stage -DONLY_SEGMENTATION=${only})
  run(${CMAKE_COMMAND} --build ${work}/build_${only} --parallel)
endforeach()

# By pkg-config, without CMake.
find_program(pkg_config NAMES pkg-config)
if(pkg_config)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${work}/stage/lib/pkgconfig
    ${pkg_config} --cflags --libs terracut OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${CXX} -std=c++20 ${SOURCE_DIR}/packets_to_labels.cpp ${flags} -o ${work}/by_pkg_config)
  execute_process(COMMAND ${work}/by_pkg_config RESULT_VARIABLE result)
  if(NOT result EQUAL 2)  # it wants a capture and a folder
    message(FATAL_ERROR "the program built by pkg-config ended with ${result}")
  endif()
endif()

# As a part of a user's project. Only the program's own file is compiled: those of the library are the same as here.
file(COPY ${SOURCE_DIR}/fetched DESTINATION ${work})
configure_file(${SOURCE_DIR}/cloud_to_labels.cpp ${work}/fetched/my_program.cpp COPYONLY)
run(${CMAKE_COMMAND} -S ${work}/fetched -B ${work}/fetched/build -G Ninja -DCMAKE_CXX_COMPILER=${CXX}
    -DFETCHCONTENT_SOURCE_DIR_TERRACUT=${SOURCE_DIR}/../..)
run(${CMAKE_COMMAND} --build ${work}/fetched/build --target ${work}/fetched/my_program.cpp^)

# Packets to labels.
set(terracut ${work}/stage/bin/terracut)
file(MAKE_DIRECTORY ${work}/frames)
run(${terracut} simulate --scene street --duration 1.3 -o ${work}/drive.pcap)
run(${work}/build_OFF/packets_to_labels ${work}/drive.pcap ${work}/frames)
file(GLOB frames ${work}/frames/*.pcd)
list(LENGTH frames count)
if(count LESS 12)
  message(FATAL_ERROR "packets_to_labels wrote ${count} frames of 13")
endif()

# A cloud to labels: one of the drive's frames, as a scan of 64 rings from the top.
find_program(python NAMES python3)
if(python)
  run(${python} ${SOURCE_DIR}/scan_of_pcd.py ${work}/frames/5.pcd ${work}/scan.bin)
  run(${work}/build_ON/cloud_to_labels ${work}/scan.bin ${work}/scan.label)
  # A .label file as all readers of SemanticKITTI expect it: a uint32 a point, ground or obstacle.
  run(${python} -c "import sys, struct
points = len(open(sys.argv[1], 'rb').read()) // 16
labels = struct.unpack(f'<{points}I', open(sys.argv[2], 'rb').read())
sys.exit(set(labels) != {40, 99})" ${work}/scan.bin ${work}/scan.label)
endif()
execute_process(COMMAND ${work}/build_ON/cloud_to_labels ${work}/none.bin ${work}/none.label RESULT_VARIABLE result
                ERROR_VARIABLE errors)
if(NOT result EQUAL 1 OR NOT errors MATCHES "none.bin cannot be read")
  message(FATAL_ERROR "cloud_to_labels of no scan ended with ${result}: ${errors}")
endif()

# Live, against a sender on the loopback that goes on until it is heard.
execute_process(
  COMMAND ${terracut} send ${work}/drive.pcap --to 127.0.0.1:23688 --loop 20
  COMMAND ${work}/build_OFF/live 23688 5
  OUTPUT_VARIABLE lines RESULT_VARIABLE result ERROR_VARIABLE errors)
if(NOT result EQUAL 0 OR NOT lines MATCHES "stands 1.7.*frame [0-9]+: [0-9]+ labels"
   OR NOT errors MATCHES "missed, [1-9][0-9]+ labels while")
  message(FATAL_ERROR "live failed (${result}): ${lines} ${errors}")
endif()

# The guide shows these very programs, and this project.
function(check_guide page file heading)
  file(READ ${SOURCE_DIR}/../../docs/guide/${page} guide)
  file(READ ${SOURCE_DIR}/${file} text)
  string(REGEX REPLACE "^${heading}" "" text "${text}")
  string(FIND "${guide}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "docs/guide/${page} shows another ${file}")
  endif()
endfunction()
foreach(program packets_to_labels cloud_to_labels live)
  check_guide(embedding.md ${program}.cpp "//[^\n]*\n//[^\n]*\n")
endforeach()
check_guide(install.md fetched/CMakeLists.txt ".*LANGUAGES CXX\\)\n")
