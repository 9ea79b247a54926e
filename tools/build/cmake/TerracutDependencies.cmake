# Every dependency, found here and nowhere else. Messages name the Debian package to install.
function(terracut_require found what package)
  if(NOT ${found})
    message(FATAL_ERROR "terracut needs ${what}, which was not found. "
                        "Install it with: apt-get install ${package} (or run ./tools/setup)")
  endif()
endfunction()

find_package(Threads REQUIRED)

find_package(Eigen3 3.3 QUIET NO_MODULE)
terracut_require(Eigen3_FOUND "Eigen" libeigen3-dev)

find_package(tl-expected QUIET)
terracut_require(tl-expected_FOUND "tl::expected" libexpected-dev)

find_package(pugixml QUIET)
terracut_require(pugixml_FOUND "pugixml" libpugixml-dev)

find_package(yaml-cpp QUIET)
terracut_require(yaml-cpp_FOUND "yaml-cpp" libyaml-cpp-dev)
if(NOT TARGET yaml-cpp::yaml-cpp)  # 0.7 exports the bare name
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()

find_package(fmt QUIET)
terracut_require(fmt_FOUND "fmt" libfmt-dev)

find_package(PNG QUIET)
terracut_require(PNG_FOUND "libpng" libpng-dev)

include(TerracutPcap)
terracut_require(PCAP_FOUND "libpcap" libpcap-dev)

find_package(ZLIB QUIET)
terracut_require(ZLIB_FOUND "zlib" zlib1g-dev)

include(TerracutZstd)
terracut_require(ZSTD_FOUND "libzstd" libzstd-dev)

# Optional: without them the program says what to install where a bag needs one.
include(TerracutLz4)
find_package(SQLite3 QUIET)
if(NOT LZ4_FOUND OR NOT SQLite3_FOUND)
  message(STATUS "Without liblz4 or SQLite, so some bags cannot be read. "
                 "Install them with: apt-get install liblz4-dev libsqlite3-dev (or run ./tools/setup)")
endif()

# The libraries need no more.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

find_package(nlohmann_json QUIET)
terracut_require(nlohmann_json_FOUND "nlohmann::json" nlohmann-json3-dev)

find_package(CLI11 QUIET)
terracut_require(CLI11_FOUND "CLI11" libcli11-dev)

find_package(OpenSSL COMPONENTS Crypto QUIET)
terracut_require(OPENSSL_FOUND "OpenSSL" libssl-dev)

# Optional: without it the program says what to install where it is asked for DDS.
find_package(CycloneDDS 0.10 QUIET)
find_program(TERRACUT_IDLC idlc)
mark_as_advanced(TERRACUT_IDLC)
if(CycloneDDS_FOUND AND TERRACUT_IDLC)
  set(TERRACUT_HAS_DDS ON)
  enable_language(C)  # of what idlc generates
else()
  set(TERRACUT_HAS_DDS OFF)
  message(STATUS "No Cyclone DDS 0.10 with idlc, so `terracut node` and --dds are left out. "
                 "Install it with: apt-get install cyclonedds-dev cyclonedds-tools (or run ./tools/setup --dds)")
endif()

# Beast serves whoever comes by HTTP; in tests, Boost.Graph is the independent min-cut solver.
find_package(Boost QUIET)
terracut_require(Boost_FOUND "Boost headers" libboost-dev)

# Of the distribution's own Python, for which its pybind11 and numpy are; another one: -DPython_EXECUTABLE=...
# The interpreter is not instrumented, and the program that its tests run beside the module brings a runtime of its own.
if(TERRACUT_SANITIZE)
  set(TERRACUT_PYTHON OFF)
endif()
if(TERRACUT_PYTHON)
  if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python 3.9 COMPONENTS Interpreter Development.Module QUIET)
  find_package(pybind11 2.9 CONFIG QUIET)
  if(NOT Python_FOUND OR NOT pybind11_FOUND)
    message(STATUS "No Python module: install it with apt-get install pybind11-dev python3-dev python3-numpy")
    set(TERRACUT_PYTHON OFF)
  endif()
endif()

if(TERRACUT_BUILD_TESTS)
  find_package(GTest QUIET)
  terracut_require(GTest_FOUND "GoogleTest" "libgtest-dev libgmock-dev")
  find_package(benchmark QUIET)
  terracut_require(benchmark_FOUND "Google Benchmark" libbenchmark-dev)
endif()
