// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "pipeline/ground/turn_method.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::run {

/// A decoder and a method together: packets are pushed in, labelled turns come out. A turn comes
/// out when its last return is labelled: with our method some milliseconds into the next turn.
///
/// One thread. The constructor takes all memory (throws std::invalid_argument for an invalid
/// setting); nothing else allocates, locks or throws. Real-time safe if the method and the observer
/// are.
class LabelledTurns {
 public:
  LabelledTurns(const calib::SensorCalibration& calibration, const mount::RingProfile& profile,
                const decode::Decoder::Config& decoder, const ground::TurnMethodMaker& method,
                memory::FixedMemory& memory)
      : decoder_(calibration, profile.mount, decoder, memory),
        method_(method({.profile = profile,
                        .shape = decoder_.shape(),
                        .return_capacity = decoder_.return_capacity(),
                        .reader = decoder_.make_reader(memory)},
                       memory)) {}

  void push(const packet::Datagram& datagram) noexcept TERRACUT_NONBLOCKING {
    decoder_.push(datagram);
  }
  /// Ends the stream: next() then returns the turns that are still open.
  void end_stream() noexcept TERRACUT_NONBLOCKING;
  /// Lets next() label the rest of the turns that have come whole, because what follows them does
  /// not come yet.
  void wait_no_longer() noexcept TERRACUT_NONBLOCKING { closes_ = true; }

  /// Does the work on what was pushed. Returns the turns labelled by that, one after the other,
  /// then null; a turn and its labels are valid until the next call. Call no other function before
  /// next() has returned null, except those that tell of the turn.
  [[nodiscard]] const frame::Frame* next(const min_cut::CutBudget& budget,
                                         stage::StageObserver* observer) noexcept
      TERRACUT_NONBLOCKING;

  /// Returns one label per return of the turn, in order of arrival.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept { return method_->labels(); }
  /// Returns the heights of these returns above the ground, metres; empty if the method gives none.
  [[nodiscard]] std::span<const float> heights_m() const noexcept { return method_->heights_m(); }
  /// Returns the report of the turn.
  [[nodiscard]] const stage::SegmentationReport& report() const noexcept {
    return method_->report();
  }
  [[nodiscard]] const decode::Decoder& decoder() const noexcept { return decoder_; }
  [[nodiscard]] ground::TurnMethod& method() noexcept { return *method_; }

 private:
  [[nodiscard]] const frame::Frame* labelled() noexcept;

  decode::Decoder decoder_;
  std::unique_ptr<ground::TurnMethod> method_;  // never null
  bool closes_ = false;                         // close() is due
  bool is_handed_out_ = false;                  // turn_ was returned by next()
  std::array<frame::Frame, 2> whole_{};         // not labelled yet, the older one first
  frame::Frame turn_;
};

}  // namespace terracut::run
