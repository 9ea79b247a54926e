// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace terracut::encode {
namespace {

constexpr double kRevolution_rad = 2 * std::numbers::pi;
/// Firings of the frame before the first: keeps all unwrapped azimuths positive.
constexpr std::int64_t kFramesBefore = 1;
constexpr std::int32_t kAzimuthAllowance_ticks =
    decode::kTicksPerCdeg;  // 0.01 deg beside half a step
constexpr std::int64_t revolution_begin_cdeg(std::int64_t frame) {
  return (frame + kFramesBefore) * beams::kRevolution_cdeg;
}

/// Firings up to here before a seam are final without knowing the next frame: the widest beam
/// offset (10 deg), plus what one packet of six firings may span.
constexpr std::int64_t kComplete_cdeg = 1400;
constexpr std::size_t kHeightBins = 5000;  // of a millimetre

/// `radians` brought into [-pi, pi).
double wrapped(double radians) {
  return radians - kRevolution_rad * std::floor(radians / kRevolution_rad + 0.5);
}

/// The loosest tolerance that is no more than half the mean firing step it leads to, plus the
/// allowance: the fewest firings that keep the promised accuracy.
std::int32_t choose_tolerance(
    std::span<const std::vector<WantedBeam>, hdl64e::kHdl64eLasers> wanted,
    const hdl64e::BeamOffsets& offsets) {
  constexpr std::int32_t kLoosest_ticks = 18000, kTightest_ticks = 5000, kChange_ticks = 250;
  std::int32_t tolerance = kLoosest_ticks;
  for (; tolerance > kTightest_ticks; tolerance -= kChange_ticks) {
    // Firings are placed by packets, with whole hundredths of a degree: a few more than needed.
    const std::size_t firings =
        FiringSchedule::firings_needed(wanted, offsets, tolerance) * 103 / 100 + 1;
    const auto half_step = static_cast<std::int32_t>(decode::kRevolution_ticks / 2 /
                                                     static_cast<std::int64_t>(firings));
    if (tolerance + FiringSchedule::kSlack_ticks <= half_step + kAzimuthAllowance_ticks) break;
  }
  return tolerance;
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

ScanEncoder::ScanEncoder(const hdl64e::Hdl64eCalibration& calibration, std::int64_t first_stamp_ns,
                         Sink sink)
    : calibration_(calibration),
      geometry_(calibration),
      laser_of_ring_(scan::lasers_by_ring(calibration)),
      offsets_(calibration),
      schedule_(offsets_, revolution_begin_cdeg(0) - kRunUp_cdeg),
      sink_(std::move(sink)),
      stamp_ns_(first_stamp_ns),
      height_errors_(kHeightBins + 1) {}

bool ScanEncoder::want(std::int32_t frame, int laser, const scan::ScanPoint& point,
                       PendingPoint& pending, WantedBeam& beam) {
  const hdl64e::Hdl64eLaser& table = calibration_.lasers[static_cast<std::size_t>(laser)];
  const double x = point.x_m, y = point.y_m, z = point.z_m;
  pending.range_m = std::sqrt(x * x + y * y + z * z);
  pending.azimuth_rad = scan::azimuth_rad(x, y);
  pending.z_m = z;
  pending.intensity = scan::intensity_of(point.remission);

  // A beam with sideways offset or two-point correction hits beside its own azimuth.
  const bool straight = table.horiz_offset_m == 0 && !table.two_point;
  double beam_rad = pending.azimuth_rad;
  for (int i = 0; i < (straight ? 1 : 4); ++i) {
    const double rotor_rad = beam_rad + table.rot_correction_rad;
    const auto raw = geometry_.raw_for_range(laser, rotor_rad, pending.range_m);
    if (!raw || *raw > beams::kMaxRawCounts - 0.5) {
      count(pending.range_m < 10.0 ? NotEncoded::kTooNear : NotEncoded::kTooFar);
      return false;
    }
    if (straight) break;
    const beams::Point hit = geometry_.point(laser, rotor_rad, *raw);
    beam_rad += wrapped(pending.azimuth_rad - scan::azimuth_rad(hit.x_m, hit.y_m));
  }
  const std::int64_t in_frame = std::llround(beam_rad / decode::kRadPerTick);
  if (in_frame < 0 || in_frame >= decode::kRevolution_ticks) {
    count(NotEncoded::kSeam);
    return false;
  }
  beam.frame = static_cast<std::int32_t>(frame + kFramesBefore);
  beam.ticks = std::int64_t{beam.frame} * decode::kRevolution_ticks + in_frame;
  return true;
}

Status ScanEncoder::add_frame(std::span<const scan::ScanPoint> points,
                              std::span<const std::int16_t> ring_of_point,
                              std::span<const std::uint32_t> labels) {
  const auto frame = static_cast<std::int32_t>(summary_.frames.size());
  summary_.frames.push_back({points.size(), 0, 0, 0.0});
  if (const Status sent = send_before(revolution_begin_cdeg(frame) - kComplete_cdeg); !sent)
    return sent;
  auto& pending = pending_[static_cast<std::size_t>(frame % 2)];
  pending.clear();
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
    PendingPoint point{};
    WantedBeam beam{};
    if (!want(frame, laser, points[i], point, beam)) continue;
    point.label = labels.empty() ? 0 : labels[i];
    point.index = static_cast<std::uint32_t>(i);
    beam.point = static_cast<std::uint32_t>(pending.size());
    pending.push_back(point);
    wanted_[static_cast<std::size_t>(laser)].push_back(beam);
  }
  schedule_frame();
  return {};
}

void ScanEncoder::schedule_frame() {
  for (auto& wanted : wanted_) {
    std::sort(wanted.begin(), wanted.end(), [](const WantedBeam& a, const WantedBeam& b) {
      return std::pair(a.ticks, a.point) < std::pair(b.ticks, b.point);
    });
  }
  const std::int32_t tolerance = choose_tolerance(wanted_, offsets_);
  for (int laser = 0; laser < hdl64e::kHdl64eLasers; ++laser) {
    auto& wanted = wanted_[static_cast<std::size_t>(laser)];
    for (WantedBeam& beam : wanted) beam.tolerance_ticks = tolerance;
    schedule_.queue(laser, wanted);
  }
}

Status ScanEncoder::send_before(std::int64_t azimuth_cdeg) {
  while (schedule_.azimuth_cdeg() < azimuth_cdeg) {
    if (const Status sent = send_packet(); !sent) return sent;
  }
  return {};
}

Status ScanEncoder::send_packet() {
  schedule_.next(packet_);
  const std::int32_t step_ticks =
      hdl64e::column_step_ticks(beams::wrap_cdeg(packet_.azimuth_cdeg.front()),
                                beams::wrap_cdeg(packet_.azimuth_cdeg.back()));
  for (std::size_t i = 0; i < packet_.beams.size(); ++i) {
    EncodedFiring firing;
    firing.column.stamp_ns = stamp_ns_;
    firing.column.unwrapped_azimuth_cdeg = packet_.azimuth_cdeg[i];
    for (int laser = 0; laser < hdl64e::kHdl64eLasers; ++laser) {
      const WantedBeam* const beam = packet_.beams[i][static_cast<std::size_t>(laser)];
      if (beam != nullptr) encode(*beam, laser, packet_.azimuth_cdeg[i], step_ticks, firing);
    }
    stamp_ns_ += kFiring_ns;
    const std::int64_t revolution =
        packet_.azimuth_cdeg[i] / beams::kRevolution_cdeg - kFramesBefore;
    if (revolution >= 0 && revolution < std::ssize(summary_.frames)) {
      ++summary_.frames[static_cast<std::size_t>(revolution)].firings;
    }
    if (const Status taken = sink_(firing); !taken) return taken;
  }
  return {};
}

void ScanEncoder::encode(const WantedBeam& beam, int laser, std::int64_t column_cdeg,
                         std::int32_t step_ticks, EncodedFiring& firing) {
  const auto slot = static_cast<std::size_t>(laser);
  const auto frame = static_cast<std::int32_t>(beam.frame - kFramesBefore);
  const PendingPoint& point = pending_[static_cast<std::size_t>(frame % 2)][beam.point];
  const double rotor_rad =
      decode::firing_azimuth_rad(column_cdeg, hdl64e::firing_advance_ticks(step_ticks, laser));
  const auto exact = geometry_.raw_for_range(laser, rotor_rad, point.range_m);
  const double raw = std::round(exact.value_or(0.0));
  if (raw < 1 || raw > beams::kMaxRawCounts) {  // possible only at the very ends of the wire's span
    count(point.range_m < 10.0 ? NotEncoded::kTooNear : NotEncoded::kTooFar);
    return;
  }
  const beams::Point hit = geometry_.point(laser, rotor_rad, raw);
  const double range_m = std::sqrt(hit.x_m * hit.x_m + hit.y_m * hit.y_m + hit.z_m * hit.z_m);
  const double azimuth_error =
      std::abs(wrapped(scan::azimuth_rad(hit.x_m, hit.y_m) - point.azimuth_rad));
  summary_.max_range_error_m =
      std::max(summary_.max_range_error_m, std::abs(range_m - point.range_m));
  EncodedFrame& of_frame = summary_.frames[static_cast<std::size_t>(frame)];
  ++of_frame.encoded;
  of_frame.max_azimuth_error_deg =
      std::max(of_frame.max_azimuth_error_deg, beams::rad_to_deg(azimuth_error));
  add_height_error(hit.z_m - point.z_m);
  ++summary_.encoded;
  firing.column.by_laser[slot] = {static_cast<std::uint16_t>(raw), point.intensity, point.label};
  firing.sources[slot] = {frame, point.index};
}

void ScanEncoder::add_height_error(double error_m) {
  height_squares_ += error_m * error_m;
  const auto bin = static_cast<std::size_t>(std::abs(error_m) * 1000.0);
  ++height_errors_[std::min(bin, kHeightBins)];
}

Expected<EncodeSummary> ScanEncoder::finish() {
  const std::int64_t end_cdeg = revolution_begin_cdeg(std::ssize(summary_.frames)) + kRunUp_cdeg;
  if (const Status sent = send_before(end_cdeg); !sent) return tl::unexpected(sent.error());

  summary_.not_encoded[static_cast<std::size_t>(NotEncoded::kCollision)] = schedule_.dropped();
  summary_.height.points = summary_.encoded;
  if (summary_.encoded > 0) {
    summary_.height.rms_m = std::sqrt(height_squares_ / static_cast<double>(summary_.encoded));
    std::uint64_t below = 0;
    std::size_t bin = 0;
    for (; bin < height_errors_.size(); ++bin) {
      below += height_errors_[bin];
      if (below * 100 >= summary_.encoded * 95) break;
    }
    summary_.height.p95_m = static_cast<double>(bin + 1) / 1000.0;
  }
  return summary_;
}

}  // namespace terracut::encode
