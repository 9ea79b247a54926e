// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/robosense/angle_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "calib/text/number_text.hpp"
#include "calib/text/text_lines.hpp"

namespace terracut::robosense {
namespace {

/// The numbers of one line, in degrees.
struct Angles {
  double elevation_deg = 0;
  double azimuth_offset_deg = 0;
  bool has_offset = false;
};

Expected<double> angle_from(std::string_view field, std::string_view what) {
  const auto value = text::number_from(field);
  if (!value) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} {} is not a number", what, text::quoted(field)));
  }
  if (!std::isfinite(*value)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} {} is not finite", what, text::quoted(field)));
  }
  return *value;
}

/// Names the separator that `line` has in place of the comma; empty if there is none.
std::string_view other_separator(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return "semicolon";
  if (line.find(',') != std::string_view::npos) return {};
  if (line.find('|') != std::string_view::npos) return "vertical bar";
  return line.find('\t') != std::string_view::npos ? "tab" : "";
}

/// Names the unit of angles that are clearly not in degrees; empty if they may be degrees.
std::string_view unit_of(const std::vector<AngleLine>& lines) {
  const double lowest_deg = std::ranges::min(lines, {}, &AngleLine::elevation_deg).elevation_deg;
  if (lowest_deg <= -10'000) return "thousandths of a degree";
  return lowest_deg <= -1'000 ? "hundredths of a degree" : "";
}

/// Parses one line. The error does not name the file and the line; the caller adds both.
Expected<Angles> angles_from(std::string_view line) {
  if (line.empty()) {
    return fail(ErrorCode::kMalformed, "blank line before the last channel");
  }
  if (const std::string_view separator = other_separator(line); !separator.empty()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} has a {}; expected a comma between the two angles and a "
                            "point for decimals",
                            text::quoted(line), separator));
  }
  const auto commas = std::count(line.begin(), line.end(), ',');
  if (commas > 1) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} has {} fields; expected two, and a point for decimals",
                            text::quoted(line), commas + 1));
  }
  Angles angles;
  const std::size_t comma = line.find(',');
  const auto elevation_deg = angle_from(line.substr(0, comma), "elevation");
  if (!elevation_deg) return tl::unexpected(elevation_deg.error());
  angles.elevation_deg = *elevation_deg;
  if (comma == std::string_view::npos) return angles;
  const auto offset_deg = angle_from(line.substr(comma + 1), "azimuth offset");
  if (!offset_deg) return tl::unexpected(offset_deg.error());
  angles.azimuth_offset_deg = *offset_deg;
  angles.has_offset = true;
  return angles;
}

bool starts_like_a_header(std::string_view line) {
  return !line.empty() && !text::number_from(line.substr(0, line.find_first_of(",;|\t")));
}

/// Names the sensor whose table has this many lines.
std::string_view owner_of(int lines) {
  switch (lines) {
    case 16:
      return "; this looks like the table of an RS-LiDAR-16";
    case 32:
      return "; this looks like the table of an RS-LiDAR-32 or another sensor of 32 channels";
    case 80:
      return "; this looks like the table of an RS-Ruby Lite (80 channels)";
    case 128:
      return "; this looks like the table of an RS-Ruby128";
    default:
      return "";
  }
}

}  // namespace

std::string description_of(const AngleCsv& csv) {
  return fmt::format("an {} angle.csv: {} lines \"elevation,azimuth offset\" in degrees",
                     csv.sensor, csv.channels);
}

Expected<std::vector<AngleLine>> parse_angle_csv(std::span<const char> text,
                                                 const std::string& name, const AngleCsv& csv) {
  text::TextLines lines(std::string_view(text.data(), text.size()));
  if (lines.count() == 0) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: is empty; expected {}", name, description_of(csv)));
  }
  std::vector<AngleLine> found;
  bool have_offsets = true;
  for (int number = 1; number <= std::min(lines.count(), csv.channels); ++number) {
    const std::string_view line = lines.next();
    const auto angles = angles_from(line);
    if (!angles) {
      const bool header = number == 1 && starts_like_a_header(line);
      return fail(
          angles.error().code,
          fmt::format("{}:{}: {}{}; expected {}", name, number, angles.error().message,
                      header ? " (an angle.csv has no header line)" : "", description_of(csv)));
    }
    if (number == 1) have_offsets = angles->has_offset;
    if (angles->has_offset != have_offsets) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: this line has {} azimuth offset, unlike the lines before it",
                              name, number, angles->has_offset ? "an" : "no"));
    }
    found.push_back({angles->elevation_deg, angles->azimuth_offset_deg});
  }
  if (lines.count() != csv.channels) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: has {} line{}, expected {}, one a channel{}", name, lines.count(),
                            lines.count() == 1 ? "" : "s", csv.channels, owner_of(lines.count())));
  }
  if (!have_offsets) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: has elevations only; beams of an {} point up to {} degrees "
                            "to either side of the head, so without the second column (azimuth "
                            "offset in degrees) every point would be at a wrong place",
                            name, csv.sensor, csv.widest_offset_deg));
  }
  if (const std::string_view unit = unit_of(found); !unit.empty()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: the angles are given in {}; expected degrees", name, unit));
  }
  return found;
}

std::string angle_csv_text(std::span<const AngleLine> lines) {
  fmt::memory_buffer text;
  const auto mdeg = [](double deg) { return std::llround(deg * 1e3); };
  for (const AngleLine& line : lines) {
    text::put_thousandths(text, mdeg(line.elevation_deg));
    text.push_back(',');
    text::put_thousandths(text, mdeg(line.azimuth_offset_deg));
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

}  // namespace terracut::robosense
