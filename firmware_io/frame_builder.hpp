// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "firmware_io/frame_info.hpp"
#include "firmware_io/head_sector.hpp"
#include "pipeline/range_image.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::firmware_io {

/// How far the beams point away from the head: every beam's azimuth minus the head's lies in
/// [hindmost, foremost].
struct BeamSpread {
  std::int64_t hindmost_ticks = 0, foremost_ticks = 0;
};

/// Sorts returns into turns. Knows nothing of any sensor.
///
/// Beams point some degrees before and behind the head, so around the seam (azimuth 0) returns of
/// turn k and of turn k + 1 arrive mixed. Two images are open at any time, of the `oldest()` turn
/// and the next; a laser that passes the seam late still lands in the right one. The oldest turn is
/// handed over by roll(), when the decoder has seen the hindmost beam pass the seam. A turn without
/// a single return is no frame; one that misses firings is, with complete = false.
///
///   head turns on -->        seam k             seam k+1
///   foremost beam     .......|------- turn k ---|=== turn k+1 ===
///   hindmost beam     ............|------- turn k ---|=== turn k+1
///
/// Hand-over is a call on_frame(const FrameInfo&, pipeline::RangeImage&), noexcept. Where it
/// returns nothing, the image handed over stays untouched until the (n - 2)th hand-over after it,
/// with n images. Where it returns a RangeImage*, the builder goes on with that one and does not
/// touch the other any more: images change hands one for one, for a reader on another thread. It
/// must be an image that nobody else uses, of images().
///
/// Memory is taken in the constructor; nothing else allocates, locks or throws. One thread.
class FrameBuilder {
 public:
  struct Config {
    pipeline::ImageShape shape;
    std::size_t overflow_capacity = 0;  ///< Returns of a turn that find their cell taken.
    int images = 3;                     ///< >= 3: two open, one with whoever it was handed to.
    std::int64_t turn_ticks = 0;        ///< Ticks in 360 degrees.
  };

  /// Throws std::invalid_argument on a setting outside its range.
  FrameBuilder(const Config& config, rt::FixedMemory& memory);
  FrameBuilder(const FrameBuilder&) = delete;
  FrameBuilder& operator=(const FrameBuilder&) = delete;

