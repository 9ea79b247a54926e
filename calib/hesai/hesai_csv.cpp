// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hesai/hesai_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "calib/beams/angle.hpp"
#include "calib/text/bounded_file.hpp"
#include "calib/text/number_text.hpp"
#include "calib/text/text_lines.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::hesai {
namespace {

constexpr std::string_view kExpected =
    "a Hesai angle table: a line of column names, then \"channel,elevation,azimuth\" in degrees";
/// A unit's elevations are within a few tenths of a degree of the model's.
constexpr double kFarthest_deg = 3;

/// Returns the fields of a line with exactly three; otherwise nothing.
std::optional<std::array<std::string_view, 3>> fields_of(std::string_view line) {
  const std::size_t first = line.find(',');
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = line.find(',', first + 1);
  if (second == std::string_view::npos || line.find(',', second + 1) != std::string_view::npos)
    return std::nullopt;
  return std::array{text::trimmed(line.substr(0, first)),
                    text::trimmed(line.substr(first + 1, second - first - 1)),
                    text::trimmed(line.substr(second + 1))};
}

/// Parses the line of channel number `channel`. The error does not name file and line.
Expected<beams::TableBeam> beam_from(std::string_view line, int channel) {
  const auto fields = fields_of(line);
  if (!fields) return fail(ErrorCode::kMalformed, text::quoted(line) + " has not three fields");
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = text::number_from((*fields)[i]);
    if (!value || !std::isfinite(*value)) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{} is not a finite number", text::quoted((*fields)[i])));
    }
    values[i] = *value;
  }
  if (values[0] != channel) {
    return fail(ErrorCode::kMalformed, fmt::format("channel {} stands where channel {} is due",
                                                   text::quoted((*fields)[0]), channel));
  }
  if (std::abs(values[1]) > 90 || std::abs(values[2]) > 30) {
    return fail(ErrorCode::kMalformed, "elevation beyond 90 or azimuth offset beyond 30 degrees");
  }
  return beams::TableBeam{beams::deg_to_rad(values[1]), beams::deg_to_rad(values[2]), 0};
}

/// Returns the greatest difference between the table's elevations and the model's nominal ones;
/// infinity if it has other lasers.
double distance_deg(const beams::BeamTable& table, const sensor::SensorRow& row) {
  if (row.lasers.size() != table.lasers.size()) return std::numeric_limits<double>::infinity();
  double farthest_deg = 0;
  for (std::size_t i = 0; i < row.lasers.size(); ++i) {
    // In thousandths, as written: a table that is read is read again.
    const double elevation_deg =
        std::round(beams::rad_to_deg(table.lasers[i].elevation_rad) * 1e3) / 1e3;
    farthest_deg = std::max(farthest_deg, std::abs(elevation_deg - row.lasers[i].elevation_deg));
  }
  return farthest_deg;
}

}  // namespace

Expected<beams::BeamTable> parse_hesai_csv(std::span<const char> text, const std::string& name) {
  text::TextLines lines(std::string_view(text.data(), text.size()));
  beams::BeamTable table{{}, {}, name};
  for (int number = 1; number <= lines.count(); ++number) {
    const std::string_view line = lines.next();
    if (number == 1 && fields_of(line) && !text::number_from((*fields_of(line))[1])) continue;
    const auto beam = beam_from(line, static_cast<int>(table.lasers.size()) + 1);
    if (!beam) {
      return fail(beam.error().code, fmt::format("{}:{}: {}; expected {}", name, number,
                                                 beam.error().message, kExpected));
    }
    table.lasers.push_back(*beam);
  }
  double nearest_deg = kFarthest_deg;
  for (const sensor::SensorRow& row : sensor::kSensorTable) {
    if (!sensor::is_hesai(row.model)) continue;
    if (const double apart_deg = distance_deg(table, row); apart_deg < nearest_deg) {
      nearest_deg = apart_deg;
      table.model = row.model;
    }
  }
  if (nearest_deg < kFarthest_deg) return table;
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: has {} channels with elevations of no Hesai known here; expected {}",
                          name, table.lasers.size(), kExpected));
}

Expected<beams::BeamTable> read_hesai_csv(const std::filesystem::path& path,
                                          std::optional<sensor::SensorModel> wanted) {
  const auto text = text::read_bounded_file(path, kExpected);
  if (!text) return tl::unexpected(text.error());
  auto table = parse_hesai_csv(*text, path.string());
  if (table && wanted && table->model != *wanted) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: is the table of a {}, not of a {}", path.string(),
                            to_string(table->model), to_string(*wanted)));
  }
  return table;
}

bool is_like_hesai_csv(std::span<const char> text) {
  text::TextLines lines(std::string_view(text.data(), text.size()));
  (void)lines.next();
  return fields_of(lines.next()).has_value();
}

std::string hesai_csv_text(const beams::BeamTable& table) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "Channel,Elevation,Azimuth\n");
  const auto mdeg = [](double rad) { return std::llround(beams::rad_to_deg(rad) * 1e3); };
  for (std::size_t i = 0; i < table.lasers.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},", i + 1);
    text::put_thousandths(text, mdeg(table.lasers[i].elevation_rad));
    text.push_back(',');
    text::put_thousandths(text, mdeg(table.lasers[i].azimuth_offset_rad));
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

Status write_hesai_csv(const std::filesystem::path& path, const beams::BeamTable& table) {
  if (Status status = validate(table); !status) return status;
  return files::write_whole_file(path, hesai_csv_text(table));
}

}  // namespace terracut::hesai
