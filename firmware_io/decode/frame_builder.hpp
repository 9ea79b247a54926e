// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/rotor_sector.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// Sorts returns into frames, for any sensor.
///
/// Beams point some degrees before and behind the head, so around the seam (azimuth 0) returns of
/// frame k and of frame k + 1 arrive mixed. Two frames are open at any time, the `oldest()` and the
/// next: a laser that passes the seam late still lands in the right one.
/// next() hands out the oldest frame when the decoder has seen the hindmost beam pass the seam. A
/// frame without returns is skipped; one with missing firings has complete = false.
///
///   head rotates on -->        seam k             seam k+1
///   foremost beam     .......|------ frame k ---|=== frame k+1 ===
///   hindmost beam     ............|------ frame k ---|=== frame k+1
///
/// Frames are pulled: roll_to() and flush() say which frames have ended, next() hands these out one
/// by one. There is a third buffer, so that the returns of a frame stay untouched until the frame
/// after it was handed out, too.
///
/// Memory is taken in the constructor; nothing else allocates, locks or throws. One thread.
class FrameBuilder {
 public:
  struct Config {
    frame::ImageShape shape;
    std::size_t lasers = 0;             ///< Lasers in each tile of returns.
    std::size_t tiles = 0;              ///< Most tiles of a frame.
    std::int64_t revolution_ticks = 0;  ///< Ticks of azimuth in 360 degrees.
    bool has_fine = false;              ///< True if distances have fine parts.
  };

  /// Throws std::invalid_argument on a setting outside its range.
  FrameBuilder(const Config& config, memory::FixedMemory& memory);
  FrameBuilder(const FrameBuilder&) = delete;
  FrameBuilder& operator=(const FrameBuilder&) = delete;

