// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_head.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "beam_spot.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"

namespace terracut::simulator {
namespace {

// Two-point corrections bend a beam by centimetres, so it meets a surface slightly beside its
// straight ray. On a surface seen at a smaller angle than this the difference would be large,
// perhaps beyond the surface's edge; so there the range along the straight ray is kept.
constexpr double kSlantingGround = 0.01;
constexpr double kSlantingObject = 0.2;

Eigen::Vector3d to_eigen(const beams::Point& point) {
  return {point.x_m, point.y_m, point.z_m};
}

}  // namespace

template <class EncoderTraits>
ScanHead<EncoderTraits>::ScanHead(const SimulationConfig<EncoderTraits>& config,
                                  const world::Terrain& terrain,
                                  const drive::FiringPlan<EncoderTraits>& plan)
    : config_(&config),
      terrain_(&terrain),
      plan_(&plan),
      geometry_(EncoderTraits::geometry(config.calibration, config.sensor)),
      offsets_(EncoderTraits::offsets(config.calibration)) {}

template <class EncoderTraits>
void ScanHead<EncoderTraits>::cast(const drive::Firing& firing,
                                   const std::array<Moment, 2>& moments,
                                   std::span<Column> columns) const {
  for (Column& column : columns) {
    column = Column{};
    column.time_s = firing.time_s;
    column.wire.stamp_ns = config_->start_ns + plan_->after_ns(firing.index);
    column.wire.unwrapped_azimuth_cdeg = firing.azimuth_cdeg;
  }
  const packets::ReturnMode returns = config_->sensor.returns;
  for (int laser = 0; laser < EncoderTraits::kLasers; ++laser) {
    const std::int32_t offset_ticks =
        EncoderTraits::offset_ticks(offsets_, firing.step_ticks, laser, returns);
    const std::int64_t frame = packet::beam_azimuth(firing.azimuth_cdeg, offset_ticks).frame;
    if (!plan_->wants(frame)) continue;
    const double azimuth_rad = packet::firing_azimuth_rad(
        firing.azimuth_cdeg, EncoderTraits::advance_ticks(firing.step_ticks, laser, returns));
    const std::uint64_t ray_key = world::mix_keys(
        config_->seed, static_cast<std::uint64_t>(firing.index * EncoderTraits::kLasers + laser));
    const beams::Ray ray = geometry_.ray(laser, azimuth_rad);
    const Beam beam{laser,
                    azimuth_rad,
                    ray_key,
                    to_eigen(ray.origin),
                    {ray.direction.x, ray.direction.y, ray.direction.z}};
    const Moment& moment = moments[static_cast<std::size_t>(frame % 2)];
    if (returns == packets::ReturnMode::kDual) {
      cast_dual(beam, moment, columns);
    } else {
      cast_single(beam, moment, columns.front());
    }
  }
}

template <class EncoderTraits>
void ScanHead<EncoderTraits>::put(const Measured& measured, int laser, Column& column) {
  const auto i = static_cast<std::size_t>(laser);
  column.wire.by_laser[i] = measured.wire;
  column.exact[i] = measured.exact;
}

template <class EncoderTraits>
std::optional<world::Hit> ScanHead<EncoderTraits>::look(const world::SightLine& line,
                                                        const Moment& moment,
                                                        std::uint64_t ray_key) const {
  const double limit_m = config_->effects.max_range_m + 1;
  std::optional<world::Hit> hit = moment.objects->cast(line, moment.after_s, ray_key, limit_m);
  if (const auto ground = terrain_->cast(line, hit ? hit->way_m : limit_m)) hit = ground;
  return hit;
}

template <class EncoderTraits>
auto ScanHead<EncoderTraits>::echo_of(const world::SightLine& line,
                                      const std::optional<world::Hit>& hit, std::uint64_t ray_key,
                                      double share) const -> std::optional<Sighting> {
  if (!hit) return std::nullopt;
  const double cos_incidence = std::min(1.0, std::abs(hit->normal.dot(line.direction)));
  world::Random random(ray_key);
  const std::optional<Echo> echo = echo_from(config_->effects, *hit, cos_incidence, random, share);
  if (!echo) return std::nullopt;
  return Sighting{*hit, *echo, cos_incidence};
}

template <class EncoderTraits>
auto ScanHead<EncoderTraits>::measure_along(const Beam& beam, const Sighting& sighting,
                                            const Eigen::Vector3d& normal) const
    -> std::optional<Measured> {
  const SensorEffects& effects = config_->effects;
  const Eigen::Vector3d place = beam.origin + sighting.hit.way_m * beam.direction;
  const std::optional<double> raw =
      geometry_.raw_on_plane(beam.laser, beam.azimuth_rad, {place.x(), place.y(), place.z()},
                             {normal.x(), normal.y(), normal.z()});
  if (!raw) return std::nullopt;
  const double counts =
      *raw + sighting.echo.range_error_m / EncoderTraits::metres_per_count(config_->calibration);
  if (counts < 1 || counts > beams::kMaxRawCounts) return std::nullopt;
  const beams::Point exact = geometry_.point(beam.laser, beam.azimuth_rad, counts);
  const double range_m = to_eigen(exact).norm();
  if (range_m < effects.min_range_m || range_m > effects.max_range_m) return std::nullopt;
  return Measured{{static_cast<std::uint16_t>(std::lround(counts)), sighting.echo.intensity,
                   sighting.hit.label()},
                  exact};
}

template <class EncoderTraits>
auto ScanHead<EncoderTraits>::measure(const Beam& beam, const Moment& moment,
                                      const Sighting& sighting) const -> std::optional<Measured> {
  const bool slanting =
      sighting.cos_incidence < (is_ground(sighting.hit.truth) ? kSlantingGround : kSlantingObject);
  if (slanting) return measure_along(beam, sighting, beam.direction);
  return measure_along(beam, sighting,
                       moment.T_world_lidar.linear().transpose() * sighting.hit.normal);
}

template <class EncoderTraits>
void ScanHead<EncoderTraits>::cast_single(const Beam& beam, const Moment& moment,
                                          Column& column) const {
  const world::SightLine line{moment.T_world_lidar * beam.origin,
                              moment.T_world_lidar.linear() * beam.direction};
  const auto sighting = echo_of(line, look(line, moment, beam.ray_key), beam.ray_key, 1);
  if (!sighting) return;
  if (const auto measured = measure(beam, moment, *sighting)) put(*measured, beam.laser, column);
}

// Measures the beam's axis as in single return, so that a dual-return drive only adds second
// echoes.
template <class EncoderTraits>
void ScanHead<EncoderTraits>::cast_dual(const Beam& beam, const Moment& moment,
                                        std::span<Column> columns) const {
  const world::SightLine axis{moment.T_world_lidar * beam.origin,
                              moment.T_world_lidar.linear() * beam.direction};
  const SideLine side = side_line(axis, EncoderTraits::kBeamHalfWidth_rad, beam.ray_key);
  const std::optional<world::Hit> axis_hit = look(axis, moment, beam.ray_key);
  std::optional<world::Hit> side_hit = look(side.line, moment, side.ray_key);
  if (axis_hit && side_hit && one_echo(axis, *axis_hit, side.line, *side_hit)) side_hit.reset();

  const auto on_axis = echo_of(axis, axis_hit, beam.ray_key, 1);
  const auto beside = echo_of(side.line, side_hit, side.ray_key, side.share);
  std::optional<Measured> strongest, last;
  if (on_axis) strongest = measure(beam, moment, *on_axis);
  if (beside) last = measure_along(beam, *beside, beam.direction);
  if (!strongest && !last) return;
  const bool are_two = strongest && last;
  if (!strongest) strongest = last;
  if (!last) last = strongest;
  if (on_axis && beside) {
    if (beside->echo.signal > on_axis->echo.signal) std::swap(strongest, last);
    // The weaker return lies before the strongest.
    if (EncoderTraits::kSecondIsLast && strongest->wire.raw > last->wire.raw) last = strongest;
  }
  put(*strongest, beam.laser, columns[EncoderTraits::kStrongestFirst ? 0 : 1]);
  if (!are_two && !EncoderTraits::kSecondIsLast) return;
  put(*last, beam.laser, columns[EncoderTraits::kStrongestFirst ? 1 : 0]);
}

#define TERRACUT_INSTANTIATE(EncoderTraits) template class ScanHead<EncoderTraits>;
TERRACUT_FOR_ENCODER_TRAITS(TERRACUT_INSTANTIATE)
#undef TERRACUT_INSTANTIATE

}  // namespace terracut::simulator
