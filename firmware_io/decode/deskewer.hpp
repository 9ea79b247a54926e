// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/planar_pose.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// Deskews a frame, that is, removes the vehicle's motion: every return moves to where it would
/// have been seen at one instant of the frame, if what it is of stood still. Its cell (row, column)
/// stays the ray's own, its height stays, too: the motion is one in the ground plane of the vehicle
/// frame.
///
/// In one pass when the frame is handed over, not while returns are placed. Then the motion until
/// the frame's end is known, which on the way would have been guessed from the last sample; the
/// reference may be the frame's end; and packets cost no more than the note of when the head was
/// where. The pass is a multiplication, row by row: the beam of a cell left the head at an azimuth
/// that its row and column give (a table unit's beams point up to 10 degrees, 3 ms, off the head),
/// the azimuth gives the instant, that the pose. Instants and poses are kept every 8 columns of
/// the head's azimuth, and evenly divided between: off by a part in 10^6 of the motion.
///
/// Real-time safe but for the constructor. One thread, the reader of the EgoMotion.
class Deskewer {
 public:
  struct Config {
    vehicle::EgoMotion* motion = nullptr;  ///< Must outlive this.
    frame::FrameInstant at = frame::FrameInstant::kEnd;
    frame::ImageShape shape;
    std::int64_t revolution_ticks = 0;  ///< Ticks of azimuth in 360 degrees.
  };

  /// `beam_ticks[row]`: azimuth of that row's beam minus the head's when it fires; less than half a
  /// frame. Throws std::invalid_argument on a setting outside its range.
  Deskewer(const Config& config, std::span<const std::int32_t> beam_ticks,
           memory::FixedMemory& memory);
  Deskewer(const Deskewer&) = delete;
  Deskewer& operator=(const Deskewer&) = delete;

  /// A stream begins: what was noted does not belong with what comes. Where there was a stream
  /// before, neither do samples of motion added by now: nobody saw whether a clock was set since.
  void restart() noexcept TERRACUT_NONBLOCKING;
  /// A clock was set, and the head has come to `rotor_ticks`: instants noted from now on are not to
  /// be compared with those before, nor with samples of motion added before. The frames that were
  /// begun by then have no ego motion.
  void begin_anew(std::int64_t rotor_ticks) noexcept TERRACUT_NONBLOCKING;
  /// The head stood at `rotor_ticks` (unwrapped) at `instant_ns`. Both do not fall; one that does
  /// is not used.
  void note(std::int64_t rotor_ticks, std::int64_t instant_ns) noexcept TERRACUT_NONBLOCKING;

  /// Moves the returns of a frame, the number of which is that of its azimuth, 360 degrees each.
  [[nodiscard]] frame::DeskewInfo apply(std::int64_t frame,
                                        frame::RangeImage& image) noexcept TERRACUT_NONBLOCKING;

 private:
  static constexpr std::int64_t kNodeColumns = 8;
  static constexpr std::int64_t kFromTheStart = std::numeric_limits<std::int64_t>::min();

  struct Note {
    double position = 0;  ///< In nodes.
    std::int64_t instant_ns = 0;
  };

  /// Azimuth in nodes; both unwrapped.
  [[nodiscard]] double nodes(std::int64_t rotor_ticks) const noexcept;
  /// Gives the nodes between the last two notes their instants, up to `last_node`.
  void fill(std::int64_t last_node) noexcept;
  /// When the head was at a node; at the ends of what was seen, that end.
  [[nodiscard]] std::int64_t instant_of(std::int64_t node) const noexcept;
  [[nodiscard]] std::int64_t instant_at(std::int64_t rotor_ticks) const noexcept;
  [[nodiscard]] std::int64_t reference_ns(std::int64_t frame) const noexcept;
  /// Where the sensor stands at the reference of a deskewed frame.
  [[nodiscard]] frame::Place go_to(std::int64_t reference_ns) noexcept;
  void spread_poses(std::int64_t first_column, std::int64_t first_node) noexcept;

  Config config_;
  std::int64_t columns_;
  std::int64_t first_shift_ = 0, last_shift_ = 0;  ///< Of all rows: beam's to head's column.

  std::span<std::int64_t> instants_ns_;  ///< By node, a ring.
  std::int64_t first_node_ = 0, next_node_ = 0;
  std::int64_t anew_node_ = kFromTheStart;  ///< Of nodes before it, instants are of another time.
  bool noted_ = false;
  /// The last two. The way between them is left until its nodes are asked for: it may be several
  /// frames long, more than the ring holds, and the frame that it begins in is still to be handed
  /// over.
  Note before_, newest_;

  // Of the last frame that was deskewed.
  frame::Place place_;
  std::int64_t place_ns_ = 0;

  // Of the frame in work.
  std::span<std::int64_t> node_ns_;
  std::span<vehicle::PlanarPose> node_poses_;
  std::span<float> cosine_, sine_, x_m_, y_m_;  ///< By column of the head, from first_shift_.
  std::span<frame::PlanarMotions> by_row_;      ///< Each a stretch of those four.
};

}  // namespace terracut::decode
