// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/robosense/unit_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/text/bounded_file.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::robosense {
namespace {

using sensor::SensorModel;

constexpr AngleCsv kCsv{
    .sensor = "RS-LiDAR-32 or RS-Helios", .channels = 32, .widest_offset_deg = 10};
constexpr double kWidestElevation_deg = 90, kWidestOffset_deg = 30;
/// A unit's elevations are within a few tenths of a degree of the model's.
constexpr double kFarthest_deg = 3;

/// True if the elevations are an RS-LiDAR-32's, in any order: there are two.
bool are_of_rs32(std::span<const AngleLine> angles) {
  std::vector<double> found, nominal;
  for (const AngleLine& angle : angles) found.push_back(angle.elevation_deg);
  for (const sensor::FactoryLaser& laser : sensor::kRs32Lasers) {
    nominal.push_back(laser.elevation_deg);
  }
  std::ranges::sort(found);
  std::ranges::sort(nominal);
  return std::ranges::equal(found, nominal,
                            [](double a, double b) { return std::abs(a - b) <= kFarthest_deg; });
}

}  // namespace

Expected<beams::BeamTable> table_of(SensorModel model, std::span<const AngleLine> angles,
                                    std::string origin) {
  beams::BeamTable table{model, {}, std::move(origin)};
  bool differ = false;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto [elevation_deg, offset_deg] = angles[i];
    if (std::abs(elevation_deg) > kWidestElevation_deg ||
        std::abs(offset_deg) > kWidestOffset_deg) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}: channel {} of {}: elevation {:.3f} and azimuth offset {:.3f} "
                              "degrees; expected at most {:g} and {:g}",
                              table.origin, i + 1, angles.size(), elevation_deg, offset_deg,
                              kWidestElevation_deg, kWidestOffset_deg));
    }
    differ |= elevation_deg != angles.front().elevation_deg;
    table.lasers.push_back({beams::deg_to_rad(elevation_deg), beams::deg_to_rad(offset_deg), 0});
  }
  if (differ) return table;
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: all {} elevations are the same", table.origin, angles.size()));
}

Expected<beams::BeamTable> parse_unit_csv(std::span<const char> text, const std::string& name,
                                          std::optional<SensorModel> wanted) {
  const auto lines = parse_angle_csv(text, name, kCsv);
  if (!lines) return tl::unexpected(lines.error());
  const bool is_rs32 = are_of_rs32(*lines);
  if (wanted == SensorModel::kRs32 && !is_rs32) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: its elevations are not those of a {}", name, to_string(*wanted)));
  }
  const SensorModel model = is_rs32 ? SensorModel::kRs32 : SensorModel::kHelios;
  return table_of(wanted.value_or(model), *lines, name);
}

Expected<beams::BeamTable> read_unit_csv(const std::filesystem::path& path,
                                         std::optional<SensorModel> wanted) {
  const auto text = text::read_bounded_file(path, description_of(kCsv));
  if (!text) return tl::unexpected(text.error());
  return parse_unit_csv(*text, path.string(), wanted);
}

std::string unit_csv_text(const beams::BeamTable& table) {
  std::vector<AngleLine> lines;
  for (const beams::TableBeam& laser : table.lasers) {
    lines.push_back(
        {beams::rad_to_deg(laser.elevation_rad), beams::rad_to_deg(laser.azimuth_offset_rad)});
  }
  return angle_csv_text(lines);
}

Status write_unit_csv(const std::filesystem::path& path, const beams::BeamTable& table) {
  if (Status status = validate(table); !status) return status;
  return files::write_whole_file(path, unit_csv_text(table));
}

}  // namespace terracut::robosense
