# Lists the suites of a GoogleTest program for ctest, one entry and one process a suite: a process a case would start
# seven times as many. Run by terracut_add_test() whenever the program was linked:
# cmake -DNAME=... -DPROGRAM=... -DFILE=... -DLABELS=... -DTIMEOUT=... -P DiscoverSuites.cmake
cmake_minimum_required(VERSION 3.23)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  TIMEOUT 60 OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE " +#[^\n]*" "" listed "${listed}")  # types and values of parameters
string(REGEX MATCHALL "(^|\n)[^ \n]+\\.\n  " heads "${listed}")
set(entries "")
set(suites "")
foreach(head IN LISTS heads)
  string(REGEX REPLACE "^\n?([^ \n]+)\\.\n  $" "\\1" suite "${head}")
  string(APPEND entries "add_test(\"${suite}\" \"${PROGRAM}\" \"--gtest_filter=${suite}.*\")\n")
  list(APPEND suites "\"${suite}\"")
endforeach()
list(JOIN suites " " suites)
file(WRITE ${FILE} "${entries}set(${NAME}_TESTS ${suites})
set_tests_properties(${suites} PROPERTIES LABELS \"${LABELS}\" TIMEOUT ${TIMEOUT})\n")
