// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Numbers of the maker's manuals (docs/reference/sensors.md says which), by laser.
#include <array>
#include <cstddef>
#include <span>

#include "calib/beams/angle.hpp"
#include "calib/velodyne/velodyne_calibration.hpp"

namespace terracut::velodyne {
namespace {

struct Entry {
  double elevation_deg, azimuth_offset_deg = 0, vert_offset_mm = 0;
};

constexpr std::array<Entry, 16> kVlp16{{{-15, 0, 11.2},
                                        {1, 0, -0.7},
                                        {-13, 0, 9.7},
                                        {3, 0, -2.2},
                                        {-11, 0, 8.1},
                                        {5, 0, -3.7},
                                        {-9, 0, 6.6},
                                        {7, 0, -5.1},
                                        {-7, 0, 5.1},
                                        {9, 0, -6.6},
                                        {-5, 0, 3.7},
                                        {11, 0, -8.1},
                                        {-3, 0, 2.2},
                                        {13, 0, -9.7},
                                        {-1, 0, 0.7},
                                        {15, 0, -11.2}}};

std::span<const Entry> entries_of(VelodyneModel model) {
  switch (model) {
    case VelodyneModel::kVlp16:
      return kVlp16;
  }
  return {};
}

}  // namespace

std::string_view to_string(VelodyneModel model) noexcept {
  switch (model) {
    case VelodyneModel::kVlp16:
      return "VLP-16";
  }
  return "unknown";
}

VelodyneCalibration factory_table(VelodyneModel model) {
  VelodyneCalibration calibration{
      model, {}, "factory table of the " + std::string(to_string(model))};
  for (const Entry& entry : entries_of(model)) {
    calibration.lasers.push_back({beams::deg_to_rad(entry.elevation_deg),
                                  beams::deg_to_rad(entry.azimuth_offset_deg),
                                  entry.vert_offset_mm * 1e-3});
  }
  return calibration;
}

}  // namespace terracut::velodyne
