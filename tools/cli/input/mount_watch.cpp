// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/input/mount_watch.hpp"

#include "calib/beams/angle.hpp"
#include "pipeline/status/figures.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {

MountWatch::MountWatch(const mount::Mount& mount, const MountChoice& choice) : check_(mount) {
  figures_.height_m = mount.height_m;
  figures_.roll_deg = beams::rad_to_deg(mount.roll_rad);
  figures_.pitch_deg = beams::rad_to_deg(mount.pitch_rad);
  figures_.guessed = choice.is_guess ? 1 : 0;
  if (!choice.found) return;
  figures_.found_in_frames = choice.found->frames;
  figures_.uncertain_height_m = choice.found->uncertainty.height_m;
  figures_.uncertain_roll_deg = beams::rad_to_deg(choice.found->uncertainty.roll_rad);
  figures_.uncertain_pitch_deg = beams::rad_to_deg(choice.found->uncertainty.pitch_rad);
}

void MountWatch::add_frame(const ground::NearGround& ground) {
  check_.add_frame(ground.in_use());
  figures_.frames = check_.frames();
  const auto against = check_.contradiction();
  figures_.contradicted = against ? 1 : 0;
  const auto seen = against ? against : check_.by_drive();
  if (!seen) return;
  figures_.seen_height_m = seen->height_m;
  figures_.seen_roll_deg = beams::rad_to_deg(seen->roll_rad);
  figures_.seen_pitch_deg = beams::rad_to_deg(seen->pitch_rad);
  if (against && !said_) warn(status::contradiction_text(figures_));
  said_ = said_ || against;
}

void MountWatch::add_frame(const frame::RangeImage& image) {
  ground::take_near_ground(image, ground_);
  add_frame(ground_);
}

}  // namespace terracut::cli
