// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "firmware_io/can/can_recording.hpp"
#include "firmware_io/can/motion_signals.hpp"
#include "firmware_io/motion/ego_motion.hpp"
#include "options.hpp"
#include "rt/error.hpp"
#include "rt/fixed_memory.hpp"

namespace terracut::cli {

/// The vehicle's motion out of a recording of its CAN bus, read along with the packets of a
/// capture as it would have been heard beside them. One thread.
class RecordedMotion {
 public:
  /// Errors as CanRecording::open() and motion_signals_of().
  [[nodiscard]] static Expected<RecordedMotion> open(const ReplayOptions& options,
                                                     rt::FixedMemory& memory);

  /// Begins the recording again. The errors of CanRecording.
  [[nodiscard]] Status restart();
  /// Takes the frames up to this stamp. A recording that breaks off is as one that ends; the fault
  /// is kept.
  void hear_until(std::int64_t stamp_ns);

  [[nodiscard]] firmware_io::EgoMotion& motion() noexcept { return *motion_; }
  [[nodiscard]] std::uint64_t samples() const noexcept { return motion_->counters().accepted; }
  /// What was not understood of the recording, one line a kind; empty: nothing of note.
  [[nodiscard]] std::string warnings() const;

 private:
  RecordedMotion(std::filesystem::path path, firmware_io::CanRecording recording,
                 firmware_io::MotionSignals signals, const firmware_io::EgoMotion::Config& config,
                 rt::FixedMemory& memory);
  void read_on();

  std::filesystem::path path_;
  firmware_io::CanRecording recording_;
  firmware_io::MotionSignals signals_;
  std::unique_ptr<firmware_io::EgoMotion> motion_;
  std::optional<firmware_io::CanFrame> next_;
  std::string fault_;  ///< Where the recording broke off.
};

}  // namespace terracut::cli
