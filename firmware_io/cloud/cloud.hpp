// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// The fewest and the most lasers of a supported sensor.
inline constexpr int kFewestLasers = 8;
inline constexpr int kMostLasers = 256;

/// The field names of the laser number (the usual ones first) and of the intensity, as
/// FieldTable::field_like() compares them.
inline constexpr std::string_view kLaserFields[] = {
    "ring",        "channel",      "laser",         "row",          "laserid",
    "lasernumber", "ringid",       "line",          "beam",         "beamid",
    "channelid",   "channelindex", "channelnumber", "laserchannel", "laserindex",
    "ringindex",   "ringnumber",   "beamindex",     "beamnumber"};
inline constexpr std::string_view kIntensityFields[] = {"intensity", "remission", "reflectivity"};

/// A view of one frame of any LiDAR, in the sensor frame (x ahead, y left, z up, metres);
/// its points may be in any order. Does not own its data.
struct CloudView {
  std::span<const scan::ScanPoint> points;
  /// The laser number of each point, in any numbering; empty if unknown.
  std::span<const std::uint16_t> laser = {};
  /// The number of rows of an organised cloud, all of equal length; 1 if not organised.
  std::size_t rows = 1;
  /// A note for messages, as in Cloud::laser_note; may be empty.
  std::string_view laser_note = {};

  [[nodiscard]] bool is_organised() const noexcept {
    return rows > 1 && points.size() > rows && points.size() % rows == 0;
  }
};

[[nodiscard]] inline bool has_places(std::span<const scan::ScanPoint> points) noexcept {
  return std::ranges::any_of(points, scan::is_place);
}

/// Checks that coordinates are metres from the sensor. Fails with kMalformed if most points (of
/// those finite and not null) are farther away than a sensor sees. The message says how far, and
/// the likely cause: millimetres, centimetres, map coordinates, another file layout.
[[nodiscard]] Status check_reach(std::span<const scan::ScanPoint> points);

/// Returns the laser of a point of an organised cloud. Most drivers write one row per laser, some
/// one column; a sensor has fewer lasers than azimuths, so the shorter side counts the lasers.
class OrganisedLasers {
 public:
  explicit OrganisedLasers(const CloudView& cloud) noexcept
      : columns_(cloud.points.size() / cloud.rows), by_row_(cloud.rows <= columns_) {
    lasers_ = std::min(cloud.rows, columns_);
  }
  [[nodiscard]] std::size_t lasers() const noexcept { return lasers_; }
  [[nodiscard]] std::size_t of(std::size_t point) const noexcept {
    return by_row_ ? point / columns_ : point % columns_;
  }

 private:
  std::size_t columns_, lasers_ = 0;
  bool by_row_;
};

/// A frame read from a file. Its buffers are reused for the next frame.
struct Cloud {
  std::vector<scan::ScanPoint> points;
  std::vector<std::uint16_t> laser;
  std::size_t rows = 1;
  /// A note for messages about files with named fields: which field gives the laser numbers ("field
  /// ring"), or why there are none ("its fields are x y z").
  std::string laser_note;
  bool has_viewpoint = false;  ///< True if the file states the sensor's position among the points.

  [[nodiscard]] CloudView view() const noexcept { return {points, laser, rows, laser_note}; }
};

}  // namespace terracut::cloud
