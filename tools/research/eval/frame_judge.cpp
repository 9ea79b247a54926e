// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_judge.hpp"

#include "firmware_io/scan/label_file.hpp"

namespace terracut::eval {

void FrameJudge::look_at(const scan::KittiScan& scan,
                         const std::optional<encode::RigidMotion>& before_this) {
  constexpr double kTall_m = 0.30;
  ground_.look_at(scan);
  flips_.look_at(scan, before_this);
  tall_.clear();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const scan::ScanPoint& point = scan.points[i];
    if (classes_.role(scan::semantic_class(scan.labels[i]), datasets::GroundDefinition::kAll) !=
            datasets::Role::kKeyObstacle ||
        !scan::is_place(point)) {
      continue;
    }
    const auto ground_m = ground_.height_m(double{point.x_m}, double{point.y_m});
    if (ground_m && double{point.z_m} > *ground_m + kTall_m) tall_.push_back(i);
  }
}

void FrameJudge::judge(std::size_t method, std::span<const frame::Label> labels,
                       FrameResult& result) {
  result.tall = {.returns = tall_.size(), .as_ground = 0};
  for (const std::size_t point : tall_) {
    result.tall.as_ground += frame::is_ground(labels[point]) ? 1 : 0;
  }
  result.flips = flips_.count(method, labels);
}

}  // namespace terracut::eval
