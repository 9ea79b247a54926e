// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_resampler.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware_io/packet/beam_azimuth.hpp"

namespace terracut::encode {
namespace {

constexpr packets::ReturnMode kReturns = packets::ReturnMode::kSingle;
/// A beam begins centimetres from the recording's origin, so where a ray points from there depends
/// a little on how far it reaches: it is looked up twice, first as if it reached this far.
constexpr double kFirstGuess_counts = 4'000;
constexpr int kLooks = 2;

}  // namespace

template <class EncoderTraits>
ScanResampler<EncoderTraits>::ScanResampler(const typename EncoderTraits::Calibration& calibration)
    : calibration_(calibration),
      geometry_(EncoderTraits::geometry(calibration, {})),
      offsets_(EncoderTraits::offsets(calibration)) {}

template <class EncoderTraits>
Status ScanResampler<EncoderTraits>::read(std::int64_t frame, const Source& source) {
  for (; frames_read_ <= frame; ++frames_read_) {
    View& view = views_[static_cast<std::size_t>(frames_read_ % 2)];
    if (Status status = source(frames_read_, view.frame); !status) return status;
    view.surface.take(view.frame.scan.points, view.frame.rings.ring_of_point,
                      view.frame.scan.labels);
  }
  return {};
}

template <class EncoderTraits>
frame::LabelledReturn ScanResampler<EncoderTraits>::measure(int laser, double rotor_rad,
                                                            const View& view) {
  ++summary_.rays;
  double counts = kFirstGuess_counts;
  std::uint32_t nearest = 0;
  for (int look = 0; look < kLooks; ++look) {
    const beams::Point at = geometry_.point(laser, rotor_rad, counts);
    const double elevation_rad = std::atan2(at.z_m, std::hypot(at.x_m, at.y_m));
    const auto sight = view.surface.look(scan::azimuth_rad(at.x_m, at.y_m), elevation_rad);
    if (!sight) {
      ++(view.surface.covers(elevation_rad) ? summary_.nothing_near : summary_.outside);
      return {};
    }
    const auto raw = geometry_.raw_for_range(laser, rotor_rad, sight->range_m);
    if (!raw || *raw > beams::kMaxRawCounts - 0.5) {
      ++summary_.out_of_span;
      return {};
    }
    counts = *raw;
    nearest = sight->point;
  }
  ++summary_.returns;
  const scan::KittiScan& scan = view.frame.scan;
  return {static_cast<std::uint16_t>(std::lround(counts)),
          scan::intensity_of(scan.points[nearest].remission),
          scan.labels.empty() ? 0 : scan.labels[nearest]};
}

template <class EncoderTraits>
void ScanResampler<EncoderTraits>::fire(const drive::Firing& firing,
                                        const drive::FiringPlan<EncoderTraits>& plan,
                                        Column& column) {
  for (int laser = 0; laser < EncoderTraits::kLasers; ++laser) {
    const std::int32_t offset_ticks =
        EncoderTraits::offset_ticks(offsets_, firing.step_ticks, laser, kReturns);
    const std::int64_t frame = packet::beam_azimuth(firing.azimuth_cdeg, offset_ticks).frame;
    if (!plan.wants(frame)) continue;
    const std::int32_t advance_ticks =
        EncoderTraits::advance_ticks(firing.step_ticks, laser, kReturns);
    column.by_laser[static_cast<std::size_t>(laser)] =
        measure(laser, packet::firing_azimuth_rad(firing.azimuth_cdeg, advance_ticks),
                views_[static_cast<std::size_t>(frame % 2)]);
  }
}

template <class EncoderTraits>
Expected<ResampleSummary> ScanResampler<EncoderTraits>::run(std::int64_t frames,
                                                            std::int64_t first_stamp_ns,
                                                            const Source& source,
                                                            const Sink& sink) {
  summary_ = {};
  frames_read_ = 0;
  const drive::FiringPlan<EncoderTraits> plan(calibration_, kReturns, kSpin_hz, frames);
  for (std::int64_t i = 0; i < plan.firings(); ++i) {
    const drive::Firing firing = plan.firing(i);
    const std::int32_t foremost_ticks = offsets_.foremost_ticks(firing.step_ticks);
    const std::int64_t newest = packet::beam_azimuth(firing.azimuth_cdeg, foremost_ticks).frame;
    const Status ready = read(std::min(newest, frames - 1), source);
    if (!ready) return tl::unexpected(ready.error());
    Column column;
    column.stamp_ns = first_stamp_ns + plan.after_ns(i);
    column.unwrapped_azimuth_cdeg = firing.azimuth_cdeg;
    fire(firing, plan, column);
    if (Status taken = sink(column); !taken) return tl::unexpected(taken.error());
  }
  return summary_;
}

template class ScanResampler<packets::Ruby128EncoderTraits>;
template class ScanResampler<packets::Vlp16EncoderTraits>;
template class ScanResampler<packets::Hdl32eEncoderTraits>;
template class ScanResampler<packets::Vlp32cEncoderTraits>;
template class ScanResampler<packets::Vls128EncoderTraits>;

}  // namespace terracut::encode
