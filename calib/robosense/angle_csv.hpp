// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

/// RoboSense's angle file, `angle.csv`: a line a channel, in their order, each
/// `elevation,azimuth offset` in degrees with a decimal point; no header. Start-up only: allocates.
namespace terracut::robosense {

struct AngleLine {
  double elevation_deg = 0, azimuth_offset_deg = 0;
};

/// Whose file is read.
struct AngleCsv {
  std::string_view sensor;    ///< For errors: "RS-Ruby128".
  int channels = 0;           ///< Number of lines.
  int widest_offset_deg = 0;  ///< For errors: how far its beams point to either side.
};

/// Parses the content of an `angle.csv`; `name` stands for the file in errors.
///
/// A byte order mark, CR LF, blank lines at the end, spaces around numbers and `+` are accepted.
/// Refused: any other number of lines; text, NaN and infinity; semicolons and decimal commas; lines
/// without azimuth offset (some programs take it for zero, but beams point degrees off the head);
/// other units than degrees. Fails with kMalformed; the message names the line if one is at fault.
[[nodiscard]] Expected<std::vector<AngleLine>> parse_angle_csv(std::span<const char> text,
                                                               const std::string& name,
                                                               const AngleCsv& csv);

/// Returns the content of an `angle.csv`, in thousandths of a degree.
[[nodiscard]] std::string angle_csv_text(std::span<const AngleLine> lines);

/// Returns how the file of a sensor is described: "an RS-Ruby128 angle.csv: 128 lines ...".
[[nodiscard]] std::string description_of(const AngleCsv& csv);

}  // namespace terracut::robosense
