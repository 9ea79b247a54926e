// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_yaml.hpp"

#include <fmt/format.h>

#include <bitset>
#include <cmath>
#include <string_view>

#include "calib/text/number_text.hpp"
#include "calib/text/yaml_document.hpp"

namespace terracut::hdl64e {
namespace {

tl::unexpected<Error> malformed(std::string message) {
  return fail(ErrorCode::kMalformed, std::move(message));
}

/// Returns the scalar at `key` of `map`, null if absent. Some real files repeat a key; the
/// repetition is accepted if both have the same value.
Expected<YAML::Node> value_at(const YAML::Node& map, std::string_view key,
                              const std::string& where) {
  YAML::Node found(YAML::NodeType::Undefined);
  bool seen = false;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar() || entry.first.Scalar() != key) continue;
    if (!entry.second.IsScalar()) {
      return malformed(fmt::format("{}: {} is not a plain value", where, key));
    }
    if (seen && found.Scalar() != entry.second.Scalar()) {
      return malformed(fmt::format("{}: {} is there twice, as \"{:.40}\" and as \"{:.40}\"", where,
                                   key, found.Scalar(), entry.second.Scalar()));
    }
    found.reset(entry.second);
    seen = true;
  }
  if (!seen) return YAML::Node(YAML::NodeType::Null);
  return found;
}

/// Returns the finite number at `key`. If the key is absent, returns `fallback`, or an error if
/// that is null.
Expected<double> number_at(const YAML::Node& map, std::string_view key, const std::string& where,
                           const double* fallback) {
  const auto node = value_at(map, key, where);
  if (!node) return tl::unexpected(node.error());
  if (!node->IsScalar()) {
    if (fallback != nullptr) return *fallback;
    return malformed(fmt::format("{}: {} is missing", where, key));
  }
  const auto value = text::number_from(node->Scalar());
  if (!value || !std::isfinite(*value)) {
    return malformed(
        fmt::format("{}: {} is \"{:.40}\", expected a finite number", where, key, node->Scalar()));
  }
  return *value;
}

/// Reads an intensity limit: a whole number, which some converters write with a decimal point.
Status read_intensity(const YAML::Node& map, std::string_view key, const std::string& where,
                      int& target) {
  const double fallback = target;
  const auto value = number_at(map, key, where, &fallback);
  if (!value) return tl::unexpected(value.error());
  if (*value < 0 || *value > 255) {
    return malformed(fmt::format("{}: {} is {:g}, expected 0 to 255", where, key, *value));
  }
  target = static_cast<int>(std::lround(*value));
  return {};
}

/// True if the file states explicitly that there is no two-point correction.
Expected<bool> two_point_denied(const YAML::Node& map, const std::string& where) {
  const auto node = value_at(map, "two_pt_correction_available", where);
  if (!node) return tl::unexpected(node.error());
  bool available = true;
  if (node->IsScalar() && !YAML::convert<bool>::decode(*node, available)) {
    return malformed(
        fmt::format("{}: two_pt_correction_available is \"{:.40}\", expected true or "
                    "false",
                    where, node->Scalar()));
  }
  return !available;
}

Expected<Hdl64eLaser> laser_from(const YAML::Node& map, const std::string& where) {
  Hdl64eLaser laser;
  const double zero = 0;
  struct Field {
    std::string_view key;
    double* target;
    const double* fallback;
  };
  const Field fields[] = {
      {"rot_correction", &laser.rot_correction_rad, nullptr},
      {"vert_correction", &laser.vert_correction_rad, nullptr},
      {"dist_correction", &laser.dist_correction_m, nullptr},
      {"dist_correction_x", &laser.dist_correction_x_m, &zero},
      {"dist_correction_y", &laser.dist_correction_y_m, &zero},
      {"vert_offset_correction", &laser.vert_offset_m, &zero},
      {"horiz_offset_correction", &laser.horiz_offset_m, &zero},
      {"focal_distance", &laser.focal_distance_m, &zero},
      {"focal_slope", &laser.focal_slope, &zero},
  };
  for (const Field& field : fields) {
    const auto value = number_at(map, field.key, where, field.fallback);
    if (!value) return tl::unexpected(value.error());
    *field.target = *value;
  }
  if (Status s = read_intensity(map, "min_intensity", where, laser.min_intensity); !s) {
    return tl::unexpected(s.error());
  }
  if (Status s = read_intensity(map, "max_intensity", where, laser.max_intensity); !s) {
    return tl::unexpected(s.error());
  }
  const auto denied = two_point_denied(map, where);
  if (!denied) return tl::unexpected(denied.error());
  laser.two_point =
      !*denied && two_point_present(laser.dist_correction_m, laser.dist_correction_x_m,
                                    laser.dist_correction_y_m);
  return laser;
}

