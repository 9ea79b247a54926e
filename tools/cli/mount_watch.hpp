// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "calib/mount_check.hpp"
#include "pipeline/near_ground.hpp"
#include "rt/mount_figures.hpp"

namespace terracut::cli {

/// Says once that the near ground of a run contradicts the mount it was given, and keeps what there
/// is to show of it. One thread without a deadline: a turn that is looked at takes milliseconds.
class MountWatch {
 public:
  /// Of a sensor's turns, one in so many is looked at: twice a second at 10 Hz.
  static constexpr std::uint32_t kTurnsApart = 5;

  explicit MountWatch(const calib::Mount& mount);

  void add_turn(const pipeline::NearGround& ground);
  void add_turn(const pipeline::RangeImage& image);

  [[nodiscard]] const rt::MountFigures& figures() const noexcept { return figures_; }

 private:
  calib::MountCheck check_;
  rt::MountFigures figures_;
  pipeline::NearGround ground_;
  bool said_ = false;
};

}  // namespace terracut::cli
