// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_arrays.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>

#include "json_object.hpp"
#include "object_arrays.hpp"
#include "sector_arrays.hpp"
#include "tools/cli/figures/run_report.hpp"

namespace terracut::python {
namespace py = pybind11;
namespace {

using stream::WirePoint;

py::dtype point_type() {
  py::list names, formats, offsets;
  const auto add = [&](const char* name, const char* format, std::size_t offset) {
    names.append(name);
    formats.append(format);
    offsets.append(offset);
  };
  add("x", "<f4", offsetof(WirePoint, x_m));
  add("y", "<f4", offsetof(WirePoint, y_m));
  add("z", "<f4", offsetof(WirePoint, z_m));
  add("intensity", "u1", offsetof(WirePoint, intensity));
  add("label", "u1", offsetof(WirePoint, label));
  add("ring", "<u2", offsetof(WirePoint, row));
  add("time", "<f4", offsetof(WirePoint, time_s));
  return {names, formats, offsets, sizeof(WirePoint)};
}

py::array array_of(const py::object& self, const py::dtype& type, std::size_t offset,
                   py::ssize_t columns) {
  const auto& points = self.cast<const FrameData&>().points;
  const auto rows = static_cast<py::ssize_t>(points.size());
  const auto step = static_cast<py::ssize_t>(sizeof(WirePoint));
  const auto* at =
      reinterpret_cast<const std::byte*>(points.data()) + (points.empty() ? 0 : offset);
  if (columns == 1) return {type, {rows}, {step}, at, self};
  return {type, {rows, columns}, {step, type.itemsize()}, at, self};
}

template <class T>
auto view(std::size_t offset, py::ssize_t columns = 1) {
  return [offset, columns](const py::object& self) {
    return array_of(self, py::dtype::of<T>(), offset, columns);
  };
}

}  // namespace

void bind_frame(py::module_& module) {
  using Class = py::class_<FrameData, std::shared_ptr<FrameData>>;
  const auto of_info = [](auto member) {
    return [member](const FrameData& frame) { return frame.info.*member; };
  };
  Class(module, "Frame", "One labelled revolution of the sensor; its arrays share its memory.")
      .def_property_readonly("number", of_info(&frame::FrameInfo::number))
      .def_property_readonly("first_packet_ns", of_info(&frame::FrameInfo::first_packet_ns))
      .def_property_readonly("last_packet_ns", of_info(&frame::FrameInfo::last_packet_ns))
      .def_readonly("first_return", &FrameData::first_return)
      .def_property_readonly("complete", of_info(&frame::FrameInfo::complete))
      .def_property_readonly("deskewed",
                             [](const FrameData& frame) {
                               return frame.info.deskew.state == frame::DeskewState::kDone;
                             })
      .def_property_readonly("report",
                             [](const FrameData& frame) -> py::object {
                               if (!frame.record) return py::none();
                               return json_object(cli::frame_json(*frame.record));
                             })
      .def_property_readonly(
          "data", [](const py::object& self) { return array_of(self, point_type(), 0, 1); })
      .def_property_readonly("points", view<float>(offsetof(WirePoint, x_m), 3))
      .def_property_readonly("intensity", view<std::uint8_t>(offsetof(WirePoint, intensity)))
      .def_property_readonly("labels", view<std::uint8_t>(offsetof(WirePoint, label)))
      .def_property_readonly("ring", view<std::uint16_t>(offsetof(WirePoint, row)))
      .def_property_readonly("time", view<float>(offsetof(WirePoint, time_s)))
      .def_property_readonly("height_above_ground_m",
                             [](const py::object& self) -> py::object {
                               const auto& frame = self.cast<const FrameData&>();
                               if (frame.heights_m.size() != frame.points.size()) return py::none();
                               return py::array(py::dtype::of<float>(),
                                                static_cast<py::ssize_t>(frame.heights_m.size()),
                                                frame.heights_m.data(), self);
                             })
      .def_property_readonly("objects",
                             [](const py::object& self) -> py::object {
                               const auto& frame = self.cast<const FrameData&>();
                               if (frame.complete_objects) {
                                 return array_of_objects(*frame.complete_objects, self);
                               }
                               if (!frame.objects) return py::none();
                               return array_of_objects(*frame.objects, self);
                             })
      .def_property_readonly("free_way",
                             [](const py::object& self) -> py::object {
                               const auto& frame = self.cast<const FrameData&>();
                               if (!frame.free_way) return py::none();
                               return array_of_sectors(*frame.free_way, self);
                             })
      .def_property_readonly("object_numbers",
                             [](const py::object& self) -> py::object {
                               const auto& frame = self.cast<const FrameData&>();
                               if (!frame.objects) return py::none();
                               const auto count =
                                   static_cast<py::ssize_t>(frame.object_of_point.size());
                               return py::array(py::dtype::of<std::uint16_t>(), count,
                                                frame.object_of_point.data(), self);
                             })
      .def("__len__", [](const FrameData& frame) { return frame.points.size(); })
      .def("__repr__", [](const FrameData& frame) {
        return "<terracut.Frame " + std::to_string(frame.info.number) + ": " +
               std::to_string(frame.points.size()) + " returns>";
      });
}

}  // namespace terracut::python
