// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "frame_result.hpp"
#include "tools/lab/encode/sensor_motion.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/statistics/label_flips.hpp"
#include "tools/research/statistics/true_ground.hpp"

namespace terracut::eval {

/// Counts what needs more than a point's class: its height above the true ground, and whether its
/// label equals that of the previous frame. One thread, frames in order.
class FrameJudge {
 public:
  /// `classes` must outlive this object.
  FrameJudge(const datasets::ClassTable& classes, std::size_t methods)
      : classes_(classes), ground_(classes), flips_(classes, methods) {}

  /// Sets the frame to judge; `scan` must stay unchanged until the next. `before_this`: see
  /// LabelFlips::look_at().
  void look_at(const scan::KittiScan& scan, const std::optional<encode::RigidMotion>& before_this);

  /// Fills in `tall` and `flips` of the result. `labels` has one per point. Call this once per
  /// method and frame.
  void judge(std::size_t method, std::span<const frame::Label> labels, FrameResult& result);

 private:
  const datasets::ClassTable& classes_;
  statistics::TrueGround ground_;
  statistics::LabelFlips flips_;
  std::vector<std::size_t> tall_;  ///< Indices of tall points.
};

}  // namespace terracut::eval
