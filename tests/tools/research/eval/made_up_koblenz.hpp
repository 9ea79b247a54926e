// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::eval {

/// The Koblenz data as they are read (tools/research/datasets/koblenz_classes.yaml), made up: walls
/// and flat ground, in order of firing, lasers numbered as on the wire. Ground is street beyond 8 m
/// and rough before; walls are obstacles, or unknown where they are far.
class MadeUpKoblenz {
 public:
  static constexpr int kFrames = 2;
  static constexpr int kPointsPerRing = 1800;
  enum class Data { kAscii, kBinary };

  MadeUpKoblenz() {
    for (int i = 0; i < kFrames; ++i) {
      write(file("KoblenzForestMap", i), cloud(i, Data::kBinary));
      write(file("KoblenzFarmMap", i), cloud(10 + i, Data::kAscii));
    }
  }

  /// Beside what a test writes into its own folder: a dataset is read, and nothing is put into it.
  [[nodiscard]] std::filesystem::path root() const { return folder_.path() / "koblenz"; }
  [[nodiscard]] std::filesystem::path file(const std::string& sequence, int frame) const {
    return root() / sequence / fmt::format("{:04}.pcd", frame);
  }
  void write(const std::filesystem::path& path, std::string_view content) const {
    (void)folder_.write(path, content);
  }

  /// `origin_m`: how far ahead of the sensor the frame's origin lies.
  [[nodiscard]] static std::string cloud(int variant, Data data, float origin_m = 0) {
    const auto points = synthetic::scan(
        synthetic::table(),
        {.points_per_ring = kPointsPerRing, .first_azimuth_deg = 0.05 + 0.01 * variant});
    std::string content =
        fmt::format(kHeader, points.size(), data == Data::kAscii ? "ascii" : "binary");
    for (int i = 0; i < kPointsPerRing; ++i) {
      for (int ring = 0; ring < scan::kScanRings; ++ring) {
        const auto& p = points[static_cast<std::size_t>(ring * kPointsPerRing + i)];
        const auto laser = static_cast<std::uint8_t>(scan::usual_laser_of_ring(ring));
        const std::int32_t label = label_of(p);
        const float x_m = p.x_m - origin_m;
        if (data == Data::kAscii) {
          content += fmt::format("{} {} {} {} {}\n", x_m, p.y_m, p.z_m, laser, label);
        } else {
          append(content, x_m);
          append(content, p.y_m);
          append(content, p.z_m);
          append(content, laser);
          append(content, label);
        }
      }
    }
    return content;
  }

 private:
  static constexpr const char* kHeader =
      "# .PCD v0.7 - Point Cloud Data file format\n"
      "VERSION 0.7\n"
      "FIELDS x y z laser label\n"
      "SIZE 4 4 4 1 4\n"
      "TYPE F F F U I\n"
      "COUNT 1 1 1 1 1\n"
      "WIDTH {0}\n"
      "HEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\n"
      "POINTS {0}\n"
      "DATA {1}\n";

  static std::int32_t label_of(const scan::ScanPoint& point) {
    const double range_m = std::hypot(point.x_m, point.y_m);
    if (point.z_m < -1.7) return range_m > 8 ? 1 : 2;
    return range_m < 40 ? 3 : 0;
  }
  template <class T>
  static void append(std::string& content, T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    content.append(bytes, sizeof(T));
  }

  test::ScratchFolder folder_;
};

}  // namespace terracut::eval
