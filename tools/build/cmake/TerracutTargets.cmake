# terracut_compile_apart(sources...): where builds join several sources into one (CMAKE_UNITY_BUILD), these stay
#   alone, because a name of their own is also one of a neighbour's.
function(terracut_compile_apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# terracut_add_room(NAME SOURCES... [APART sources...] [HEADERS headers...] [EXPORTED_AS name] [PUBLIC libs...]
#                   [PRIVATE libs...])
#   a static library: terracut_<name>, alias terracut::<name>. HEADERS are its public ones, below terracut/ of the
#   room: all that is installed of it. EXPORTED_AS: what users call it, by find_package(terracut) or FetchContent, else <name>.
function(terracut_add_room name)
  cmake_parse_arguments(arg "" "EXPORTED_AS" "SOURCES;APART;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  terracut_compile_apart(${arg_APART})
  add_library(terracut_${name} STATIC ${arg_SOURCES})
  add_library(terracut::${name} ALIAS terracut_${name})
  if(arg_EXPORTED_AS)
    add_library(terracut::${arg_EXPORTED_AS} ALIAS terracut_${name})
  else()
    set(arg_EXPORTED_AS ${name})
  endif()
  set_target_properties(terracut_${name} PROPERTIES
    EXPORT_NAME ${arg_EXPORTED_AS} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(terracut_${name} PUBLIC cxx_std_20)
  target_include_directories(terracut_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_sources(terracut_${name} PUBLIC FILE_SET HEADERS
    BASE_DIRS ${CMAKE_CURRENT_SOURCE_DIR} FILES ${arg_HEADERS})
  target_link_libraries(terracut_${name} PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:terracut_flags> ${arg_PRIVATE})
  if(NOT name STREQUAL rt)
    target_precompile_headers(terracut_${name} REUSE_FROM terracut_rt)
  endif()
endfunction()

# terracut_optimise(sources...): for tests that run longer than it takes to compile them. The headers that are precompiled
#   for the other tests, without optimisation, cannot serve them.
function(terracut_optimise)
  terracut_compile_apart(${ARGN})
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O1 SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# terracut_add_test(NAME SOURCES... LIBS... [APART sources...] [LABELS ...] [TIMEOUT seconds])
#   a GoogleTest program, every suite an entry of ctest (DiscoverSuites.cmake). LABELS is one word; "threads" says that
#   there is something to find for ThreadSanitizer and adds the program to `threaded_tests`,
#   "realtime" the same for RealtimeSanitizer and `realtime_tests`.
function(terracut_add_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;LIBS;APART;LABELS" ${ARGN})
  terracut_compile_apart(${arg_APART})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 900)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBS} terracut_flags terracut_test_flags terracut_test_places GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM terracut_test_places)
  if(NOT arg_LABELS)
    set(arg_LABELS unit)  # an empty list would make the next word the label
  endif()
  if(arg_LABELS STREQUAL threads)
    set_property(GLOBAL APPEND PROPERTY TERRACUT_THREADED_TESTS ${name})
  elseif(arg_LABELS STREQUAL realtime)
    set_property(GLOBAL APPEND PROPERTY TERRACUT_REALTIME_TESTS ${name})
  endif()
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${suites} VERBATIM
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DPROGRAM=$<TARGET_FILE:${name}> -DFILE=${suites}
            -DLABELS=${arg_LABELS} -DTIMEOUT=${arg_TIMEOUT}
            -P ${PROJECT_SOURCE_DIR}/tools/build/cmake/DiscoverSuites.cmake)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake
    "if(EXISTS \"${suites}\")\n  include(\"${suites}\")\nelse()\n  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
endfunction()

# terracut_add_fuzzer(NAME SOURCES... LIBS...)
#   built in every build: with libFuzzer when TERRACUT_LIBFUZZER, else with a main that replays
#   files given on the command line (and so keeps the target from rotting). Where there is a folder
#   corpus/<name> of seeds beside it, replaying them is a test.
function(terracut_add_fuzzer name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBS" ${ARGN})
  if(NOT TERRACUT_LIBFUZZER)
    # Before the target's own: it declares weakly what that may define, in one unity source with it.
    list(PREPEND arg_SOURCES ${PROJECT_SOURCE_DIR}/tests/fuzz/replay_main.cpp)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBS} terracut_flags)
  if(TERRACUT_LIBFUZZER)
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    target_compile_options(${name} PRIVATE -fPIC)  # as in the rooms, whose precompiled headers serve here too
    target_precompile_headers(${name} REUSE_FROM terracut_rt)
  else()
    target_link_libraries(${name} PRIVATE terracut_test_flags)
    target_precompile_headers(${name} REUSE_FROM terracut_test_places)
    file(GLOB seeds CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/corpus/${name}/*)
    if(seeds)
      add_test(NAME Fuzz.${name} COMMAND ${name} ${seeds})
      set_tests_properties(Fuzz.${name} PROPERTIES LABELS unit TIMEOUT 300)
    endif()
  endif()
  set_property(GLOBAL APPEND PROPERTY TERRACUT_FUZZERS ${name})
endfunction()
