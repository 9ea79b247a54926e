// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/packet/beam_spread.hpp"
#include "firmware_io/packet/rotor_sector.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// Sorts returns into frames, for any sensor.
///
/// Beams point some degrees before and behind the head, so around the seam (azimuth 0) returns of
/// frame k and of frame k + 1 arrive mixed. Two images are open at any time, one of the `oldest()`
/// frame and one of the next: a laser that passes the seam late still lands in the right one.
/// next() hands out the oldest frame when the decoder has seen the hindmost beam pass the seam. A
/// frame without returns is skipped; one with missing firings has complete = false.
///
///   head rotates on -->        seam k             seam k+1
///   foremost beam     .......|------ frame k ---|=== frame k+1 ===
///   hindmost beam     ............|------ frame k ---|=== frame k+1
///
/// Frames are pulled: roll_to() and flush() say which frames are over, next() hands them out one by
/// one. The image handed out stays untouched until the (n - 2)th frame after it, with n images. If
/// the next call gets another image in exchange, the builder goes on with that one and never
/// touches the one it handed out, which may go to a reader on another thread.
///
/// Memory is taken in the constructor; nothing else allocates, locks or throws. One thread.
class FrameBuilder {
 public:
  struct Config {
    frame::ImageShape shape;
    std::size_t overflow_capacity = 0;  ///< Room for returns that find their cell taken.
    int images = 3;                     ///< >= 3: two open, one handed out.
    std::int64_t revolution_ticks = 0;  ///< Ticks in 360 degrees.
    /// Frames are kept as measured, with room for so many tiles; 0: kept as points.
    std::size_t measured_tiles = 0;
    std::size_t lasers = 0;  ///< Lasers of a tile.
  };

  /// Throws std::invalid_argument on a setting outside its range.
  FrameBuilder(const Config& config, memory::FixedMemory& memory);
  FrameBuilder(const FrameBuilder&) = delete;
  FrameBuilder& operator=(const FrameBuilder&) = delete;

