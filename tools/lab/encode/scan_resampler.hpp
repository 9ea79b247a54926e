// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "rt/error.hpp"
#include "scan_surface.hpp"
#include "tools/lab/drive/firing_plan.hpp"
#include "tools/lab/packets/encoder_traits.hpp"

namespace terracut::encode {

/// What became of the rays of a resampled drive; the counts add up to `rays`.
struct ResampleSummary {
  std::uint64_t rays = 0;
  std::uint64_t returns = 0;
  std::uint64_t outside = 0;       ///< Above or below all rings of the recording.
  std::uint64_t nothing_near = 0;  ///< No recorded return near by: sky, lost, or in a gap.
  std::uint64_t out_of_span = 0;   ///< Nearer or farther than the wire can say.

  bool operator==(const ResampleSummary&) const = default;
};

/// Sees recorded scans of another sensor through the rays of one that stands in its place: one scan
/// is one frame at 10 Hz, consecutive scans are consecutive frames. Single return.
///
/// What comes out is synthetic: ranges are interpolated between recorded returns
/// (scan_surface.hpp), labels and intensities are those of the nearest one, and finer detail than
/// the recording has is not there. Allocates; one thread; deterministic.
///
/// `EncoderTraits`: of a sensor whose beams are straight (Geometry::raw_for_range()), all but the
/// HDL-64E.
template <class EncoderTraits>
class ScanResampler {
 public:
  using Column = typename EncoderTraits::Column;

  static constexpr double kSpin_hz = 10;

  struct Frame {
    scan::KittiScan scan;
    scan::RingRecovery rings;
  };
  /// Reads a frame's scan; called once for each frame, in order.
  using Source = std::function<Status(std::int64_t frame, Frame& into)>;
  /// Takes the columns in firing order, whole packets in all.
  using Sink = std::function<Status(const Column&)>;

  explicit ScanResampler(const typename EncoderTraits::Calibration& calibration);

  /// Resamples `frames` scans (at least 1). Errors: those of `source` and `sink`.
  [[nodiscard]] Expected<ResampleSummary> run(std::int64_t frames, std::int64_t first_stamp_ns,
                                              const Source& source, const Sink& sink);

 private:
  /// A frame as the rays see it.
  struct View {
    Frame frame;
    ScanSurface surface;
  };

  [[nodiscard]] Status read(std::int64_t frame, const Source& source);
  void fire(const drive::Firing& firing, const drive::FiringPlan<EncoderTraits>& plan,
            Column& column);
  [[nodiscard]] frame::LabelledReturn measure(int laser, double rotor_rad, const View& view);

  typename EncoderTraits::Calibration calibration_;
  typename EncoderTraits::Geometry geometry_;
  typename EncoderTraits::Offsets offsets_;
  std::array<View, 2> views_;  ///< Of two successive frames, by parity.
  std::int64_t frames_read_ = 0;
  ResampleSummary summary_;
};

}  // namespace terracut::encode
