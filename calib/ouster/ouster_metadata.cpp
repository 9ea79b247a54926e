// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ouster/ouster_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <initializer_list>
#include <iterator>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/text/bounded_file.hpp"
#include "calib/text/number_text.hpp"
#include "calib/text/yaml_document.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::ouster {
namespace {

constexpr std::string_view kExpected = "the metadata of an Ouster";
// What firmware had that did not say so.
constexpr double kUsualOrigin_mm = 15.806;
constexpr std::array<double, 16> kUsualTransform_mm{-1, 0, 0, 0,     0, -1, 0, 0,
                                                    0,  0, 1, 36.18, 0, 0,  0, 1};
/// Numbers in a 4x4 transform, by rows.
constexpr std::size_t kTransform = 16;

/// A value that is not what it should be.
struct Refusal {
  ErrorCode code;
  std::string what;
};

std::string quoted(const std::string& text) {
  constexpr std::size_t kMost = 40;
  std::string shown;
  for (const char c : text.substr(0, kMost)) shown += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > kMost ? "'" + shown + "...'" : "'" + shown + "'";
}

/// Returns the letters, digits and hyphens of a name, at most 40.
std::string plain(const std::string& name) {
  constexpr std::size_t kMost = 40;
  std::string kept;
  for (const char c : name.substr(0, kMost)) {
    const bool is_plain =
        (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    if (is_plain) kept += c;
  }
  return kept;
}

/// A map of the file, which may be missing.
class Map {
 public:
  explicit Map(YAML::Node node) : node_(std::move(node)) {}

  [[nodiscard]] YAML::Node find(const char* key) const {
    if (!node_.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
    return node_[key];
  }

 private:
  const YAML::Node node_;
};

/// The whole file, whose values stand in maps by topic or all in the outermost one.
class Metadata {
 public:
  explicit Metadata(const YAML::Node& root) : root_(root) {}

  /// Returns a value of one of the topics, or else of the outermost map.
  [[nodiscard]] YAML::Node find(std::initializer_list<const char*> topics, const char* key) const {
    for (const char* topic : topics) {
      const YAML::Node map = root_.find(topic);
      if (!map.IsDefined() || !map.IsMap()) continue;
      if (const YAML::Node found = Map(map).find(key); is_there(found)) return found;
    }
    return root_.find(key);
  }
  [[nodiscard]] static bool is_there(const YAML::Node& node) {
    return node.IsDefined() && !node.IsNull();
  }

 private:
  Map root_;
};

double number_of(const YAML::Node& node, const char* key) {
  if (node.IsScalar()) {
    const auto number = text::number_from(node.Scalar());
    if (number && std::isfinite(*number)) return *number;
    throw Refusal{ErrorCode::kMalformed,
                  fmt::format("{} is {}, expected a number", key, quoted(node.Scalar()))};
  }
  throw Refusal{ErrorCode::kMalformed, fmt::format("{} is no number", key)};
}

int whole_of(const YAML::Node& node, const char* key) {
  const double number = number_of(node, key);
  if (number != std::floor(number) || std::abs(number) > 1e6) {
    throw Refusal{ErrorCode::kMalformed,
                  fmt::format("{} is {:g}, expected a whole number", key, number)};
  }
  return static_cast<int>(number);
}

std::vector<double> numbers_of(const YAML::Node& node, const char* key) {
  if (!node.IsDefined() || !node.IsSequence()) {
    throw Refusal{ErrorCode::kMalformed, fmt::format("has no list {}", key)};
  }
  std::vector<double> numbers;
  for (const YAML::Node& entry : node) numbers.push_back(number_of(entry, key));
  return numbers;
}

std::vector<double> transform_of(const YAML::Node& node, const char* key) {
  std::vector<double> numbers = numbers_of(node, key);
  if (numbers.size() != kTransform) {
    throw Refusal{ErrorCode::kMalformed,
                  fmt::format("{} has {} numbers, expected 16", key, numbers.size())};
  }
  return numbers;
}

/// Reads "1024x10": columns a frame and frames a second.
void take_mode(const std::string& mode, OusterCalibration& unit) {
  const std::size_t by = mode.find('x');
  const auto columns = text::number_from(mode.substr(0, by));
  const auto rate_hz =
      by == std::string::npos ? std::nullopt : text::number_from(mode.substr(by + 1));
  if (!columns || !rate_hz || !(std::abs(*columns) < 1e6)) {
    throw Refusal{ErrorCode::kMalformed,
                  fmt::format("lidar_mode is {}, expected one like 1024x10", quoted(mode))};
  }
  unit.columns_per_frame = static_cast<int>(*columns);
  unit.rate_hz = *rate_hz;
}

Profile profile_of(const std::string& name) {
  const auto* const found = std::ranges::find(kProfiles, name, &ProfileRow::name);
  if (found != kProfiles.end()) return found->profile;
  std::string known;
  for (const ProfileRow& row : kProfiles) {
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  throw Refusal{ErrorCode::kUnsupported,
                fmt::format("udp_profile_lidar {} is not read here; expected one of {}",
                            quoted(name), known)};
}

void take_format(const Metadata& from, OusterCalibration& unit) {
  const auto of_format = [&](const char* key) {
    return from.find({"lidar_data_format", "data_format"}, key);
  };
  const YAML::Node in_format = of_format("udp_profile_lidar");
  const YAML::Node in_config = from.find({"config_params"}, "udp_profile_lidar");
  const YAML::Node& profile = Metadata::is_there(in_format) ? in_format : in_config;
  unit.format.profile = Metadata::is_there(profile) && profile.IsScalar()
                            ? profile_of(profile.Scalar())
                            : Profile::kLegacy;
  const YAML::Node mode = from.find({"config_params"}, "lidar_mode");
  const YAML::Node frame_columns = of_format("columns_per_frame");
  const YAML::Node rate = of_format("fps");
  if (Metadata::is_there(mode) && mode.IsScalar()) {
    take_mode(mode.Scalar(), unit);
  } else if (Metadata::is_there(rate)) {
    unit.rate_hz = number_of(rate, "fps");
  } else {
    throw Refusal{ErrorCode::kMalformed, "has no lidar_mode"};
  }
  if (Metadata::is_there(frame_columns)) {
    unit.columns_per_frame = whole_of(frame_columns, "columns_per_frame");
  }
  if (const YAML::Node columns = of_format("columns_per_packet"); Metadata::is_there(columns)) {
    unit.format.columns = whole_of(columns, "columns_per_packet");
  }
  unit.window = {0, unit.columns_per_frame - 1};
  if (const YAML::Node window = of_format("column_window"); Metadata::is_there(window)) {
    const std::vector<double> ends = numbers_of(window, "column_window");
    if (ends.size() != 2 || !(std::abs(ends[0]) < 1e6 && std::abs(ends[1]) < 1e6)) {
      throw Refusal{ErrorCode::kMalformed, "column_window is not two columns"};
    }
    unit.window = {static_cast<int>(ends[0]), static_cast<int>(ends[1])};
  }
  const auto rows = static_cast<int>(unit.lasers.size());
  unit.format.rows = rows;
  if (const YAML::Node pixels = of_format("pixels_per_column"); Metadata::is_there(pixels)) {
    unit.format.rows = whole_of(pixels, "pixels_per_column");
  }
}

void take_beams(const Metadata& from, OusterCalibration& unit) {
  const auto of_beams = [&](const char* key) { return from.find({"beam_intrinsics"}, key); };
  const std::vector<double> altitudes_deg =
      numbers_of(of_beams("beam_altitude_angles"), "beam_altitude_angles");
  const std::vector<double> azimuths_deg =
      numbers_of(of_beams("beam_azimuth_angles"), "beam_azimuth_angles");
  if (altitudes_deg.size() != azimuths_deg.size()) {
    throw Refusal{ErrorCode::kMalformed,
                  fmt::format("{} beam_altitude_angles and {} beam_azimuth_angles",
                              altitudes_deg.size(), azimuths_deg.size())};
  }
  double origin_mm = kUsualOrigin_mm, up_mm = 0;
  const YAML::Node origin = of_beams("lidar_origin_to_beam_origin_mm");
  const YAML::Node transform = of_beams("beam_to_lidar_transform");
  if (Metadata::is_there(origin)) {
    origin_mm = number_of(origin, "lidar_origin_to_beam_origin_mm");
  } else if (!Metadata::is_there(transform)) {
    unit.origin += fmt::format(", without lidar_origin_to_beam_origin_mm: {} taken", origin_mm);
  }
  double ahead_mm = origin_mm;
  if (Metadata::is_there(transform)) {
    const std::vector<double> T = transform_of(transform, "beam_to_lidar_transform");
    ahead_mm = T[3];
    up_mm = T[11];
    origin_mm = std::hypot(ahead_mm, up_mm);
  }
  unit.ahead_m = ahead_mm * 1e-3;
  unit.beam_origin_m = origin_mm * 1e-3;
  for (std::size_t i = 0; i < altitudes_deg.size(); ++i) {
    unit.lasers.push_back(
        {beams::deg_to_rad(altitudes_deg[i]), beams::deg_to_rad(azimuths_deg[i]), up_mm * 1e-3});
  }
}

void take_transform(const Metadata& from, OusterCalibration& unit) {
  const YAML::Node given = from.find({"lidar_intrinsics"}, "lidar_to_sensor_transform");
  std::vector<double> T(kUsualTransform_mm.begin(), kUsualTransform_mm.end());
  if (Metadata::is_there(given)) {
    T = transform_of(given, "lidar_to_sensor_transform");
  } else {
    unit.origin +=
        fmt::format(", without lidar_to_sensor_transform: {} mm up and half a turn taken",
                    kUsualTransform_mm[11]);
  }
  for (std::size_t i = 0; i < unit.T_sensor_lidar.size(); ++i) {
    unit.T_sensor_lidar[i] = i % 4 == 3 ? T[i] * 1e-3 : T[i];
  }
}

}  // namespace

Expected<OusterCalibration> parse_ouster_metadata(std::string_view text, const std::string& name) {
  const auto root = text::load_yaml_document(text, name);
  if (!root) return tl::unexpected(root.error());
  if (!root->IsMap()) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: is not {}", name, kExpected));
  }
  OusterCalibration unit;
  unit.origin = name;
  try {
    const Metadata from(*root);
    take_beams(from, unit);
    take_format(from, unit);
    take_transform(from, unit);
    const YAML::Node product = from.find({"sensor_info"}, "prod_line");
    if (Metadata::is_there(product) && product.IsScalar()) {
      unit.product = plain(product.Scalar());
    }
  } catch (const Refusal& refusal) {
    return fail(refusal.code, fmt::format("{}: {}", name, refusal.what));
  } catch (const std::exception& error) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: is not {}: {}", name, kExpected, quoted(error.what())));
  }
  if (Status plausible = validate(unit); !plausible) return tl::unexpected(plausible.error());
  return unit;
}

Expected<OusterCalibration> read_ouster_metadata(const std::filesystem::path& path,
                                                 std::optional<sensor::SensorModel> wanted) {
  const auto text = text::read_bounded_file(path, kExpected);
  if (!text) return tl::unexpected(text.error());
  auto unit = parse_ouster_metadata(*text, path.string());
  if (unit && wanted && model_of_rows(unit->format.rows) != *wanted) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: is the metadata of a {}, not of a {}", path.string(),
                            to_string(model_of_rows(unit->format.rows)), to_string(*wanted)));
  }
  return unit;
}

