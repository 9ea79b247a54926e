# Choices a builder can make; everything else is fixed.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# In another project (FetchContent) nothing is built but the libraries.
option(TERRACUT_DEVELOPER_MODE "Warnings are errors" OFF)
option(TERRACUT_BUILD_TESTS "Build tests, benchmarks and fuzz reproducers" ${PROJECT_IS_TOP_LEVEL})
set(TERRACUT_SANITIZE "" CACHE STRING "Sanitizers for every target: 'address,undefined', 'thread', 'realtime' or empty")
option(TERRACUT_LIBFUZZER "Link fuzz targets with libFuzzer (clang) instead of the reproducer main" OFF)
option(TERRACUT_PYTHON "Build the Python module, where pybind11 and Python's headers are there" ${PROJECT_IS_TOP_LEVEL})