  /// Starts a stream: the first firing is at head azimuth `rotor_ticks`, its hindmost beam in
  /// `oldest_frame`. No open frame may have returns (see flush()).
  void start(std::int64_t oldest_frame, std::int64_t rotor_ticks) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] bool started() const noexcept { return started_; }
  [[nodiscard]] std::int64_t oldest() const noexcept { return oldest_; }

  /// Puts a return into an open frame. False, and counted, if its overflow list is full.
  bool place(std::int64_t frame, int row, int column, const frame::Return& point,
             frame::CellOwner owner = frame::CellOwner::kFirstArrived) noexcept {
    if (image(frame).place(row, column, point, owner)) return true;
    ++losses_.overflow_full_returns;
    return false;
  }

  /// Returns an open frame's image, for returns that place_numbered() has room for.
  [[nodiscard]] frame::RangeImage& image(std::int64_t frame) noexcept {
    return *open_[static_cast<std::size_t>(frame - oldest_)].image;
  }

  /// True if all images keep their returns as measured (RangeImage::measured()).
  [[nodiscard]] bool keeps_measured() const noexcept { return images_[0].measured() != nullptr; }

  /// Sets where nothing counts as missing because the sensor is blind: in intervals given from now
  /// on, and at the stream's beginning and end.
  void set_blind(const packet::RotorSector& blind) noexcept { blind_ = blind; }

  /// lose(): firings were lost in this interval. regain(): they arrived after all (reordered).
  /// `step_ticks`: from firing to firing. `is_counted`: counted as a hole here; else the caller
  /// counts it.
  void lose(packet::RotorInterval gap, const packet::BeamSpread& spread, std::int64_t step_ticks,
            bool is_counted = true) noexcept TERRACUT_NONBLOCKING;
  void regain(packet::RotorInterval found,
              const packet::BeamSpread& spread) noexcept TERRACUT_NONBLOCKING;

  struct PacketNote {
    std::int64_t stamp_ns = 0;                     ///< Of its datagram.
    std::int64_t rotor_ticks = 0;                  ///< The head's azimuth at its first firing.
    std::int64_t first_frame = 0, last_frame = 0;  ///< The frames its beams touch.
    std::int64_t frontier_ticks = 0;  ///< The head has been seen, or is blind, up to here.
  };
  /// Notes a decoded packet. `step_ticks` and `spread` are its own.
  void note_packet(const PacketNote& packet, std::int64_t step_ticks,
                   const packet::BeamSpread& spread) noexcept TERRACUT_NONBLOCKING;

  /// Ends the frames before `frame`. next() must then be called until it returns null.
  void roll_to(std::int64_t frame) noexcept TERRACUT_NONBLOCKING;
  /// Ends the stream and both open frames. next() must then be called until it returns null, then
  /// start().
  void flush() noexcept TERRACUT_NONBLOCKING;

  /// Returns the oldest ended frame that has returns; null if there is none. Valid until the next
  /// call. `in_exchange`: an image of images() that nobody else uses, taken for the one handed out
  /// last. Null: the builder takes its own image that was handed out longest ago.
  [[nodiscard]] frame::Frame* next(frame::RangeImage* in_exchange = nullptr) noexcept
      TERRACUT_NONBLOCKING;

  /// Returns the losses since the last frame was handed over; the decoder adds its own causes here.
  [[nodiscard]] frame::LossCounters& losses() noexcept { return losses_; }
  /// Returns all losses since construction.
  [[nodiscard]] frame::LossCounters total_losses() const noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] std::uint32_t frames() const noexcept { return frames_; }
  [[nodiscard]] const frame::ImageShape& shape() const noexcept { return shape_; }
  /// Returns each image's RangeImage::return_capacity().
  [[nodiscard]] std::size_t return_capacity() const noexcept {
    return images_[0].return_capacity();
  }
  /// Returns all images; the first two are open at the start.
  [[nodiscard]] std::span<frame::RangeImage> images() noexcept { return images_; }

 private:
  struct OpenFrame {
    frame::RangeImage* image = nullptr;
    std::int64_t first_packet_ns = 0, last_packet_ns = 0;
    std::int64_t first_ticks = 0, last_ticks = 0;  ///< The head's azimuth at these.
    std::int64_t missing_ticks = 0;                ///< Lost where any beam of the frame fires.
    std::int64_t hole_ticks = 0;  ///< Lost in the head's revolution of this number; no overlaps.
    bool touched = false;
  };

  /// Takes the image that was handed out longest ago in place of the one just handed over.
  [[nodiscard]] frame::RangeImage& exchange(frame::RangeImage& handed_over) noexcept
      TERRACUT_NONBLOCKING;
  void open(std::size_t slot, std::int64_t frame, frame::RangeImage& image) noexcept;
  struct Missing {
    packet::RotorInterval head;
    bool is_counted = true;
  };
  void add_missing(OpenFrame& frame, std::int64_t number, const Missing& missing, int sign,
                   const packet::BeamSpread& spread) noexcept;
  /// Opens `frame` and the next in place of the open frames, which must be empty.
  void pass_over(std::int64_t frame) noexcept TERRACUT_NONBLOCKING;
  void count_holes(std::int64_t hole_ticks) noexcept;
  [[nodiscard]] frame::HeadSweep head_of(const OpenFrame& frame) const noexcept;
  [[nodiscard]] bool seen_whole(const OpenFrame& frame) const noexcept;
  /// Fills frame_; false if the frame has no returns.
  [[nodiscard]] bool close_oldest() noexcept TERRACUT_NONBLOCKING;
  /// Shifts the open frames by one; the new one goes into `image`.
  void open_next(frame::RangeImage& image) noexcept TERRACUT_NONBLOCKING;

  frame::ImageShape shape_;
  std::int64_t revolution_ticks_;
  std::vector<frame::RangeImage> images_;
  std::vector<frame::RangeImage*> free_;  ///< Images not open: a ring, oldest at next_free_.
  std::size_t next_free_ = 0;

  bool started_ = false;
  std::int64_t oldest_ = 0;
  std::int64_t over_before_ = 0;  ///< Frames before this one have ended.
  int rolls_ = 0;                 ///< The number of ended frames that may have returns.
  bool is_ending_ = false;
  std::array<OpenFrame, 2> open_;  ///< Frames oldest_ and oldest_ + 1.
  std::int64_t start_ticks_ = 0, frontier_ticks_ = 0, step_ticks_ = 1;
  packet::BeamSpread spread_;
  Missing last_gap_;  ///< A frame that opens later may begin inside it.
  packet::RotorSector blind_;

  std::uint32_t frames_ = 0;
  std::uint32_t packets_ = 0;
  frame::LossCounters losses_, losses_handed_over_;
  frame::Frame frame_;  ///< Handed out; its image stays open until next() is called again.
};

}  // namespace terracut::decode
