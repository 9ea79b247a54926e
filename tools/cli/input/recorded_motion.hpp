// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "firmware_io/can/can_recording.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Reads the vehicle's motion from a recording of its CAN bus, read along with the packets of a
/// capture as it would have been heard beside them: by their stamps, on one clock.
///
/// Where that clock was set back, both recordings go back at one time. Whichever does so first
/// waits for the other, so that frames from before and behind the step stay beside packets from
/// before and behind it; but for no longer than a second of stamps, for it may be the step of one
/// clock alone. One thread.
class RecordedMotion {
 public:
  /// Errors as CanRecording::open() and motion_signals_of(); kMalformed, too, where no frame of the
  /// whole recording holds the signals.
  [[nodiscard]] static Expected<RecordedMotion> open(const Options& options,
                                                     memory::FixedMemory& memory);

  /// Begins the recording again. The errors of CanRecording.
  [[nodiscard]] Status restart();
  /// Takes the frames up to the stamp of a packet, the next one of its capture. A recording that
  /// breaks off is as one that ends; the fault is kept.
  void hear_until(std::int64_t stamp_ns);

  [[nodiscard]] vehicle::EgoMotion& motion() noexcept { return *motion_; }
  [[nodiscard]] std::uint64_t samples() const noexcept { return motion_->counters().accepted; }
  /// What was not understood of the recording, one line a kind; empty: nothing of note.
  [[nodiscard]] std::string warnings() const;

 private:
  RecordedMotion(std::filesystem::path path, can::CanRecording recording,
                 vehicle::MotionSignals signals, const vehicle::EgoMotion::Config& config,
                 memory::FixedMemory& memory);
  /// Of one of the two recordings: how often its stamps stepped back, and from where they last did.
  struct Steps {
    std::uint64_t count = 0;
    std::int64_t newest_ns = kNone, left_off_ns = kNone;
    void note(std::int64_t stamp_ns) noexcept;
  };
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();

  void read_on();
  /// Whether the next frame came before the newest packet.
  [[nodiscard]] bool next_is_due() noexcept;

  std::filesystem::path path_;
  can::CanRecording recording_;
  vehicle::MotionSignals signals_;
  std::unique_ptr<vehicle::EgoMotion> motion_;
  std::optional<can::CanFrame> next_;
  Steps frames_, packets_;
  std::string fault_;  ///< Where the recording broke off.
};

}  // namespace terracut::cli
