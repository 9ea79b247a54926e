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

namespace terracut::cloud {

/// How many lasers a sensor may have.
inline constexpr int kFewestLasers = 8;
inline constexpr int kMostLasers = 256;

/// The names of the field that has the laser's number, the usual ones first, and of the
/// intensity's, as FieldTable::field_like() has them.
inline constexpr std::string_view kLaserFields[] = {
    "ring",        "channel",      "laser",         "row",          "laserid",
    "lasernumber", "ringid",       "line",          "beam",         "beamid",
    "channelid",   "channelindex", "channelnumber", "laserchannel", "laserindex",
    "ringindex",   "ringnumber",   "beamindex",     "beamnumber"};
inline constexpr std::string_view kIntensityFields[] = {"intensity", "remission", "reflectivity"};

/// One frame of any spinning LiDAR, in the sensor frame (x ahead, y left, z up, metres), its points
/// in any order. Belongs to somebody else.
struct CloudView {
  std::span<const scan::ScanPoint> points;
  /// The number of each point's laser, whatever the numbering; empty where it is not known.
  std::span<const std::uint16_t> laser = {};
  /// Of an organised cloud, whose points stand row after row, as many in each; 1: not organised.
  std::size_t rows = 1;
  /// For messages, where it is known: as Cloud::laser_note.
  std::string_view laser_note = {};

  [[nodiscard]] bool is_organised() const noexcept {
    return rows > 1 && points.size() > rows && points.size() % rows == 0;
  }
};

[[nodiscard]] inline bool has_places(std::span<const scan::ScanPoint> points) noexcept {
  return std::ranges::any_of(points, scan::is_place);
}

/// The laser of a point of a cloud that is organised. A sensor has fewer lasers than directions:
/// most drivers write a row for each laser, some a column.
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

/// A frame that was read. Buffers are kept from one to the next.
struct Cloud {
  std::vector<scan::ScanPoint> points;
  std::vector<std::uint16_t> laser;
  std::size_t rows = 1;
  /// Of a file with named fields, for messages: what tells the lasers, "field ring", or, where
  /// `laser` is empty, why none does: "its fields are x y z".
  std::string laser_note;
  bool has_viewpoint = false;  ///< The file says where among the points the sensor stood.

  [[nodiscard]] CloudView view() const noexcept { return {points, laser, rows, laser_note}; }
};

}  // namespace terracut::cloud
