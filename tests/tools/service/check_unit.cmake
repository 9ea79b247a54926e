# systemd's own opinion of the unit. Its program is replaced by the built one, which is there.
cmake_minimum_required(VERSION 3.22)
if(NOT ANALYZE)
  message("skipped: systemd-analyze is not installed")
  return()
endif()
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
file(READ ${UNIT} unit)
if(NOT unit MATCHES "ExecStart=/usr/bin/terracut live ")
  message(FATAL_ERROR "the unit does not start `terracut live`")
endif()
string(REPLACE "ExecStart=/usr/bin/terracut " "ExecStart=${PROGRAM} " unit "${unit}")
file(WRITE ${FOLDER}/terracut.service "${unit}")

execute_process(COMMAND ${ANALYZE} verify --man=no ${FOLDER}/terracut.service
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
# Other units of the machine may have faults of their own; ours must not be among the names.
if(NOT result EQUAL 0 OR output MATCHES "terracut")
  message(FATAL_ERROR "systemd-analyze verify: ${output}")
endif()

execute_process(COMMAND ${ANALYZE} security --offline=true --threshold=25 --no-pager
  ${FOLDER}/terracut.service
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error)
if(error MATCHES "unrecognized option")
  message("systemd-analyze is too old to judge the protection of a file; only verified")
elseif(NOT result EQUAL 0)
  message(FATAL_ERROR "systemd-analyze security finds the service too exposed: ${output}${error}")
endif()
