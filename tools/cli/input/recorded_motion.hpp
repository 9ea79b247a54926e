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

/// Reads the vehicle's motion from a recording of its CAN bus along with the packets of a capture,
/// as if live: by their stamps, on one clock.
///
/// If that clock was set back, the stamps of both recordings step back. The recording that does so
/// first waits for the other, so that frames and packets from before the step stay together, as do
/// those from after it. It waits at most for a second of stamps, because maybe only one of the
/// recordings steps back. One thread.
class RecordedMotion {
 public:
  /// Opens the recording. Fails with the errors of CanRecording::open() and motion_signals_of(), or
  /// kMalformed if no frame of the whole recording has the signals.
  [[nodiscard]] static Expected<RecordedMotion> open(const Options& options,
                                                     memory::FixedMemory& memory);

  /// Starts the recording again. Fails with the errors of CanRecording.
  [[nodiscard]] Status restart();
  /// Takes the CAN frames up to `stamp_ns`, the stamp of the capture's next packet. A recording
  /// that breaks off counts as ended; the fault is kept.
  void hear_until(std::int64_t stamp_ns);

  [[nodiscard]] vehicle::EgoMotion& motion() noexcept { return *motion_; }
  [[nodiscard]] std::uint64_t samples() const noexcept { return motion_->counters().accepted; }
  /// Lists the parts of the recording that were not understood, one line per kind; empty if there
  /// are none.
  [[nodiscard]] std::string warnings() const;

 private:
  RecordedMotion(std::filesystem::path path, can::CanRecording recording,
                 vehicle::MotionSignals signals, const vehicle::EgoMotion::Config& config,
                 memory::FixedMemory& memory);
  /// How often the stamps of one of the two recordings stepped back; its newest stamp, and the one
  /// before the last step.
  struct Steps {
    std::uint64_t count = 0;
    std::int64_t newest_ns = kNone, left_off_ns = kNone;
    void note(std::int64_t stamp_ns) noexcept;
  };
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();

  void read_on();
  /// True if the next CAN frame came before the newest packet.
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