/// Returns the list of 64 lasers. An error if its length differs from the file's num_lasers.
Expected<YAML::Node> laser_list(const YAML::Node& root, const std::string& name) {
  const YAML::Node lasers = root["lasers"];
  if (!lasers.IsDefined() || !lasers.IsSequence()) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected a list \"lasers:\", found none; this is not a Velodyne "
                            "calibration",
                            name));
  }
  const double count = static_cast<double>(lasers.size());
  const auto announced = number_at(root, "num_lasers", name, &count);
  if (!announced) return tl::unexpected(announced.error());
  if (lasers.size() != kHdl64eLasers) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected 64 lasers, found {}; is this another model's file?", name,
                            lasers.size()));
  }
  if (*announced != count) {
    return malformed(fmt::format("{}: num_lasers is {:g}, but the list has 64", name, *announced));
  }
  return lasers;
}

Expected<Hdl64eCalibration> calibration_from(const YAML::Node& root, const std::string& name) {
  if (!root.IsMap()) {
    return fail(ErrorCode::kUnsupported,
                name + ": expected a YAML map with a list \"lasers:\", found none");
  }
  Hdl64eCalibration calibration;
  calibration.origin = name;
  const auto lasers = laser_list(root, name);
  if (!lasers) return tl::unexpected(lasers.error());
  const auto resolution_m =
      number_at(root, "distance_resolution", name, &calibration.distance_resolution_m);
  if (!resolution_m) return tl::unexpected(resolution_m.error());
  calibration.distance_resolution_m = *resolution_m;

  std::bitset<kHdl64eLasers> seen;
  for (const YAML::Node& map : *lasers) {
    const std::string place = text::where_is(map, name);
    if (!map.IsMap()) return malformed(place + ": expected a laser's map of values");
    const auto id = number_at(map, "laser_id", place, nullptr);
    if (!id) return tl::unexpected(id.error());
    if (!(*id >= 0 && *id < kHdl64eLasers && *id == std::floor(*id))) {
      return malformed(fmt::format("{}: laser_id is {:g}, expected 0 to 63", place, *id));
    }
    const auto number = static_cast<std::size_t>(*id);
    if (seen.test(number)) {
      return malformed(fmt::format("{}: laser {} is there twice", place, number));
    }
    seen.set(number);
    auto laser = laser_from(map, fmt::format("{}: laser {}", place, number));
    if (!laser) return tl::unexpected(laser.error());
    calibration.lasers[number] = *laser;
  }
  return calibration;
}

}  // namespace

Expected<Hdl64eCalibration> parse_hdl64e_yaml(std::span<const char> text, const std::string& name) {
  const auto root = text::load_yaml_document({text.data(), text.size()}, name);
  if (!root) return tl::unexpected(root.error());
  try {
    auto calibration = calibration_from(*root, name);
    if (!calibration) return calibration;
    if (const Status status = validate(*calibration); !status) {
      return tl::unexpected(status.error());
    }
    return calibration;
  } catch (const YAML::Exception& error) {
    return malformed(fmt::format("{}: line {}: {}", name, error.mark.line + 1, error.msg));
  }
}

}  // namespace terracut::hdl64e
