// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cloud_drive.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "echo.hpp"
#include "object_index.hpp"
#include "simulated_motion.hpp"
#include "tools/lab/scenes/scene.hpp"
#include "tools/lab/world/random.hpp"

namespace terracut::simulator {
namespace {

/// Returns the first surface on `line`.
std::optional<world::Hit> look(const scenes::Scene& scene, const ObjectIndex& objects,
                               const world::SightLine& line, std::uint64_t ray_key,
                               double limit_m) {
  std::optional<world::Hit> hit = objects.cast(line, 0, ray_key, limit_m);
  if (const auto ground = scene.terrain.cast(line, hit ? hit->way_m : limit_m)) hit = ground;
  return hit;
}

}  // namespace

Status simulate_clouds(const CloudDriveConfig& config, const ShotPattern& pattern,
                       const CloudSink& sink) {
  const auto scene =
      scenes::make_scene(config.scene, {config.seed, config.duration_s, config.speed_mps});
  if (!scene) return tl::unexpected(scene.error());
  const Eigen::Isometry3d T_vehicle_lidar = mount_pose(config.mount);
  const double max_range_m = std::min(config.effects.max_range_m, pattern.max_range_m);
  const auto clouds = std::max<std::int64_t>(1, std::llround(config.duration_s * config.clouds_hz));
  const auto shots =
      static_cast<std::uint64_t>(std::llround(pattern.shots_per_s / config.clouds_hz));
  ObjectIndex objects(*scene);
  std::vector<scan::ScanPoint> points;
  std::vector<std::uint32_t> truth;
  for (std::int64_t cloud = 0; cloud < clouds; ++cloud) {
    const double time_s = static_cast<double>(cloud) / config.clouds_hz;
    const Eigen::Isometry3d T_world_lidar = ego_pose(*scene, time_s) * T_vehicle_lidar;
    objects.update(time_s, 0, T_world_lidar.translation(), 0);
    points.clear();
    truth.clear();
    for (std::uint64_t i = 0; i < shots; ++i) {
      const std::uint64_t shot = static_cast<std::uint64_t>(cloud) * shots + i;
      const std::uint64_t ray_key = world::mix_keys(config.seed, shot);
      const ShotDirection to = pattern.direction(shot);
      const Eigen::Vector3d direction{std::cos(to.elevation_rad) * std::cos(to.azimuth_rad),
                                      std::cos(to.elevation_rad) * std::sin(to.azimuth_rad),
                                      std::sin(to.elevation_rad)};
      const world::SightLine line{T_world_lidar.translation(), T_world_lidar.linear() * direction};
      const auto hit = look(*scene, objects, line, ray_key, max_range_m + 1);
      if (!hit) continue;
      world::Random random(ray_key);
      const double cos_incidence = std::min(1.0, std::abs(hit->normal.dot(line.direction)));
      const auto echo = echo_from(config.effects, *hit, cos_incidence, random);
      if (!echo) continue;
      const double range_m = hit->way_m + echo->range_error_m;
      if (range_m < config.effects.min_range_m || range_m > max_range_m) continue;
      const Eigen::Vector3f at = (range_m * direction).cast<float>();
      points.push_back({at.x(), at.y(), at.z(), static_cast<float>(echo->intensity) / 255});
      truth.push_back(hit->label());
    }
    if (Status taken = sink({points, truth}); !taken) return taken;
  }
  return {};
}

}  // namespace terracut::simulator
