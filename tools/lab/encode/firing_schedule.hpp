// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/hdl64e/wire.hpp"

namespace terracut::encode {

/// A return that wants to be fired: where its beam must point, and how far off it may.
struct WantedBeam {
  std::int64_t ticks = 0;            ///< Unwrapped beam azimuth, 1e-5 degrees.
  std::int32_t tolerance_ticks = 0;  ///< The planned firing is at most this far off.
  std::int32_t frame = 0;            ///< The firing stays in this frame of the beam.
  std::uint32_t point = 0;           ///< The caller's number of it.
};

/// Decides at which head azimuths all lasers fire, so that every wanted beam gets a firing of its
/// own laser near its azimuth, with as few firings as that takes.
///
/// Recorded azimuths do not lie on a regular grid: the KITTI unit's encoder gives 0.09 or 0.18
/// degrees from firing to firing, and motion compensation shifts points by degrees where they are
/// near. So firings are placed where they are due: the next one goes to the middle of the beams
/// that would be missed by waiting longer. Azimuths on the wire are whole hundredths of a degree.
///
/// The firing advance depends on a packet's own azimuths (firing_azimuth.hpp), so firings are
/// planned a packet of six at a time, until the step they were planned with is the step they have.
/// Deterministic; allocates; one thread.
class FiringSchedule {
 public:
  static constexpr int kFirings = hdl64e::kColumnsPerPacketSingle;
  static constexpr std::int64_t kNominalStep_cdeg = 17;  ///< Where nothing is wanted (10 Hz).
  static constexpr std::int64_t kMinStep_cdeg = 3;       ///< Nearer beams of one laser collide.
  /// The firing may be this much farther off than planned, for rounding.
  static constexpr std::int32_t kSlack_ticks = 200;

  struct Packet {
    std::array<std::int64_t, kFirings> azimuth_cdeg{};  ///< Unwrapped.
    /// The wanted beam that each laser's firing serves; nullptr where it finds nothing. Valid until
    /// the next call of queue().
    std::array<std::array<const WantedBeam*, hdl64e::kHdl64eLasers>, kFirings> beams{};
  };

  /// The first firing comes one nominal step after `start_cdeg`.
  FiringSchedule(const hdl64e::BeamOffsets& offsets, std::int64_t start_cdeg);

  /// Adds the beams of one laser, sorted by azimuth, all behind those it already has.
  void queue(int laser, std::span<const WantedBeam> beams);

  /// Plans the next six firings. Beams that could not be served are dropped and counted.
  void next(Packet& packet);

  /// Azimuth of the last planned firing.
  [[nodiscard]] std::int64_t azimuth_cdeg() const noexcept { return last_cdeg_; }
  [[nodiscard]] std::size_t dropped() const noexcept { return dropped_; }

  /// How many firings these beams take (one frame, one sorted list for each laser) when each may be
  /// `tolerance_ticks` off.
  [[nodiscard]] static std::size_t firings_needed(
      std::span<const std::vector<WantedBeam>, hdl64e::kHdl64eLasers> by_laser,
      const hdl64e::BeamOffsets& offsets, std::int32_t tolerance_ticks);

 private:
  struct Queue {
    std::vector<WantedBeam> beams;
    std::size_t next = 0;
  };

  void place(std::int32_t step_ticks, std::array<std::int64_t, kFirings>& azimuth_cdeg) const;
  void serve(Packet& packet);

  hdl64e::BeamOffsets offsets_;
  std::array<Queue, hdl64e::kHdl64eLasers> queues_;
  std::int64_t last_cdeg_;
  std::int32_t step_ticks_;
  std::size_t dropped_ = 0;
};

}  // namespace terracut::encode
