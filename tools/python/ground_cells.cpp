// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "ground_cells.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <cstdint>
#include <vector>

#include "pipeline/output/label_sink.hpp"
#include "pipeline/terracut/ground_grid.hpp"
#include "raised_error.hpp"

namespace terracut::python {
namespace py = pybind11;
namespace {

template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// Returns the label of a SemanticKITTI class.
Label label_of(std::uint8_t semantic_class) noexcept {
  for (const Label label : {Label::kGround, Label::kObstacle, Label::kOtherGround}) {
    if (output::semantic_kitti_class(label) == semantic_class) return label;
  }
  return Label::kNone;
}

void update(GroundGrid& grid, const Array<float>& points, const Array<std::uint8_t>& labels,
            const Array<float>& heights_m) {
  const py::ssize_t columns = points.ndim() > 1 ? points.shape(points.ndim() - 1) : 0;
  if (columns < 3) {
    throw py::value_error(
        fmt::format("points: expected (N, 3) or more columns, x y z first; found {}",
                    std::string(py::str(points.attr("shape")))));
  }
  std::vector<Point> converted(static_cast<std::size_t>(points.size() / columns));
  const float* at = points.data();
  for (Point& point : converted) {
    point = {.x_m = at[0], .y_m = at[1], .z_m = at[2]};
    at += columns;
  }
  std::vector<Label> of_points;
  of_points.reserve(static_cast<std::size_t>(labels.size()));
  for (py::ssize_t i = 0; i < labels.size(); ++i) of_points.push_back(label_of(labels.data()[i]));
  const Status updated = without_the_lock([&] {
    return grid.update(converted, of_points,
                       {heights_m.data(), static_cast<std::size_t>(heights_m.size())});
  });
  if (!updated) raise(updated.error());
}

template <class T, class Cell>
auto copy_of(std::span<const Cell> (GroundGrid::*cells)() const noexcept) {
  return [cells](const GroundGrid& grid) {
    static_assert(sizeof(T) == sizeof(Cell));
    const auto size = static_cast<py::ssize_t>(grid.size());
    return py::array_t<T>({size, size}, reinterpret_cast<const T*>((grid.*cells)().data()));
  };
}

}  // namespace

void bind_ground_grid(py::module_& module) {
  py::class_<GroundGrid>(module, "GroundGrid",
                         "The ground around the vehicle as square cells, from labelled returns.")
      .def(py::init([](double cell_m, double reach_m, double longest_gap_m) {
             return or_raise(GroundGrid::make({cell_m, reach_m, longest_gap_m}));
           }),
           py::kw_only(), py::arg("cell_m") = GroundGrid::Config{}.cell_m,
           py::arg("reach_m") = GroundGrid::Config{}.reach_m,
           py::arg("longest_gap_m") = GroundGrid::Config{}.longest_gap_m)
      .def("update", &update, py::arg("points").none(false), py::arg("labels").none(false),
           py::arg("height_above_ground_m").none(false))
      .def_property_readonly("height_m", copy_of<float>(&GroundGrid::height_m))
      .def_property_readonly("slope_deg", copy_of<float>(&GroundGrid::slope_deg))
      .def_property_readonly("known", copy_of<std::uint8_t>(&GroundGrid::known))
      .def_property_readonly_static(
          "UNKNOWN", [](const py::object&) { return static_cast<int>(GroundKnown::kUnknown); })
      .def_property_readonly_static(
          "SEEN", [](const py::object&) { return static_cast<int>(GroundKnown::kSeen); })
      .def_property_readonly_static("INTERPOLATED", [](const py::object&) {
        return static_cast<int>(GroundKnown::kInterpolated);
      });
}

}  // namespace terracut::python
