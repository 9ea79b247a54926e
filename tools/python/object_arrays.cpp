// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_arrays.hpp"

#include <cstddef>

namespace terracut::python {
namespace py = pybind11;
namespace {

py::dtype object_type() {
  py::list names, formats, offsets;
  const auto add = [&](const char* name, const py::object& format, std::size_t offset) {
    names.append(name);
    formats.append(format);
    offsets.append(offset);
  };
  const py::str count("<u4"), number("<f4");
  constexpr std::size_t kBox = offsetof(Object, box), kFootprint = offsetof(Object, footprint);
  add("returns", count, offsetof(Object, returns));
  add("first_return", count, offsetof(Object, first_return));
  add("last_return", count, offsetof(Object, last_return));
  add("bottom_m", number, offsetof(Object, bottom_m));
  add("top_m", number, offsetof(Object, top_m));
  add("ground_z_m", number, offsetof(Object, ground_z_m));
  add("x_m", number, kBox + offsetof(Box, middle) + offsetof(Corner, x_m));
  add("y_m", number, kBox + offsetof(Box, middle) + offsetof(Corner, y_m));
  add("along_x", number, kBox + offsetof(Box, along) + offsetof(Corner, x_m));
  add("along_y", number, kBox + offsetof(Box, along) + offsetof(Corner, y_m));
  add("length_m", number, kBox + offsetof(Box, length_m));
  add("width_m", number, kBox + offsetof(Box, width_m));
  add("corner_count", count, kFootprint + offsetof(Footprint, count));
  add("corners", py::make_tuple(number, py::make_tuple(Footprint::kMostCorners, 2)),
      kFootprint + offsetof(Footprint, corners));
  py::dict fields;
  fields["names"] = names;
  fields["formats"] = formats;
  fields["offsets"] = offsets;
  fields["itemsize"] = sizeof(Object);
  return py::dtype::from_args(fields);
}

}  // namespace

py::array array_of_objects(std::span<const Object> objects, const py::object& base) {
  const auto count = static_cast<py::ssize_t>(objects.size());
  return {object_type(), {count}, {static_cast<py::ssize_t>(sizeof(Object))}, objects.data(), base};
}

}  // namespace terracut::python
