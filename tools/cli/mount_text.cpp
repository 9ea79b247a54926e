// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "mount_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace terracut::cli {

std::string contradiction_text(const rt::MountFigures& mount) {
  if (mount.contradicted == 0) return {};
  return fmt::format(
      "the near ground contradicts the mount: it shows the sensor at height {:.2f} m, roll {:.1f}, "
      "pitch {:.1f} deg, given is {:.2f} m, {:.1f}, {:.1f} deg; labels suffer. `terracut "
      "calibrate` "
      "measures it from a capture, for --setup",
      mount.seen_height_m, mount.seen_roll_deg, mount.seen_pitch_deg, mount.height_m,
      mount.roll_deg, mount.pitch_deg);
}

nlohmann::ordered_json mount_json(const rt::MountFigures& mount) {
  nlohmann::ordered_json json{{"height_m", mount.height_m},
                              {"roll_deg", mount.roll_deg},
                              {"pitch_deg", mount.pitch_deg},
                              {"turns", mount.turns},
                              {"contradicted", mount.contradicted != 0}};
  if (mount.contradicted != 0) {
    json["seen"] = {{"height_m", mount.seen_height_m},
                    {"roll_deg", mount.seen_roll_deg},
                    {"pitch_deg", mount.seen_pitch_deg}};
  }
  return json;
}

}  // namespace terracut::cli
