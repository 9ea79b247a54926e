// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "firing_assignment.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"

namespace terracut::encode {
namespace {

constexpr double kRevolution_rad = 2 * std::numbers::pi;
constexpr packets::ReturnMode kEncoded = packets::ReturnMode::kSingle;

/// Returns `radians` normalised to [-pi, pi).
double wrapped(double radians) {
  return radians - kRevolution_rad * std::floor(radians / kRevolution_rad + 0.5);
}

}  // namespace

std::string_view to_string(NotEncoded reason) noexcept {
  switch (reason) {
    case NotEncoded::kNoPlace:
      return "no_place";
    case NotEncoded::kUnknownRing:
      return "no_ring";
    case NotEncoded::kTooNear:
      return "too_near";
    case NotEncoded::kTooFar:
      return "too_far";
    case NotEncoded::kSeam:
      return "seam";
    case NotEncoded::kCollision:
      return "collision";
    case NotEncoded::kCount:
      break;
  }
  return "unknown";
}

ScanEncoder::ScanEncoder(const hdl64e::Hdl64eCalibration& calibration, const Config& config,
                         Sink sink)
    : calibration_(calibration),
      geometry_(calibration),
      laser_of_ring_(scan::lasers_by_ring(calibration)),
      offsets_(calibration),
      plan_(calibration, kEncoded, config.spin_hz, config.frames),
      first_stamp_ns_(config.first_stamp_ns),
      farthest_ticks_(std::llround(
          kFarthest_steps * config.spin_hz * packet::kRevolution_ticks *
          static_cast<double>(packets::Hdl64eEncoderTraits::firing_ns(kEncoded)) * 1e-9)),
      sink_(std::move(sink)) {}

bool ScanEncoder::want(int laser, const scan::ScanPoint& point, Wanted& wanted) {
  const hdl64e::Hdl64eLaser& table = calibration_.lasers[static_cast<std::size_t>(laser)];
  const double x = point.x_m, y = point.y_m, z = point.z_m;
  wanted.range_m = std::sqrt(x * x + y * y + z * z);
  wanted.azimuth_rad = scan::azimuth_rad(x, y);
  wanted.z_m = z;
  wanted.intensity = scan::intensity_of(point.remission);

  // A beam with a sideways offset or two-point correction hits a place beside its own azimuth.
  const bool straight = table.horiz_offset_m == 0 && !table.two_point;
  double beam_rad = wanted.azimuth_rad;
  for (int i = 0; i < (straight ? 1 : 4); ++i) {
    const double rotor_rad = beam_rad + table.rot_correction_rad;
    const auto raw = geometry_.raw_for_range(laser, rotor_rad, wanted.range_m);
    if (!raw || *raw > beams::kMaxRawCounts - 0.5) {
      count(wanted.range_m < 10.0 ? NotEncoded::kTooNear : NotEncoded::kTooFar);
      return false;
    }
    if (straight) break;
    const beams::Point hit = geometry_.point(laser, rotor_rad, *raw);
    beam_rad += wrapped(wanted.azimuth_rad - scan::azimuth_rad(hit.x_m, hit.y_m));
  }
  wanted.ticks = std::llround(beam_rad / packet::kRadPerTick);
  if (wanted.ticks < 0 || wanted.ticks >= packet::kRevolution_ticks) {
    count(NotEncoded::kSeam);
    return false;
  }
  return true;
}

Status ScanEncoder::add_frame(std::span<const scan::ScanPoint> points,
                              std::span<const std::int16_t> ring_of_point,
                              std::span<const std::uint32_t> labels) {
  const auto frame = static_cast<std::int32_t>(summary_.frames.size());
  summary_.frames.push_back({points.size(), 0, 0.0});
  for (auto& wanted : wanted_) wanted.clear();
  summary_.points += points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!scan::is_place(points[i])) {
      count(NotEncoded::kNoPlace);
      continue;
    }
    if (ring_of_point[i] == scan::kNoRing) {
      count(NotEncoded::kUnknownRing);
      continue;
    }
    const int laser = laser_of_ring_[static_cast<std::size_t>(ring_of_point[i])];
    Wanted wanted;
    if (!want(laser, points[i], wanted)) continue;
    wanted.label = labels.empty() ? 0 : labels[i];
    wanted.point = static_cast<std::uint32_t>(i);
    wanted_[static_cast<std::size_t>(laser)].push_back(wanted);
  }
  for (int laser = 0; laser < hdl64e::kHdl64eLasers; ++laser) assign(frame, laser);
  return send_before(*std::ranges::min_element(next_firing_));
}

