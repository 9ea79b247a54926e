// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::eval {

/// A dataset in SemanticKITTI's layout: walls and flat ground, the frames all a little different.
/// Ground is road beyond 8 m and terrain before; walls are building, or cars where they are near.
class MadeUpDataset {
 public:
  static constexpr int kFrames = 3;

  MadeUpDataset() {
    for (const std::string sequence : {"00", "03"}) {
      for (int i = 0; i < kFrames; ++i) add(sequence, i);
    }
  }

  [[nodiscard]] const std::filesystem::path& root() const { return folder_.path(); }
  [[nodiscard]] std::filesystem::path points(const std::string& sequence, int frame) const {
    return root() / "sequences" / sequence / "velodyne" / fmt::format("{:06}.bin", frame);
  }
  [[nodiscard]] std::filesystem::path labels(const std::string& sequence, int frame) const {
    return root() / "sequences" / sequence / "labels" / fmt::format("{:06}.label", frame);
  }
  void write(const std::filesystem::path& path, std::string_view content) const {
    (void)folder_.write(path, content);
  }

 private:
  void add(const std::string& sequence, int frame) {
    const auto points =
        synthetic::scan(synthetic::table(),
                        {.points_per_ring = 1800,
                         .first_azimuth_deg = 0.05 + 0.01 * frame + (sequence == "03" ? 0.05 : 0)});
    std::vector<std::uint32_t> labels;
    for (const auto& point : points) {
      const double range_m = std::hypot(point.x_m, point.y_m);
      const bool ground = point.z_m < -1.7;
      const std::uint32_t id = ground ? (range_m > 8 ? 40U : 72U) : (range_m < 5 ? 10U : 50U);
      labels.push_back(id | 7U << 16);  // an instance, which does not matter
    }
    (void)folder_.write_records(this->points(sequence, frame), points);
    (void)folder_.write_records(this->labels(sequence, frame), labels);
  }

  test::ScratchFolder folder_;
};

}  // namespace terracut::eval
