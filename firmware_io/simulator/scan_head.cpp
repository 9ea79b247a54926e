// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/simulator/scan_head.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

#include "firmware_io/simulator/echo.hpp"

namespace terracut::firmware_io {
namespace {

// Two-point corrections bend a beam by centimetres, so it meets a surface a little beside the place
// its straight ray does. On surfaces seen more slantingly than this that would be a leap, perhaps
// past the surface's edge: there the depth is kept instead.
constexpr double kSlantingGround = 0.01;
constexpr double kSlantingObject = 0.2;

Eigen::Vector3d to_eigen(const calib::Point& point) {
  return {point.x_m, point.y_m, point.z_m};
}

}  // namespace

ScanHead::ScanHead(const SimulationConfig& config, const Terrain& terrain, const FiringPlan& plan)
    : config_(&config),
      terrain_(&terrain),
      plan_(&plan),
      geometry_(config.calibration, config.geometry),
      offsets_(config.calibration) {}

void ScanHead::cast(const Firing& firing, const std::array<Moment, 2>& moments,
                    SimulatedColumn& column) const {
  column = SimulatedColumn{};
  column.time_s = firing.time_s;
  column.wire.stamp_ns = config_->start_ns + firing.index * FiringPlan::kTimes.column_ns;
  column.wire.unwrapped_azimuth_cdeg = firing.azimuth_cdeg;
  for (int laser = 0; laser < calib::kHdl64eLasers; ++laser) {
    const std::int64_t turn =
        beam_azimuth(firing.azimuth_cdeg, offsets_.offset_ticks(firing.step_ticks, laser)).turn;
    if (!plan_->wants(turn)) continue;
    const double azimuth_rad =
        firing_azimuth_rad(firing.azimuth_cdeg, firing_advance_ticks(firing.step_ticks, laser));
    const std::uint64_t ray_key = mix_keys(
        config_->seed, static_cast<std::uint64_t>(firing.index * calib::kHdl64eLasers + laser));
    const auto i = static_cast<std::size_t>(laser);
    measure(laser, ray_key, azimuth_rad, moments[static_cast<std::size_t>(turn % 2)],
            column.wire.by_laser[i], column.exact[i]);
  }
}

void ScanHead::measure(int laser, std::uint64_t ray_key, double azimuth_rad, const Moment& moment,
                       LabelledReturn& wire, calib::Point& exact) const {
  const calib::Ray ray = geometry_.ray(laser, azimuth_rad);
  const Eigen::Vector3d origin = to_eigen(ray.origin);
  const Eigen::Vector3d direction(ray.direction.x, ray.direction.y, ray.direction.z);
  const SightLine line{moment.T_world_lidar * origin, moment.T_world_lidar.linear() * direction};

  const SensorEffects& effects = config_->effects;
  const double limit_m = effects.max_range_m + 1;
  std::optional<Hit> hit = moment.objects->cast(line, moment.after_s, ray_key, limit_m);
  if (const auto ground = terrain_->cast(line, hit ? hit->way_m : limit_m)) hit = ground;
  if (!hit) return;

  const double cos_incidence = std::min(1.0, std::abs(hit->normal.dot(line.direction)));
  Random random(ray_key);
  const std::optional<Echo> echo = echo_from(effects, *hit, cos_incidence, random);
  if (!echo) return;

  const bool slanting = cos_incidence < (is_ground(hit->truth) ? kSlantingGround : kSlantingObject);
  const Eigen::Vector3d normal =
      slanting ? direction
               : Eigen::Vector3d(moment.T_world_lidar.linear().transpose() * hit->normal);
  const Eigen::Vector3d place = origin + hit->way_m * direction;
  const std::optional<double> raw = geometry_.raw_on_plane(
      laser, azimuth_rad, {place.x(), place.y(), place.z()}, {normal.x(), normal.y(), normal.z()});
  if (!raw) return;
  const double counts = *raw + echo->range_error_m / config_->calibration.distance_resolution_m;
  if (counts < 1 || counts > calib::kMaxRawCounts) return;
  const calib::Point measured = geometry_.point(laser, azimuth_rad, counts);
  const double range_m = to_eigen(measured).norm();
  if (range_m < effects.min_range_m || range_m > effects.max_range_m) return;

  wire.raw = static_cast<std::uint16_t>(std::lround(counts));
  wire.intensity = echo->intensity;
  wire.truth = static_cast<std::uint32_t>(hit->truth);
  exact = measured;
}

}  // namespace terracut::firmware_io
