// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/ruby128_csv.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/robosense/angle_csv.hpp"
#include "calib/text/bounded_file.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::ruby128 {
namespace {

constexpr robosense::AngleCsv kCsv{
    .sensor = "RS-Ruby128", .channels = kRuby128Lasers, .widest_offset_deg = 6};

}  // namespace

Expected<Ruby128Calibration> parse_ruby128_csv(std::span<const char> text,
                                               const std::string& name) {
  const auto lines = robosense::parse_angle_csv(text, name, kCsv);
  if (!lines) return tl::unexpected(lines.error());
  Ruby128Calibration calibration;
  calibration.origin = name;
  for (std::size_t i = 0; i < lines->size(); ++i) {
    calibration.channels[i] = {beams::deg_to_rad((*lines)[i].elevation_deg),
                               beams::deg_to_rad((*lines)[i].azimuth_offset_deg)};
  }
  if (const Status status = validate(calibration); !status) {
    return fail(status.error().code,
                fmt::format("{} (channel N is line N)", status.error().message));
  }
  return calibration;
}

Expected<Ruby128Calibration> read_ruby128_csv(const std::filesystem::path& path) {
  const auto text = text::read_bounded_file(path, robosense::description_of(kCsv));
  if (!text) return tl::unexpected(text.error());
  return parse_ruby128_csv(*text, path.string());
}

std::string ruby128_csv_text(const Ruby128Calibration& calibration) {
  std::vector<robosense::AngleLine> lines;
  for (const Ruby128Channel& channel : calibration.channels) {
    lines.push_back(
        {beams::rad_to_deg(channel.elevation_rad), beams::rad_to_deg(channel.azimuth_offset_rad)});
  }
  return robosense::angle_csv_text(lines);
}

Status write_ruby128_csv(const std::filesystem::path& path, const Ruby128Calibration& calibration) {
  if (const Status status = validate(calibration); !status) return status;
  return files::write_whole_file(path, ruby128_csv_text(calibration));
}

}  // namespace terracut::ruby128
