// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "terracut/calibration.hpp"
#include "terracut/error.hpp"
#include "terracut/frame.hpp"

namespace terracut {

/// A live sensor's frames, labelled before a deadline. Two threads of its own receive and segment;
/// they allocate nothing, lock nothing, and give up parts of the method, never the deadline, when
/// they are late. on_frame is called on the thread that calls run(), which has no deadline: where
/// it is too slow, frames are left out and counted.
class LiveRun {
 public:
  struct Config {
    std::uint16_t port = 2368;  ///< Where the sensor's data packets come in, UDP.
    std::string address = "0.0.0.0";
    std::optional<Calibration> calibration;  ///< None: what the sensor itself says.
    Mount mount;
    /// The ground that the sensor sees in its first second says how it stands, instead of `mount`;
    /// where it does not, that of the next, for ten seconds.
    bool find_mount = false;
    /// With find_mount: goes on with `mount` where the ground did not show it, instead of failing;
    /// then found_mount() is empty.
    bool guess_mount = false;
    double deadline_ms = 50;  ///< From a frame's last packet to its labels, [1, 10000].
    /// How long packets may wait to be fetched together, never past a frame's end, [0, 20]; 0: each
    /// is fetched as it comes, which costs more wake-ups.
    double gather_ms = 20;
    int receive_priority = 80;  ///< SCHED_FIFO, [1, 99]; 0: shared scheduling.
    int segment_priority = 70;
    bool lock_memory = true;
    std::optional<double> patience_s;  ///< For the sensor to be heard; none: as long as it takes.
  };
  /// What became of all that was received.
  struct Figures {
    std::uint64_t datagrams = 0;        ///< Received.
    std::uint64_t decoded = 0;          ///< Of them, data packets that are in frames.
    std::uint64_t frames = 0;           ///< Handed to on_frame.
    std::uint64_t frames_skipped = 0;   ///< For the deadline's sake.
    std::uint64_t frames_left_out = 0;  ///< Because on_frame was too slow.
    std::uint64_t deadlines_missed = 0;
  };
  using OnFrame = std::function<void(const Frame& frame)>;
  using StopWanted = std::function<bool()>;

  /// Opens the socket and listens until a sensor is known. kInvalidArgument, kUnsupported,
  /// kNoCalibration, kMountNotFound, or the system's refusal of the socket. What the system does
  /// not grant (priority, locked memory) is no error; refusals() names it.
  [[nodiscard]] static Expected<LiveRun> open(const Config& config, const StopWanted& stop_wanted);
  LiveRun(LiveRun&&) noexcept;
  LiveRun& operator=(LiveRun&&) noexcept;
  ~LiveRun();

  [[nodiscard]] Sensor sensor() const noexcept;
  /// The mount that labels are made by, where it was found.
  [[nodiscard]] const std::optional<FoundMount>& found_mount() const noexcept;
  /// What the system refused, one line each; complete when run() has returned.
  [[nodiscard]] const std::string& refusals() const noexcept;

  /// Until stop_wanted(), which is asked many times a second.
  void run(const StopWanted& stop_wanted, const OnFrame& on_frame);
  /// From the thread that runs, or after.
  [[nodiscard]] Figures figures() const noexcept;

 private:
  struct Engine;
  explicit LiveRun(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
