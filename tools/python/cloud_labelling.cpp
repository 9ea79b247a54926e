// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cloud_labelling.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "calib/beams/angle.hpp"
#include "object_arrays.hpp"
#include "pipeline/output/label_sink.hpp"
#include "raised_error.hpp"
#include "sector_arrays.hpp"

namespace terracut::python {
namespace py = pybind11;
namespace {

std::string text_of(const py::handle& object) {
  return py::str(object);
}

std::string shape_of(const py::array& array) {
  return text_of(array.attr("shape"));
}

/// Returns a contiguous array; an array with other strides is copied.
py::array contiguous(const py::array& array) {
  return py::module_::import("numpy").attr("ascontiguousarray")(array);
}

py::array array_of(const py::object& object, const char* name) {
  if (const py::array array = py::array::ensure(object)) return array;
  PyErr_Clear();
  throw py::type_error(
      fmt::format("{}: expected an array, found {}", name, text_of(py::type::of(object))));
}

std::optional<FieldType> field_type(const py::dtype& type) {
  if (const char order = type.attr("byteorder").cast<char>(); order == '>') return std::nullopt;
  const char kind = type.kind();
  const py::ssize_t bytes = type.itemsize();
  if (kind == 'f' && bytes == 4) return FieldType::kFloat32;
  if (kind == 'f' && bytes == 8) return FieldType::kFloat64;
  if (kind == 'u' || kind == 'i') {
    switch (bytes) {
      case 1:
        return kind == 'u' ? FieldType::kUint8 : FieldType::kInt8;
      case 2:
        return kind == 'u' ? FieldType::kUint16 : FieldType::kInt16;
      case 4:
        return kind == 'u' ? FieldType::kUint32 : FieldType::kInt32;
      default:
        break;
    }
  }
  return std::nullopt;
}

/// A cloud, and the array that holds its points.
struct ArrayCloud {
  py::array array;
  std::vector<std::string> names;
  std::vector<PointField> fields;
  std::vector<py::ssize_t> shape;  ///< Shape of the label array.
  std::size_t point_step = 0;

