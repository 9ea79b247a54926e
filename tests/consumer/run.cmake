# Installs the build in BUILD_DIR to a staging folder, builds the consumer project against it and runs
# what came out: cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DCXX=... -P run.cmake
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
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${work}/build -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_PREFIX_PATH=${work}/stage)
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer ${work}/000000.label)
file(READ ${work}/000000.label label HEX)
if(NOT label STREQUAL "28000000")
  message(FATAL_ERROR "the consumer wrote '${label}'; expected one ground label, 28000000")
endif()
run(${work}/stage/bin/terracut --version)
