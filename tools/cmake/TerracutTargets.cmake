# terracut_add_room(NAME SOURCES... [PUBLIC libs...] [PRIVATE libs...])
#   one static library per top-level folder: terracut_<name>, alias terracut::<name>.
function(terracut_add_room name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(terracut_${name} STATIC ${arg_SOURCES})
  add_library(terracut::${name} ALIAS terracut_${name})
  set_target_properties(terracut_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(terracut_${name} PUBLIC cxx_std_20)
  target_include_directories(terracut_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    # <terracut/pipeline/x.hpp> for consumers, "pipeline/x.hpp" between the installed headers.
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/terracut>)
  target_link_libraries(terracut_${name} PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:terracut_flags> ${arg_PRIVATE})
endfunction()

# terracut_add_test(NAME SOURCES... LIBS... [LABELS ...] [TIMEOUT seconds])
#   a GoogleTest program, every case its own ctest entry. LABELS is one word; "threads" says that
#   there is something to find for ThreadSanitizer and adds the program to `threaded_tests`,
#   "realtime" the same for RealtimeSanitizer and `realtime_tests`.
function(terracut_add_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LIBS;LABELS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBS} terracut_flags terracut_test_flags terracut_test_places GTest::gtest GTest::gmock GTest::gtest_main)
  if(NOT arg_LABELS)
    set(arg_LABELS unit)  # an empty list would make the next word the label
  endif()
  if(arg_LABELS STREQUAL threads)
    set_property(GLOBAL APPEND PROPERTY TERRACUT_THREADED_TESTS ${name})
  elseif(arg_LABELS STREQUAL realtime)
    set_property(GLOBAL APPEND PROPERTY TERRACUT_REALTIME_TESTS ${name})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
endfunction()

# terracut_add_fuzzer(NAME SOURCES... LIBS...)
#   built in every build: with libFuzzer when TERRACUT_LIBFUZZER, else with a main that replays
#   files given on the command line (and so keeps the target from rotting). Where there is a folder
#   corpus/<name> of seeds beside it, replaying them is a test.
function(terracut_add_fuzzer name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBS} terracut_flags)
  if(TERRACUT_LIBFUZZER)
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  else()
    target_sources(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/fuzz/replay_main.cpp)
    file(GLOB seeds CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/corpus/${name}/*)
    if(seeds)
      add_test(NAME Fuzz.${name} COMMAND ${name} ${seeds})
      set_tests_properties(Fuzz.${name} PROPERTIES LABELS unit TIMEOUT 300)
    endif()
  endif()
  set_property(GLOBAL APPEND PROPERTY TERRACUT_FUZZERS ${name})
endfunction()
