// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tree_mount.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "calib/beams/angle.hpp"

namespace terracut::cli {
namespace {

constexpr std::array<std::string_view, 3> kVehicleFrames{"base_footprint", "base_link",
                                                         "terracut_ground"};

}  // namespace

bool is_vehicle_frame(std::string_view frame) noexcept {
  return std::ranges::find(kVehicleFrames, frame) != kVehicleFrames.end();
}

TreeMount mount_by(const mount::RigidTransform& T_vehicle_sensor, std::string_view sensor,
                   std::string_view vehicle, std::string_view source) {
  const auto& T = T_vehicle_sensor;
  const mount::Mount mount{T[11], std::atan2(T[9], T[10]), std::asin(std::clamp(-T[8], -1.0, 1.0))};
  const bool is_possible = mount.height_m > 0.2 && mount.height_m < 6;
  if (!is_possible) {
    return {{},
            fmt::format("mount: not taken from {}, by which {} stands {:.3f} m above {}", source,
                        sensor, mount.height_m, vehicle)};
  }
  return {mount, fmt::format(
                     "mount: {} stands {:.3f} m above {}, roll {:.2f} deg, pitch {:.2f} deg, by {}",
                     sensor, mount.height_m, vehicle, beams::rad_to_deg(mount.roll_rad),
                     beams::rad_to_deg(mount.pitch_rad), source)};
}

std::optional<TreeMount> mount_in(const bag::TransformTree& tree, const std::string& sensor,
                                  const std::string& vehicle, std::string_view source) {
  if (!vehicle.empty()) {
    const auto T = tree.transform(sensor, vehicle);
    return T ? std::optional(mount_by(*T, sensor, vehicle, source)) : std::nullopt;
  }
  for (const std::string_view frame : kVehicleFrames) {
    if (const auto T = tree.transform(sensor, std::string(frame))) {
      return mount_by(*T, sensor, frame, source);
    }
  }
  return std::nullopt;
}

MountOptions filled_in(MountOptions stated, const mount::Mount& mount) {
  if (!stated.height_m) stated.height_m = mount.height_m;
  if (!stated.roll_deg) stated.roll_deg = beams::rad_to_deg(mount.roll_rad);
  if (!stated.pitch_deg) stated.pitch_deg = beams::rad_to_deg(mount.pitch_rad);
  return stated;
}

}  // namespace terracut::cli
