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

/// The way from packets to labels on one thread: packets are pushed in, frames come out, and
/// whoever takes a frame may have it labelled.
///
///   pipeline.push(datagram);
///   while (Frame* frame = pipeline.next()) {
///     pipeline.label(*frame);
///     write(frame->record.info, *frame->image, pipeline.labels());
///   }
///
/// Coarse stages are done ahead, while a frame arrives. One thread. The constructor takes all
/// memory (throws std::invalid_argument on a bad setting); nothing else allocates, locks or throws.
class PacketPipeline {
 public:
  /// What the time of decoding is made of.
  enum class Timing : std::uint8_t {
    kPackets,  ///< Of each packet's own; the caller may do what it likes between two packets.
    kFrames,   ///< All of a stream from one frame to the next, two readings of the clock a frame.
  };

  PacketPipeline(const calib::SensorCalibration& calibration, const mount::RingProfile& profile,
                 const decode::Decoder::Config& decoder, const ground::MethodMaker& method,
                 memory::FixedMemory& memory, Timing timing = Timing::kPackets)
      : decoder_(calibration, profile.mount, decoder, memory),
        method_(method({.profile = profile,
                        .shape = decoder_.shape(),
                        .return_capacity = decoder_.return_capacity(),
                        .motion_is_known = decoder.motion != nullptr,
                        .reader = decoder_.make_reader(memory)},
                       memory)),
        timing_(timing) {}

  void push(const packet::Datagram& datagram) noexcept;
  /// The stream ends or its source will jump (a replay loop).
  void end_stream() noexcept;
  /// After either: the frames that it completed, one after the other, then null; a frame is valid
  /// until the next call. To be called until null before anything else is asked of the pipeline.
  [[nodiscard]] Frame* next() noexcept;
  /// Why the datagram pushed last was rejected, if it was.
  [[nodiscard]] std::optional<frame::Reject> rejected() const noexcept {
    return decoder_.rejected();
  }

  /// Labels the frame handed out last, and completes its record; labels() has one a return, by
  /// return index, until the next call. Frames that are not labelled cost no more than what was
  /// done ahead.
  void label(Frame& frame) noexcept;
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept { return method_->labels(); }

  /// Of the frame labelled last.
  void take_near_ground(const Frame& frame, ground::NearGround& ground) noexcept {
    method_->take_near_ground(*frame.image, ground);
  }

  [[nodiscard]] const decode::Decoder& decoder() const noexcept { return decoder_; }

 private:
  void resume() noexcept;
  void pause() noexcept;

  decode::Decoder decoder_;
  std::unique_ptr<ground::FrameMethod> method_;  ///< Never null.
  Timing timing_;
  StageClock clock_;
  std::int64_t decode_ns_ = 0;  ///< Since the frame before.
  std::int64_t resumed_ns_ = 0;
  bool begins_ = true;  ///< The next packet is a stream's first.
  Frame frame_;
};

}  // namespace terracut::run