  /// Starts a stream whose first firing is at head azimuth `rotor_ticks`; the hindmost beam of this
  /// firing lies in `oldest_frame`. No open frame may have returns (see flush()).
  void start(std::int64_t oldest_frame, std::int64_t rotor_ticks) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] bool started() const noexcept { return started_; }
  [[nodiscard]] std::int64_t oldest() const noexcept { return oldest_; }

  /// Returns the returns of an open frame, for adding more.
  [[nodiscard]] frame::MeasuredReturns& returns_of(std::int64_t frame) noexcept {
    return *open_[static_cast<std::size_t>(frame - oldest_)].returns;
  }

  /// Sets the blind sector, so that nothing counts as missing there: in intervals passed from now
  /// on, and at the stream's beginning and end.
  void set_blind(const packet::RotorSector& blind) noexcept { blind_ = blind; }

  /// lose() notes that the firings of an interval were lost, regain() that they arrived after all
  /// (reordered). `step_ticks` is the step from firing to firing. If `is_counted`, the builder
  /// counts the loss as a hole; otherwise the caller does.
  void lose(packet::RotorInterval gap, const packet::BeamSpread& spread, std::int64_t step_ticks,
            bool is_counted = true) noexcept TERRACUT_NONBLOCKING;
  void regain(packet::RotorInterval found,
              const packet::BeamSpread& spread) noexcept TERRACUT_NONBLOCKING;

  struct PacketNote {
    std::int64_t stamp_ns = 0;     ///< Stamp of the packet's datagram.
    std::int64_t rotor_ticks = 0;  ///< The head's azimuth at the packet's first firing.
    std::int64_t first_frame = 0, last_frame = 0;  ///< The frames that the packet's beams touch.
    /// Azimuth up to which the head has been seen or the sensor is blind.
    std::int64_t frontier_ticks = 0;
  };
  /// Notes a decoded packet. `step_ticks` and `spread` are those of the packet.
  void note_packet(const PacketNote& packet, std::int64_t step_ticks,
                   const packet::BeamSpread& spread) noexcept TERRACUT_NONBLOCKING;

  /// Ends all frames before `frame`. next() must then be called until it returns null.
  void roll_to(std::int64_t frame) noexcept TERRACUT_NONBLOCKING;
  /// Ends the stream and both open frames. Afterwards call next() until it returns null, then
  /// start().
  void flush() noexcept TERRACUT_NONBLOCKING;

  /// Returns the oldest ended frame that has returns; null if there is none. The frame is valid
  /// until the next call, its returns until the call after the one that returns the next frame.
  [[nodiscard]] frame::Frame* next() noexcept TERRACUT_NONBLOCKING;

  /// Returns the losses since the last frame was handed over, so that the decoder can add the ones
  /// it finds.
  [[nodiscard]] frame::LossCounters& losses() noexcept { return losses_; }
  /// Returns all losses since construction.
  [[nodiscard]] frame::LossCounters total_losses() const noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] std::uint32_t frames() const noexcept { return frames_; }
  [[nodiscard]] const frame::ImageShape& shape() const noexcept { return shape_; }
  /// Returns MeasuredReturns::return_capacity(), which is the same for all buffers.
  [[nodiscard]] std::size_t return_capacity() const noexcept {
    return buffers_[0].return_capacity();
  }
  /// The number of buffers, and the number of one that next() returned.
  static constexpr std::size_t kBuffers = 3;
  [[nodiscard]] std::size_t number_of(const frame::MeasuredReturns& buffer) const noexcept {
    return static_cast<std::size_t>(&buffer - buffers_.data());
  }

 private:
  struct OpenFrame {
    frame::MeasuredReturns* returns = nullptr;
    std::int64_t first_packet_ns = 0, last_packet_ns = 0;
    /// The head's azimuth at the first and the last packet.
    std::int64_t first_ticks = 0, last_ticks = 0;
    std::int64_t missing_ticks = 0;  ///< Azimuth lost where any beam of the frame fires.
    /// Azimuth lost in the frame's own revolution of the head; no overlaps.
    std::int64_t hole_ticks = 0;
    bool touched = false;
  };

  void open(std::size_t slot, std::int64_t frame, frame::MeasuredReturns& buffer) noexcept;
  struct Missing {
    packet::RotorInterval head;
    bool is_counted = true;
  };
  void add_missing(OpenFrame& frame, std::int64_t number, const Missing& missing, int sign,
                   const packet::BeamSpread& spread) noexcept;
  /// Opens `frame` and the one after it in place of the open frames, which must be empty.
  void pass_over(std::int64_t frame) noexcept TERRACUT_NONBLOCKING;
  void count_holes(std::int64_t hole_ticks) noexcept;
  [[nodiscard]] frame::HeadSweep head_of(const OpenFrame& frame) const noexcept;
  [[nodiscard]] bool seen_whole(const OpenFrame& frame) const noexcept;
  /// Fills frame_ from the oldest open frame; false if that has no returns.
  [[nodiscard]] bool close_oldest() noexcept TERRACUT_NONBLOCKING;
  /// Makes the newer open frame the oldest, and opens the next one in `buffer`.
  void open_next(frame::MeasuredReturns& buffer) noexcept TERRACUT_NONBLOCKING;

  frame::ImageShape shape_;
  std::int64_t revolution_ticks_;
  std::vector<frame::MeasuredReturns> buffers_;
  frame::MeasuredReturns* free_ = nullptr;  ///< The buffer that is not open.

  bool started_ = false;
  std::int64_t oldest_ = 0;
  std::int64_t over_before_ = 0;                      ///< Frames before this one have ended.
  std::int64_t turn_of_frame_0_ = 0, last_turn_ = 0;  ///< See MeasuredReturns::turn().
  int rolls_ = 0;  ///< The number of ended frames that may have returns.
  bool is_ending_ = false;
  std::array<OpenFrame, 2> open_;  ///< Frames oldest_ and oldest_ + 1.
  std::int64_t start_ticks_ = 0, frontier_ticks_ = 0, step_ticks_ = 1;
  packet::BeamSpread spread_;
  Missing last_gap_;  ///< The last gap; a frame opened later may begin inside it.
  packet::RotorSector blind_;

  std::uint32_t frames_ = 0;
  std::uint32_t packets_ = 0;
  frame::LossCounters losses_, losses_handed_over_;
  /// The frame handed out; its buffer stays open until next() is called again.
  frame::Frame frame_;
};

}  // namespace terracut::decode