  [[nodiscard]] std::size_t points() const {
    return static_cast<std::size_t>(array.nbytes()) / point_step;
  }
  [[nodiscard]] PointBuffer buffer() const {
    const std::size_t rows = shape.size() == 2 ? static_cast<std::size_t>(shape[0]) : 1;
    return {.data = {static_cast<const std::byte*>(array.data()),
                     static_cast<std::size_t>(array.nbytes())},
            .fields = fields,
            .point_step = point_step,
            .width = points() / rows,
            .height = rows};
  }
};

constexpr const char* kExpectedShape =
    "(N, 3) or more columns, x y z first, or (rows, columns, 3) or more of an organised cloud";

ArrayCloud cloud_of_records(const py::array& array) {
  if (array.ndim() != 1 && array.ndim() != 2) {
    throw py::value_error("points: expected records in (N,) or (rows, columns), found " +
                          shape_of(array));
  }
  if (array.itemsize() == 0) {
    throw py::value_error(
        "points: expected records with fields x, y, z; found records of no bytes");
  }
  ArrayCloud cloud{contiguous(array),
                   {},
                   {},
                   {array.shape(), array.shape() + array.ndim()},
                   static_cast<std::size_t>(array.itemsize())};
  const py::dict all = array.dtype().attr("fields");
  for (const auto& [name, entry] : all) cloud.names.push_back(text_of(name));
  for (const std::string& name : cloud.names) {
    const py::tuple entry = all[name.c_str()];
    const auto type = field_type(entry[0].cast<py::dtype>());
    if (type) cloud.fields.push_back({name, entry[1].cast<std::size_t>(), *type});
  }
  return cloud;
}

ArrayCloud cloud_of(const py::object& points) {
  const py::array array = array_of(points, "points");
  if (!array.dtype().attr("fields").is_none()) return cloud_of_records(array);
  const auto type = field_type(array.dtype());
  if (!type || (*type != FieldType::kFloat32 && *type != FieldType::kFloat64)) {
    throw py::type_error("points: expected float32 or float64, found " + text_of(array.dtype()));
  }
  const py::ssize_t dimensions = array.ndim();
  if ((dimensions != 2 && dimensions != 3) || array.shape(dimensions - 1) < 3) {
    throw py::value_error(
        fmt::format("points: expected {}; found {}", kExpectedShape, shape_of(array)));
  }
  const auto bytes = static_cast<std::size_t>(array.itemsize());
  return {contiguous(array),
          {},
          {{"x", 0, *type}, {"y", bytes, *type}, {"z", 2 * bytes, *type}},
          {array.shape(), array.shape() + dimensions - 1},
          bytes * static_cast<std::size_t>(array.shape(dimensions - 1))};
}

std::vector<std::uint16_t> lasers_of(const py::object& laser, const ArrayCloud& cloud) {
  if (laser.is_none()) return {};
  const py::array array = array_of(laser, "laser");
  const char kind = array.dtype().kind();
  if (kind != 'u' && kind != 'i') {
    throw py::type_error("laser: expected integers, found " + text_of(array.dtype()));
  }
  if (static_cast<std::size_t>(array.size()) != cloud.points()) {
    throw py::value_error(fmt::format("laser: expected one number a point, {}; found {}",
                                      cloud.points(), shape_of(array)));
  }
  const auto numbers = py::array_t < std::int64_t,
             py::array::c_style | py::array::forcecast > ::ensure(array);
  std::vector<std::uint16_t> lasers;
  lasers.reserve(cloud.points());
  for (const std::int64_t number : std::span(numbers.data(), cloud.points())) {
    if (number < 0 || number > 255) {
      throw py::value_error(fmt::format("laser: expected 0 to 255, found {}", number));
    }
    lasers.push_back(static_cast<std::uint16_t>(number));
  }
  return lasers;
}

/// Returns the cloud with the laser numbers `lasers`.
Cloud cloud_with_lasers(const ArrayCloud& cloud, const std::vector<std::uint16_t>& lasers,
                        std::vector<CloudPoint>& points) {
  points.resize(cloud.points());
  const py::array xyz = py::array_t < float,
                  py::array::c_style | py::array::forcecast > ::ensure(cloud.array);
  const auto* at = static_cast<const float*>(xyz.data());
  const std::size_t columns =
      points.empty() ? 0 : static_cast<std::size_t>(xyz.size()) / points.size();
  for (CloudPoint& point : points) {
    point = {at[0], at[1], at[2], 0};
    at += columns;
  }
  return {.points = points, .laser = lasers};
}

py::dict dict_of(const Mount& mount) {
  py::dict dict;
  dict["height_m"] = mount.height_m;
  dict["roll_deg"] = beams::rad_to_deg(mount.roll_rad);
  dict["pitch_deg"] = beams::rad_to_deg(mount.pitch_rad);
  return dict;
}

Segmenter::Config config_of(std::optional<double> height_m, double roll_deg, double pitch_deg,
                            const std::string& profile, std::vector<std::string> parameters,
                            bool find_mount, bool heights, bool objects, bool free_way) {
  Segmenter::Config config;
  config.objects = objects;
  config.free_way = free_way;
  config.heights = heights;
  config.find_mount = find_mount;
  config.mount.height_m = height_m.value_or(config.mount.height_m);
  config.mount.roll_rad = beams::deg_to_rad(roll_deg);
  config.mount.pitch_rad = beams::deg_to_rad(pitch_deg);
  if (profile == "paper") {
    config.profile = Profile::kPaper;
  } else if (profile != "terracut") {
    throw py::value_error("profile: expected 'terracut' or 'paper', found '" + profile + "'");
  }
  config.parameters = std::move(parameters);
  return config;
}

/// Returns (labels, heights or None).
py::tuple classes_and_heights(const py::array_t<std::uint8_t>& classes,
                              const std::optional<py::array_t<float>>& heights) {
  if (heights) return py::make_tuple(classes, *heights);
  return py::make_tuple(classes, py::none());
}

}  // namespace

CloudLabelling::CloudLabelling(const Segmenter::Config& config)
    : gives_heights_(config.heights || config.objects || config.free_way),
      gives_objects_(config.objects),
      gives_free_way_(config.free_way),
      segmenter_(or_raise(Segmenter::make(config))) {}

py::tuple CloudLabelling::label(const py::object& points, const py::object& laser) {
  const ArrayCloud cloud = cloud_of(points);
  const std::vector<std::uint16_t> lasers = lasers_of(laser, cloud);
  if (!lasers.empty() && !cloud.names.empty()) {
    throw py::value_error("laser: records name their lasers in a field ring");
  }
  py::array_t<std::uint8_t> classes(cloud.shape);
  std::optional<py::array_t<float>> heights;
  if (gives_heights_) heights.emplace(cloud.shape);
  if (cloud.points() == 0) return classes_and_heights(classes, heights);
  std::vector<CloudPoint> room;
  Cloud numbered;
  if (!lasers.empty()) numbered = cloud_with_lasers(cloud, lasers, room);
  const PointBuffer buffer = cloud.buffer();
  std::uint8_t* out = classes.mutable_data();
  float* const heights_m = heights ? heights->mutable_data() : nullptr;
  const Status labelled = without_the_lock([&]() -> Status {
    const std::lock_guard lock(mutex_);
    const auto labels = lasers.empty() ? segmenter_.label(buffer) : segmenter_.label(numbered);
    if (!labels) return tl::unexpected(labels.error());
    for (const Label label : *labels) {
      *out++ = static_cast<std::uint8_t>(output::semantic_kitti_class(label));
    }
    if (heights_m != nullptr) {
      std::ranges::copy(segmenter_.height_above_ground_m(), heights_m);
    }
    return {};
  });
  if (!labelled) raise(labelled.error());
  return classes_and_heights(classes, heights);
}

py::object CloudLabelling::objects() {
  if (!gives_objects_) return py::none();
  const std::vector<Object> objects = without_the_lock([&] {
    const std::lock_guard lock(mutex_);
    return std::vector<Object>(segmenter_.objects().begin(), segmenter_.objects().end());
  });
  return array_of_objects(objects, py::object());
}

py::object CloudLabelling::object_numbers() {
  if (!gives_objects_) return py::none();
  const std::vector<std::uint16_t> numbers = without_the_lock([&] {
    const std::lock_guard lock(mutex_);
    const auto of_points = segmenter_.object_of_point();
    return std::vector<std::uint16_t>(of_points.begin(), of_points.end());
  });
  return py::array_t<std::uint16_t>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::object CloudLabelling::free_way() {
  if (!gives_free_way_) return py::none();
  const std::vector<FreeWaySector> sectors = without_the_lock([&] {
    const std::lock_guard lock(mutex_);
    return std::vector<FreeWaySector>(segmenter_.free_way().begin(), segmenter_.free_way().end());
  });
  return array_of_sectors(sectors, py::object());
}

py::object CloudLabelling::found_mount() {
  const auto found = without_the_lock([&] {
    const std::lock_guard lock(mutex_);
    return segmenter_.found_mount();
  });
  if (!found) return py::none();
  py::dict dict = dict_of(found->mount);
  dict["uncertainty"] = dict_of(found->uncertainty);
  dict["found_in_frames"] = found->frames;
  return dict;
}

void bind_segmenter(py::module_& module) {
  py::class_<CloudLabelling>(module, "Segmenter")
      .def(py::init([](std::optional<double> height_m, double roll_deg, double pitch_deg,
                       const std::string& profile, std::vector<std::string> parameters,
                       bool find_mount, bool heights, bool objects, bool free_way) {
             return std::make_unique<CloudLabelling>(
                 config_of(height_m, roll_deg, pitch_deg, profile, std::move(parameters),
                           find_mount, heights, objects, free_way));
           }),
           py::kw_only(), py::arg("mount_height"), py::arg("mount_roll"), py::arg("mount_pitch"),
           py::arg("profile"), py::arg("parameters"), py::arg("find_mount"), py::arg("heights"),
           py::arg("objects"), py::arg("free_way"))
      .def("label", &CloudLabelling::label, py::arg("points"), py::arg("laser"))
      .def_property_readonly("objects", &CloudLabelling::objects)
      .def_property_readonly("object_numbers", &CloudLabelling::object_numbers)
      .def_property_readonly("free_way", &CloudLabelling::free_way)
      .def_property_readonly("found_mount", &CloudLabelling::found_mount);
}

}  // namespace terracut::python