std::string ouster_metadata_text(const OusterCalibration& unit) {
  const auto list = [](const auto& values, auto number) {
    std::string text;
    for (const auto& value : values) {
      text += fmt::format("{}{}", text.empty() ? "" : ", ", number(value));
    }
    return "[" + text + "]";
  };
  const auto in_mdeg = [](double rad) { return std::round(beams::rad_to_deg(rad) * 1e6) * 1e-6; };
  const auto in_mm = [](double m) { return std::round(m * 1e9) * 1e-6; };
  const double up_m = unit.lasers.empty() ? 0 : unit.lasers.front().vert_offset_m;
  const std::array<double, kTransform> beam{1, 0, 0, in_mm(unit.ahead_m), 0, 1, 0, 0,
                                            0, 0, 1, in_mm(up_m),         0, 0, 0, 1};
  std::array<double, kTransform> lidar{};
  lidar.back() = 1;
  for (std::size_t i = 0; i < unit.T_sensor_lidar.size(); ++i) {
    lidar[i] = i % 4 == 3 ? in_mm(unit.T_sensor_lidar[i]) : unit.T_sensor_lidar[i];
  }
  const auto as_it_is = [](double value) { return value; };
  fmt::memory_buffer text;
  fmt::format_to(
      std::back_inserter(text),
      "{{\n"
      "  \"prod_line\": \"{}\",\n"
      "  \"lidar_mode\": \"{}x{:g}\",\n"
      "  \"beam_altitude_angles\": {},\n"
      "  \"beam_azimuth_angles\": {},\n"
      "  \"lidar_origin_to_beam_origin_mm\": {},\n"
      "  \"beam_to_lidar_transform\": {},\n"
      "  \"lidar_to_sensor_transform\": {},\n"
      "  \"data_format\": {{\n"
      "    \"columns_per_frame\": {},\n"
      "    \"columns_per_packet\": {},\n"
      "    \"column_window\": [{}, {}],\n"
      "    \"pixels_per_column\": {},\n"
      "    \"udp_profile_lidar\": \"{}\"\n"
      "  }}\n"
      "}}\n",
      unit.product, unit.columns_per_frame, unit.rate_hz,
      list(unit.lasers, [&](const auto& beam_of) { return in_mdeg(beam_of.elevation_rad); }),
      list(unit.lasers, [&](const auto& beam_of) { return in_mdeg(beam_of.azimuth_offset_rad); }),
      in_mm(unit.beam_origin_m), list(beam, as_it_is), list(lidar, as_it_is),
      unit.columns_per_frame, unit.format.columns, unit.window[0], unit.window[1], unit.format.rows,
      row_of(unit.format.profile).name);
  return fmt::to_string(text);
}

Status write_ouster_metadata(const std::filesystem::path& path, const OusterCalibration& unit) {
  if (Status plausible = validate(unit); !plausible) return plausible;
  return files::write_whole_file(path, ouster_metadata_text(unit));
}

bool is_metadata_name(const std::filesystem::path& path) {
  return path.extension() == ".json";
}

}  // namespace terracut::ouster
