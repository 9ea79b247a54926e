// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "pipeline/ground/frame_method.hpp"
#include "pipeline/run/frame.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::run {

/// Turns packets into labels on one thread: packets are pushed in, frames come out, and the caller
/// may have each frame labelled.
///
///   pipeline.push(datagram);
///   while (Frame* frame = pipeline.next()) {
///     pipeline.label(*frame);
///     write(frame->record.info, *frame->image, pipeline.labels());
///   }
///
/// Coarse stages are done while a frame arrives. One thread. The constructor takes all memory
/// (throws std::invalid_argument for an invalid setting); nothing else allocates, locks or throws.
/// A method that needs all points needs Makes::kPoints. Our own labels returns as they were seen,
/// deskewed or not.
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
  };

  PacketPipeline(const calib::SensorCalibration& calibration, const mount::RingProfile& profile,
                 const decode::Decoder::Config& decoder, const ground::MethodMaker& method,
                 memory::FixedMemory& memory, Makes makes, Timing timing = Timing::kPackets)
      : decoder_(calibration, profile.mount, decoder, memory),
        method_(method({.profile = profile,
                        .shape = decoder_.shape(),
                        .return_capacity = decoder_.return_capacity(),
                        .reader = decoder_.make_reader(memory)},
                       memory)),
        timing_(timing) {
    if (makes == Makes::kPoints) points_.emplace(decoder_.point_image(memory));
  }

  void push(const packet::Datagram& datagram) noexcept;
  /// Ends the stream; call it when the source ends or is about to jump (a replay loop).
  void end_stream() noexcept;
  /// Returns the frames completed by push() or end_stream(), one after the other, then null; a
  /// frame is valid until the next call. Call no other function before next() has returned null.
  [[nodiscard]] Frame* next() noexcept;
  /// Returns why the last datagram was rejected; nothing if it was not rejected.
  [[nodiscard]] std::optional<frame::Reject> rejected() const noexcept {
    return decoder_.rejected();
  }

  /// Labels the frame returned last and completes its record; labels() then has one label per
  /// return, by return index, until the next call. A frame that is not labelled costs only the work
  /// that is done while it arrives.
  void label(Frame& frame) noexcept;
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept { return method_->labels(); }

  /// Fills `ground` with near ground from the frame labelled last.
  void take_near_ground(const Frame& frame, ground::NearGround& ground) noexcept {
    method_->take_near_ground({*frame.returns, frame.image}, ground);
  }

  [[nodiscard]] const decode::Decoder& decoder() const noexcept { return decoder_; }

 private:
  void resume() noexcept;
  void pause() noexcept;

  decode::Decoder decoder_;
  std::unique_ptr<ground::FrameMethod> method_;  ///< Never null.
  std::optional<frame::PointImage> points_;
  Timing timing_;
  StageClock clock_;
  std::int64_t decode_ns_ = 0;  ///< Time of decoding since the last frame.
  std::int64_t resumed_ns_ = 0;
  bool begins_ = true;  ///< True before a stream's first packet.
  Frame frame_;
};

}  // namespace terracut::run