  /// A stream begins: the first firing is at head azimuth `head_ticks`, its hindmost beam in
  /// `oldest_turn`. Nothing may be open with returns in it (see flush()).
  void start(std::int64_t oldest_turn, std::int64_t head_ticks) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] bool started() const noexcept { return started_; }
  [[nodiscard]] std::int64_t oldest() const noexcept { return oldest_; }
  [[nodiscard]] bool is_open(std::int64_t turn) const noexcept {
    return started_ && turn - oldest_ >= 0 && turn - oldest_ <= 1;
  }

  /// Puts a return into an open turn. False, and counted, when its overflow list is full.
  bool place(std::int64_t turn, int row, int column, const pipeline::Return& echo,
             pipeline::CellOwner owner = pipeline::CellOwner::kFirstArrived) noexcept {
    if (image(turn).place(row, column, echo, owner)) return true;
    ++losses_.overflow_full_returns;
    return false;
  }

  /// An open turn's image, for returns that place_numbered() has room for.
  [[nodiscard]] pipeline::RangeImage& image(std::int64_t turn) noexcept {
    return *open_[static_cast<std::size_t>(turn - oldest_)].image;
  }

  /// Where the sensor is blind, nothing is missing: of the intervals given from now on, of the
  /// stream's beginning and of its end.
  void set_blind(const HeadSector& blind) noexcept { blind_ = blind; }

  /// Firings were lost in this interval / arrived after all (reordered). `step_ticks`: from firing
  /// to firing. `is_counted`: as a hole, too; else whoever calls does that.
  void lose(HeadInterval gap, const BeamSpread& spread, std::int64_t step_ticks,
            bool is_counted = true) noexcept TERRACUT_NONBLOCKING;
  void regain(HeadInterval found, const BeamSpread& spread) noexcept TERRACUT_NONBLOCKING;

  /// A packet with this datagram stamp was decoded; its beams touch turns [first, last].
  /// `step_ticks` and `spread` as they are now; the head has been seen up to `frontier_ticks`, or
  /// is blind before.
  void note_packet(std::int64_t stamp_ns, std::int64_t first_turn, std::int64_t last_turn,
                   std::int64_t frontier_ticks, std::int64_t step_ticks,
                   const BeamSpread& spread) noexcept TERRACUT_NONBLOCKING;

  /// Hands the oldest turn over, if it has returns, and opens the one after the next.
  template <class OnFrame>
  void roll(OnFrame&& on_frame) noexcept {
    pipeline::RangeImage& closing = *open_[0].image;
    if (!close_oldest()) {
      open_next(closing);
      return;
    }
    if constexpr (std::is_pointer_v<decltype(on_frame(info_, closing))>) {
      open_next(*on_frame(info_, closing));
    } else {
      on_frame(info_, closing);
      open_next(exchange(closing));
    }
  }

  /// Rolls on until `turn` is the oldest, or is already. Two turns at most have returns; those
  /// between are passed over at once, however many.
  template <class OnFrame>
  void roll_to(std::int64_t turn, OnFrame&& on_frame) noexcept {
    for (int open = 0; open < 2 && oldest_ < turn; ++open) roll(on_frame);
    if (oldest_ < turn) pass_over(turn);
  }

  /// The stream ends here: hands over what is open, oldest first. start() must follow.
  template <class OnFrame>
  void flush(OnFrame&& on_frame) noexcept {
    if (!started_) return;
    roll(on_frame);
    roll(on_frame);
    started_ = false;
  }

  /// What was lost since the last frame was handed over; the decoder adds its own causes here.
  [[nodiscard]] LossCounters& losses() noexcept { return losses_; }
  /// Everything lost since construction.
  [[nodiscard]] LossCounters total_losses() const noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] std::uint32_t frames() const noexcept { return frames_; }
  [[nodiscard]] const pipeline::ImageShape& shape() const noexcept { return shape_; }
  /// All images; the first two are open at the start.
  [[nodiscard]] std::span<pipeline::RangeImage> images() noexcept { return images_; }

 private:
  struct OpenTurn {
    pipeline::RangeImage* image = nullptr;
    std::int64_t first_packet_ns = 0, last_packet_ns = 0;
    std::int64_t missing_ticks = 0;  ///< Lost where any beam of the turn fires.
    std::int64_t hole_ticks = 0;     ///< Lost in the head's own turn; these tile the stream.
    bool touched = false;
  };

  /// The image that nobody has written to for the longest, for the one just handed over.
  [[nodiscard]] pipeline::RangeImage& exchange(pipeline::RangeImage& handed_over) noexcept
      TERRACUT_NONBLOCKING;
  void open(std::size_t slot, std::int64_t turn, pipeline::RangeImage& image) noexcept;
  struct Missing {
    HeadInterval head;
    bool is_counted = true;
  };
  void add_missing(OpenTurn& turn, std::int64_t number, const Missing& missing, int sign,
                   const BeamSpread& spread) noexcept;
  /// The open turns have nothing in them; opens `turn` and the next instead.
  void pass_over(std::int64_t turn) noexcept TERRACUT_NONBLOCKING;
  void count_holes(std::int64_t hole_ticks) noexcept;
  [[nodiscard]] bool seen_whole(const OpenTurn& turn) const noexcept;
  /// Fills info_, or answers false when the turn has no returns.
  [[nodiscard]] bool close_oldest() noexcept TERRACUT_NONBLOCKING;
  /// Shifts the open turns by one; the new one goes into `image`.
  void open_next(pipeline::RangeImage& image) noexcept TERRACUT_NONBLOCKING;

  pipeline::ImageShape shape_;
  std::int64_t turn_ticks_;
  std::vector<pipeline::RangeImage> images_;
  std::vector<pipeline::RangeImage*> free_;  ///< Not open; a ring, the longest so at next_free_.
  std::size_t next_free_ = 0;

  bool started_ = false;
  std::int64_t oldest_ = 0;
  std::array<OpenTurn, 2> open_;  ///< Of oldest_ and oldest_ + 1.
  std::int64_t start_ticks_ = 0, frontier_ticks_ = 0, step_ticks_ = 1;
  BeamSpread spread_;
  Missing last_gap_;  ///< A turn that opens later may begin inside it.
  HeadSector blind_;

  std::uint32_t frames_ = 0;
  std::uint32_t packets_ = 0;
  LossCounters losses_, losses_handed_over_;
  FrameInfo info_;
};

}  // namespace terracut::firmware_io
