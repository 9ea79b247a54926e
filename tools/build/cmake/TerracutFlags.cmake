# terracut_flags: how every target of the project is compiled. Never exported to consumers.
add_library(terracut_flags INTERFACE)
target_compile_options(terracut_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wcast-align -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual
  # Promise 5 of docs/design.md: the same packets give the same labels on every machine, so no
  # compiler may fuse a multiply and an add.
  -ffp-contract=off)
# GCC 12 sees overlapping copies in "text" + std::string where there are none (GCC bug 105651).
target_compile_options(terracut_flags INTERFACE
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
# Per-point loops are written to be vectorised; GCC 12 does that at -O3 only.
target_compile_options(terracut_flags INTERFACE
  $<$<CONFIG:Release,RelWithDebInfo>:-O3> $<$<CXX_COMPILER_ID:GNU>:-fno-math-errno>
  $<$<CXX_COMPILER_ID:Clang>:-fno-math-errno>)
if(TERRACUT_DEVELOPER_MODE AND NOT (TERRACUT_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU))
  # GCC's manual warns that instrumented code gives false warnings; the plain build refuses them.
  target_compile_options(terracut_flags INTERFACE -Werror)
endif()
if(TERRACUT_SANITIZE)
  target_compile_options(terracut_flags INTERFACE
    -fsanitize=${TERRACUT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(terracut_flags INTERFACE -fsanitize=${TERRACUT_SANITIZE})
  target_compile_definitions(terracut_flags INTERFACE TERRACUT_SANITIZED_BUILD)
endif()
# Promise 3 of docs/design.md while compiling: what is marked calls only what may be called. Before
# clang 22 the same warning also wants every definition to repeat its declaration's mark.
set(terracut_checks_function_effects OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 20)
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 22)
    target_compile_options(terracut_flags INTERFACE -Wno-function-effects)
  elseif(TERRACUT_SANITIZE STREQUAL realtime)
    target_compile_options(terracut_flags INTERFACE -Wfunction-effects)
    set(terracut_checks_function_effects ON)
  endif()
endif()
if(TERRACUT_LIBFUZZER)
  # Coverage feedback in the libraries too; the fuzzer's own main is linked per target.
  target_compile_options(terracut_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# terracut_test_flags: for tests, after terracut_flags. Compiling a test takes longer than running it,
# so what is tested is optimised, and the tests themselves are not.
add_library(terracut_test_flags INTERFACE)
target_compile_options(terracut_test_flags INTERFACE -O0)
if(TERRACUT_LIBFUZZER)
  # Coverage guides the fuzzers, which are no tests; in a test it costs an eighth of the compiler's time.
  target_compile_options(terracut_test_flags INTERFACE -fno-sanitize=fuzzer-no-link)
endif()
# What every test and replayed fuzzer may include is precompiled for all of them (terracut_test_places).
target_link_libraries(terracut_test_flags INTERFACE GTest::gtest GTest::gmock)

# Clang's precompiled headers would hold the hour they were made, which no compiler cache knows again.
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  target_compile_options(terracut_flags INTERFACE "SHELL:-Xclang -fno-pch-timestamp")
endif()
