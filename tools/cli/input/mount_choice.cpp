// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "mount_choice.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "calib/beams/angle.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

/// The hundredths of a degree that a found angle is, as the command line would read them.
double stated_deg(double angle_rad) {
  return std::round(100 * beams::rad_to_deg(angle_rad)) / 100;
}

}  // namespace

bool is_mount_open(const MountOptions& stated) noexcept {
  return stated.setup.empty() && !(stated.height_m && stated.roll_deg && stated.pitch_deg);
}

MountChoice filled_in(const MountOptions& stated, const mount::FoundMount& found) {
  MountChoice choice{stated, found};
  const auto fill = [](std::optional<double>& figure, double as_found, double& uncertainty) {
    if (figure) uncertainty = 0;
    figure = figure.value_or(as_found);
  };
  mount::Mount& uncertainty = choice.found->uncertainty;
  fill(choice.options.height_m, found.mount.height_m, uncertainty.height_m);
  fill(choice.options.roll_deg, stated_deg(found.mount.roll_rad), uncertainty.roll_rad);
  fill(choice.options.pitch_deg, stated_deg(found.mount.pitch_rad), uncertainty.pitch_rad);
  return choice;
}

std::string text_of(const MountChoice& choice) {
  if (!choice.found) return {};
  const auto figure = [](const std::string& value, double uncertainty, int decimals) {
    return uncertainty > 0 ? fmt::format("{} (+-{:.{}f})", value, uncertainty, decimals)
                           : value + " (stated)";
  };
  const auto angle = [&](const char* name, double angle_deg, double uncertainty_rad) {
    return figure(fmt::format("{} {:.2f} deg", name, angle_deg), beams::rad_to_deg(uncertainty_rad),
                  1);
  };
  const MountOptions& options = choice.options;
  const mount::Mount& uncertainty = choice.found->uncertainty;
  const std::size_t frames = choice.found->frames;
  return fmt::format(
      "{}, {}, {}, found in {} {}",
      figure(fmt::format("height {:.3f} m", *options.height_m), uncertainty.height_m, 3),
      angle("roll", *options.roll_deg, uncertainty.roll_rad),
      angle("pitch", *options.pitch_deg, uncertainty.pitch_rad), frames,
      frames == 1 ? "frame" : "frames");
}

void warn_if_uncertain(const mount::FoundMount& found) {
  if (found.is_certain()) return;
  warn(
      "so little of the ground is seen that the mount is uncertain; state what is known of it, or "
      "measure it by `terracut calibrate` where more is seen");
}

MountChoice choose_mount(const MountOptions& stated, const mount::MountFinder& finder) {
  const auto found = finder.found();
  if (!found) {
    warn(
        fmt::format("the mount is not found: {}; {:.2f} m and level are taken for what of it is "
                    "not stated (--setup, --mount-height, --mount-roll, --mount-pitch)",
                    found.error().message, mount::Mount{}.height_m));
    return {stated, {}};
  }
  MountChoice choice = filled_in(stated, *found);
  say("mount: " + text_of(choice));
  warn_if_uncertain(*choice.found);
  return choice;
}

Expected<MountChoice> choose_mount(const MountOptions& stated, RecordedFrames& frames) {
  if (!is_mount_open(stated)) return MountChoice{stated, {}};
  mount::MountFinder finder;
  if (const Status shown = frames.look_for_mount(mount::kFramesToFind, finder); !shown) {
    return tl::unexpected(shown.error());
  }
  return choose_mount(stated, finder);
}

}  // namespace terracut::cli
