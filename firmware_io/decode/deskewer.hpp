// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/planar_pose.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// Deskews frames: finds the motions that move every return of a frame to where it would have been
/// seen at one instant of the frame, if its object stood still. A return stays in its cell (row and
/// column of its beam) and keeps its height: the motion is in the ground plane of the vehicle
/// frame. Whoever makes a frame's points moves them (frame::PointImage).
///
/// The motions are found when the frame is handed over. By then the vehicle's motion up to the
/// frame's end is known, so the chosen instant may be that end, and each packet only adds a note of
/// the head's azimuth. Row and column of a cell give
/// the azimuth of the head when the beam fired (beams may point up to 10 degrees, 3 ms, off the
/// head); the azimuth gives the time, and the time the pose. Times and poses are computed at nodes,
/// every 8 columns of the head's azimuth, and interpolated linearly: off by a part in 10^6 of the
/// motion.
///
/// Real-time safe but for the constructor. One thread, the reader of the EgoMotion.
class Deskewer {
 public:
  struct Config {
    vehicle::EgoMotion* motion = nullptr;  ///< Must outlive this.
    frame::FrameInstant at = frame::FrameInstant::kEnd;
    frame::ImageShape shape;
    std::int64_t revolution_ticks = 0;  ///< Ticks of azimuth in 360 degrees.
    std::size_t frames = 1;             ///< The number of frames whose motions are kept.
  };

  /// `beam_ticks[row]` is the azimuth of that row's beam minus the head's when it fires; less than
  /// half a revolution. Throws std::invalid_argument on a setting outside its range.
  Deskewer(const Config& config, std::span<const std::int32_t> beam_ticks,
           memory::FixedMemory& memory);
  Deskewer(const Deskewer&) = delete;
  Deskewer& operator=(const Deskewer&) = delete;

  /// Begins a stream and drops earlier notes. If there was a stream before, also drops earlier
  /// samples of motion, since a clock may have been set in between.
  void restart() noexcept TERRACUT_NONBLOCKING;
  /// Notes that a clock was set when the head was at `rotor_ticks`. Later times cannot be compared
  /// with earlier ones, nor with samples of motion added before, so frames that began earlier get
  /// no ego motion.
  void begin_anew(std::int64_t rotor_ticks) noexcept TERRACUT_NONBLOCKING;
  /// Notes that the head was at `rotor_ticks` (unwrapped) at `instant_ns`. A note is ignored if
  /// either value is below that of the last note.
  void note(std::int64_t rotor_ticks, std::int64_t instant_ns) noexcept TERRACUT_NONBLOCKING;

  struct Deskewed {
    frame::DeskewInfo info;
    std::span<const frame::PlanarMotions> by_row;  ///< Empty unless `info` says kDone.
  };
  /// Deskews the frame at the azimuth `frame`, in revolutions. The motions stay valid until the
  /// next call with the same `place`, in [0, Config::frames).
  [[nodiscard]] Deskewed deskew(std::int64_t frame,
                                std::size_t place = 0) noexcept TERRACUT_NONBLOCKING;

 private:
  static constexpr std::int64_t kNodeColumns = 8;
  static constexpr std::int64_t kFromTheStart = std::numeric_limits<std::int64_t>::min();

  struct Note {
    double position = 0;  ///< Azimuth of the head, in nodes.
    std::int64_t instant_ns = 0;
  };

  /// Converts an unwrapped azimuth to nodes.
  [[nodiscard]] double nodes(std::int64_t rotor_ticks) const noexcept;
  /// Interpolates the instants of nodes between the last two notes, up to `last_node`.
  void fill(std::int64_t last_node) noexcept;
  /// Returns when the head was at a node, clamped to the azimuths noted.
  [[nodiscard]] std::int64_t instant_of(std::int64_t node) const noexcept;
  [[nodiscard]] std::int64_t instant_at(std::int64_t rotor_ticks) const noexcept;
  [[nodiscard]] std::int64_t reference_ns(std::int64_t frame) const noexcept;
  void spread_poses(std::int64_t first_column, std::int64_t first_node, std::size_t place) noexcept;

  Config config_;
  std::int64_t columns_;
  /// Range, over rows, of how many columns a beam lags behind the head.
  std::int64_t first_shift_ = 0, last_shift_ = 0;
  std::size_t head_columns_ = 0;  ///< Columns of the head's azimuth in which a frame's beams fire.

  std::span<std::int64_t> instants_ns_;  ///< Indexed by node; a ring buffer.
  std::int64_t first_node_ = 0, next_node_ = 0;
  /// Times of nodes before this one are of another clock.
  std::int64_t anew_node_ = kFromTheStart;
  bool noted_ = false;
  /// The last two notes. The nodes between them are filled only when needed: there may be more than
  /// the ring buffer holds, and the frame in which they begin is not handed over yet.
  Note before_, newest_;

  // The frame being deskewed.
  std::span<std::int64_t> node_ns_;
  std::span<vehicle::PlanarPose> node_poses_;
  /// By place and column of the head's azimuth; a place's first element is for column first_shift_.
  std::span<float> cosine_, sine_, x_m_, y_m_;
  /// By place and row: the row's part of the four arrays above.
  std::span<frame::PlanarMotions> by_row_;
};

}  // namespace terracut::decode
