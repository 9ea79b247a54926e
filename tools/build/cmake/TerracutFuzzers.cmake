# Gathers every fuzz target: the build target `fuzzers`, and fuzzers.txt, from which tools/test runs them.
get_property(terracut_fuzzers GLOBAL PROPERTY TERRACUT_FUZZERS)
add_custom_target(fuzzers DEPENDS ${terracut_fuzzers})
set(lines "")
foreach(fuzzer IN LISTS terracut_fuzzers)
  string(APPEND lines "$<TARGET_FILE:${fuzzer}>\n")
endforeach()
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/fuzzers.txt CONTENT "${lines}")
