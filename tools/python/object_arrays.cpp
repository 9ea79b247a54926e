// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_arrays.hpp"

#include <cstddef>

namespace terracut::python {
namespace py = pybind11;
namespace {

/// The fields of a record, added one by one.
class Fields {
 public:
  void add(const char* name, const py::object& format, std::size_t offset) {
    names_.append(name);
    formats_.append(format);
    offsets_.append(offset);
  }
  [[nodiscard]] py::dtype type(std::size_t bytes) const {
    py::dict fields;
    fields["names"] = names_;
    fields["formats"] = formats_;
    fields["offsets"] = offsets_;
    fields["itemsize"] = bytes;
    return py::dtype::from_args(fields);
  }

 private:
  py::list names_, formats_, offsets_;
};

/// Returns the fields of an object at the beginning of a record.
Fields fields_of_object() {
  Fields fields;
  const auto add = [&](const char* name, const py::object& format, std::size_t offset) {
    fields.add(name, format, offset);
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
  return fields;
}

template <class Record>
py::array array_of(std::span<const Record> records, const Fields& fields, const py::object& base) {
  return {fields.type(sizeof(Record)),
          {static_cast<py::ssize_t>(records.size())},
          {static_cast<py::ssize_t>(sizeof(Record))},
          records.data(),
          base};
}

}  // namespace

py::array array_of_objects(std::span<const Object> objects, const py::object& base) {
  return array_of(objects, fields_of_object(), base);
}

py::array array_of_objects(std::span<const CompleteObject> objects, const py::object& base) {
  static_assert(offsetof(CompleteObject, object) == 0);
  Fields fields = fields_of_object();
  fields.add("frame", py::str("<u4"), offsetof(CompleteObject, frame));
  fields.add("last_packet_ns", py::str("<i8"), offsetof(CompleteObject, last_packet_ns));
  return array_of(objects, fields, base);
}

}  // namespace terracut::python
