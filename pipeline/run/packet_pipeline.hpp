// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "pipeline/run/frame.hpp"
#include "pipeline/run/labelled_turns.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::run {

/// Turns packets into labels on one thread, and takes the time: packets are pushed in, labelled
/// frames with their records come out.
///
///   pipeline.push(datagram);
///   while (Frame* frame = pipeline.next()) write(frame->record.info, pipeline.labels());
///
/// One thread. The constructor takes all memory (throws std::invalid_argument for an invalid
/// setting); nothing else allocates, locks or throws.
class PacketPipeline {
 public:
  /// The way in which the time of decoding is measured.
  enum class Timing : std::uint8_t {
    kPackets,  ///< Packet by packet; the caller may pause between packets.
    kFrames,   ///< From frame to frame; reads the clock twice per frame.
  };

  /// What frames come with.
  enum class Makes : std::uint8_t {
    kLabels,  ///< Labels alone; Frame::image is null.
    kPoints,  ///< An image of points as well, deskewed if the frame is.
    kBoth,    ///< Of deskewed frames an image of points as they were measured, too.
  };

  /// The first arguments are those of LabelledTurns.
  PacketPipeline(const calib::SensorCalibration& calibration, const mount::RingProfile& profile,
                 const decode::Decoder::Config& decoder, const ground::TurnMethodMaker& method,
                 memory::FixedMemory& memory, Makes makes, Timing timing = Timing::kPackets)
      : turns_(calibration, profile, decoder, method, memory), timing_(timing) {
    if (makes != Makes::kLabels) points_.emplace(turns_.decoder().point_image(memory));
    if (makes == Makes::kBoth) as_measured_.emplace(turns_.decoder().point_image(memory));
  }

  void push(const packet::Datagram& datagram) noexcept;
  /// Ends the stream; call it when the source ends or is about to jump (a replay loop).
  void end_stream() noexcept;
  /// Returns the frames labelled by push() or end_stream(), one after the other, then null; a frame
  /// and its labels are valid until the next call. Call no other function before next() has
  /// returned null, except those that tell of the frame.
  [[nodiscard]] Frame* next() noexcept;
  /// Returns one label per return of the frame returned last, by return index.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept { return turns_.labels(); }
  /// Returns the heights of these returns above the ground, metres; empty if the method gives none.
  [[nodiscard]] std::span<const float> heights_m() const noexcept { return turns_.heights_m(); }
  /// Returns why the last datagram was rejected; nothing if it was not rejected.
  [[nodiscard]] std::optional<frame::Reject> rejected() const noexcept {
    return decoder().rejected();
  }

  /// From the next frame on, fills `ground` with near ground of each frame, valid as long as the
  /// frame; null: no longer.
  void watch_near_ground(ground::NearGround* ground) noexcept {
    turns_.method().watch_near_ground(ground);
  }

  [[nodiscard]] const decode::Decoder& decoder() const noexcept { return turns_.decoder(); }

 private:
  void resume() noexcept;
  void pause() noexcept;

  LabelledTurns turns_;
  std::optional<frame::PointImage> points_, as_measured_;
  Timing timing_;
  StageClock clock_;
  std::int64_t work_ns_ = 0;  ///< Time of work since the last frame.
  std::int64_t resumed_ns_ = 0;
  std::int64_t before_push_ns_ = 0;  ///< Time of stages since the last frame, at the last push.
  bool begins_ = true;               ///< True before a stream's first packet.
  Frame frame_;
};

}  // namespace terracut::run
