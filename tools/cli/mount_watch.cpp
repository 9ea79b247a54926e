// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "mount_watch.hpp"

#include "calib/angle.hpp"
#include "console.hpp"
#include "mount_text.hpp"

namespace terracut::cli {

MountWatch::MountWatch(const calib::Mount& mount) : check_(mount) {
  figures_.height_m = mount.height_m;
  figures_.roll_deg = calib::rad_to_deg(mount.roll_rad);
  figures_.pitch_deg = calib::rad_to_deg(mount.pitch_rad);
}

void MountWatch::add_turn(const pipeline::NearGround& ground) {
  check_.add_turn(ground.in_use());
  figures_.turns = check_.turns();
  const auto seen = check_.contradiction();
  figures_.contradicted = seen ? 1 : 0;
  if (!seen) return;
  figures_.seen_height_m = seen->height_m;
  figures_.seen_roll_deg = calib::rad_to_deg(seen->roll_rad);
  figures_.seen_pitch_deg = calib::rad_to_deg(seen->pitch_rad);
  if (!said_) warn(contradiction_text(figures_));
  said_ = true;
}

void MountWatch::add_turn(const pipeline::RangeImage& image) {
  pipeline::take_near_ground(image, ground_);
  add_turn(ground_);
}

}  // namespace terracut::cli
