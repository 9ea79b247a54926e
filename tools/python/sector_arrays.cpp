// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sector_arrays.hpp"

#include <cstddef>

namespace terracut::python {
namespace py = pybind11;

py::array array_of_sectors(std::span<const FreeWaySector> sectors, const py::object& base) {
  const py::str number("<f4");
  py::dict fields;
  fields["names"] = py::make_tuple("azimuth_rad", "obstacle_m", "seen_m", "seen_end");
  fields["formats"] = py::make_tuple(number, number, number, py::str("u1"));
  fields["offsets"] =
      py::make_tuple(offsetof(FreeWaySector, azimuth_rad), offsetof(FreeWaySector, obstacle_m),
                     offsetof(FreeWaySector, seen_m), offsetof(FreeWaySector, seen_end));
  fields["itemsize"] = sizeof(FreeWaySector);
  const auto count = static_cast<py::ssize_t>(sectors.size());
  return {py::dtype::from_args(fields),
          {count},
          {static_cast<py::ssize_t>(sizeof(FreeWaySector))},
          sectors.data(),
          base};
}

}  // namespace terracut::python