ScanEncoder::Planned& ScanEncoder::planned(std::int64_t firing) {
  while (sent_ + std::ssize(planned_) <= firing) {
    const std::int64_t index = sent_ + std::ssize(planned_);
    Planned& next = planned_.emplace_back();
    next.when = plan_.firing(index);
    next.what.column.stamp_ns = first_stamp_ns_ + plan_.after_ns(index);
    // Adds one revolution, so that no azimuth is negative.
    next.what.column.unwrapped_azimuth_cdeg = next.when.azimuth_cdeg + beams::kRevolution_cdeg;
  }
  return planned_[static_cast<std::size_t>(firing - sent_)];
}

void ScanEncoder::assign(std::int32_t frame, int laser) {
  std::int64_t& next = next_firing_[static_cast<std::size_t>(laser)];
  std::int64_t first = next;
  std::vector<std::int64_t> fired_ticks;
  for (; next < plan_.firings(); ++next) {
    const drive::Firing& firing = planned(next).when;
    const packet::BeamAzimuth beam =
        packet::beam_azimuth(firing.azimuth_cdeg, offsets_.offset_ticks(firing.step_ticks, laser));
    if (beam.frame > frame) break;
    if (beam.frame < frame) {
      first = next + 1;  // this firing belongs to the run-up
    } else {
      fired_ticks.push_back(beam.in_revolution_ticks);
    }
  }
  auto& wanted = wanted_[static_cast<std::size_t>(laser)];
  std::ranges::sort(wanted, {}, [](const Wanted& w) { return std::pair(w.ticks, w.point); });
  std::vector<std::int64_t> wanted_ticks;
  for (const Wanted& w : wanted) wanted_ticks.push_back(w.ticks);
  const auto firing_of = assign_firings(wanted_ticks, fired_ticks, farthest_ticks_);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (firing_of[i] == kNoFiring) {
      count(NotEncoded::kCollision);
    } else {
      encode(frame, laser, wanted[i], planned(first + static_cast<std::int64_t>(firing_of[i])));
    }
  }
}

void ScanEncoder::encode(std::int32_t frame, int laser, const Wanted& wanted, Planned& planned) {
  const double rotor_rad = packet::firing_azimuth_rad(
      planned.when.azimuth_cdeg, hdl64e::firing_advance_ticks(planned.when.step_ticks, laser));
  const auto exact = geometry_.raw_for_range(laser, rotor_rad, wanted.range_m);
  const double raw = std::round(exact.value_or(0.0));
  // Possible only at the ends of the range of raw distances.
  if (raw < 1 || raw > beams::kMaxRawCounts) {
    count(wanted.range_m < 10.0 ? NotEncoded::kTooNear : NotEncoded::kTooFar);
    return;
  }
  const beams::Point hit = geometry_.point(laser, rotor_rad, raw);
  const double range_m = std::sqrt(hit.x_m * hit.x_m + hit.y_m * hit.y_m + hit.z_m * hit.z_m);
  const double shift_deg = beams::rad_to_deg(
      std::abs(wrapped(scan::azimuth_rad(hit.x_m, hit.y_m) - wanted.azimuth_rad)));
  summary_.max_range_error_m =
      std::max(summary_.max_range_error_m, std::abs(range_m - wanted.range_m));
  EncodedFrame& of_frame = summary_.frames[static_cast<std::size_t>(frame)];
  ++of_frame.encoded;
  of_frame.max_azimuth_shift_deg = std::max(of_frame.max_azimuth_shift_deg, shift_deg);
  azimuth_shifts_deg_.add(shift_deg);
  height_errors_m_.add(hit.z_m - wanted.z_m);
  ++summary_.encoded;
  const auto slot = static_cast<std::size_t>(laser);
  planned.what.column.by_laser[slot] = {static_cast<std::uint16_t>(raw), wanted.intensity,
                                        wanted.label};
  planned.what.sources[slot] = {frame, wanted.point};
}

Status ScanEncoder::send_before(std::int64_t firing) {
  for (; sent_ < firing; ++sent_) {
    const Status taken = sink_(planned(sent_).what);
    if (!taken) return taken;
    planned_.pop_front();
  }
  return {};
}

Expected<EncodeSummary> ScanEncoder::finish() {
  if (const Status sent = send_before(plan_.firings()); !sent) return tl::unexpected(sent.error());
  for (const EncodedFrame& frame : summary_.frames) {
    summary_.max_azimuth_shift_deg =
        std::max(summary_.max_azimuth_shift_deg, frame.max_azimuth_shift_deg);
  }
  summary_.median_azimuth_shift_deg = azimuth_shifts_deg_.percentile(50);
  summary_.height = {.points = summary_.encoded,
                     .rms_m = height_errors_m_.rms(),
                     .p95_m = height_errors_m_.percentile(95)};
  return summary_;
}

}  // namespace terracut::encode
