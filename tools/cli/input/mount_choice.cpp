// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "mount_choice.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "calib/beams/angle.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

using mount::FoundMount;
using mount::Mount;

constexpr const char* kHowToState =
    "state how the sensor stands (--mount-height, --mount-roll, --mount-pitch; --setup with what "
    "`terracut calibrate` measured where more of the ground is seen)";

/// A figure of the mount: its member among the options (metres or degrees), and in a Mount.
struct MountFigure {
  std::optional<double> MountOptions::* stated;
  double Mount::* found;
  bool is_angle;

  /// Returns the found figure in the unit of the command line; an angle is rounded to 0.01 degrees.
  [[nodiscard]] double as_stated(const Mount& mount) const {
    const double value = mount.*found;
    return is_angle ? std::round(100 * beams::rad_to_deg(value)) / 100 : value;
  }
  [[nodiscard]] double as_found(double value) const {
    return is_angle ? beams::deg_to_rad(value) : value;
  }
};
constexpr std::array kMountFigures{MountFigure{&MountOptions::height_m, &Mount::height_m, false},
                                   MountFigure{&MountOptions::roll_deg, &Mount::roll_rad, true},
                                   MountFigure{&MountOptions::pitch_deg, &Mount::pitch_rad, true}};

bool is_certain(const FoundMount& found, const MountFigure& figure) {
  FoundMount alone{.mount = found.mount, .uncertainty = mount::kAtTheSensor};
  alone.uncertainty.*figure.found = found.uncertainty.*figure.found;
  return alone.is_certain();
}

/// Returns a mount of the stated figures, those figures of `found` that are certain by themselves,
/// and default figures.
MountChoice guessed(const MountOptions& stated, const std::optional<FoundMount>& found) {
  MountChoice choice{.options = stated, .is_guess = true};
  for (const MountFigure& figure : kMountFigures) {
    std::optional<double>& value = choice.options.*figure.stated;
    if (value) continue;
    value = figure.as_stated(found && is_certain(*found, figure) ? found->mount : Mount{});
  }
  return choice;
}

Expected<MountChoice> guessed_if_allowed(const MountOptions& stated,
                                         const std::optional<FoundMount>& found,
                                         const Error& fault) {
  if (!stated.may_guess) {
    return fail(fault.code,
                fmt::format("the mount is not found: {}; {}, or go on by --mount-guess as if it "
                            "stood level at {:.2f} m",
                            fault.message, kHowToState, Mount{}.height_m));
  }
  const MountChoice guess = guessed(stated, found);
  warn(
      fmt::format("the mount is not found: {}. It is a guess, and labels suffer where it is wrong: "
                  "height {:.3f} m, roll {:.2f} deg, pitch {:.2f} deg; {}",
                  fault.message, *guess.options.height_m, *guess.options.roll_deg,
                  *guess.options.pitch_deg, kHowToState));
  return guess;
}

}  // namespace

bool is_mount_open(const MountOptions& stated) noexcept {
  return stated.setup.empty() && !(stated.height_m && stated.roll_deg && stated.pitch_deg);
}

MountChoice filled_in(const MountOptions& stated, const FoundMount& found) {
  MountChoice choice{.options = stated, .found = found};
  for (const MountFigure& figure : kMountFigures) {
    std::optional<double>& value = choice.options.*figure.stated;
    if (value) {
      choice.found->mount.*figure.found = figure.as_found(*value);
      choice.found->uncertainty.*figure.found = 0;
    } else {
      value = figure.as_stated(found.mount);
    }
  }
  return choice;
}

Expected<MountChoice> choose_mount(const MountOptions& stated, const mount::MountFinder& finder) {
  const auto found = finder.found();
  if (!found) return guessed_if_allowed(stated, {}, found.error());
  MountChoice choice = filled_in(stated, *found);
  if (!choice.found->is_certain()) {
    return guessed_if_allowed(stated, choice.found, mount::uncertain(*choice.found));
  }
  say("mount: " + to_string(*choice.found));
  return choice;
}

Expected<MountChoice> choose_mount(const MountOptions& stated, RecordedFrames& frames) {
  if (!is_mount_open(stated)) return MountChoice{.options = stated};
  mount::MountFinder finder;
  if (const Status shown = frames.look_for_mount(mount::kFramesToFind, finder); !shown) {
    return tl::unexpected(shown.error());
  }
  return choose_mount(stated, finder);
}

MountOptions guessing(MountOptions stated) {
  stated.may_guess = true;
  return stated;
}

}  // namespace terracut::cli
