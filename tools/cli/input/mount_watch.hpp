// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/mount_check.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "pipeline/status/mount_figures.hpp"
#include "tools/cli/input/mount_choice.hpp"

namespace terracut::cli {

/// Reports once if near ground contradicts the mount of a run, and keeps figures about it. For one
/// thread without a deadline: checking a frame takes milliseconds.
class MountWatch {
 public:
  /// `mount` is the mount in use; `choice` tells which of its figures were found.
  MountWatch(const mount::Mount& mount, const MountChoice& choice);

  void add_frame(const ground::NearGround& ground);
  void add_frame(const frame::RangeImage& image);

  [[nodiscard]] const status::MountFigures& figures() const noexcept { return figures_; }

 private:
  mount::MountCheck check_;
  status::MountFigures figures_;
  ground::NearGround ground_;
  bool said_ = false;
};

}  // namespace terracut::cli
