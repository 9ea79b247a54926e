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

/// Labels a live sensor's frames before a deadline. Two threads of its own receive and segment;
/// they allocate nothing, lock nothing, and give up parts of the method, never the deadline, when
/// they are late. on_frame is called on the thread that calls run(), which has no deadline: if it
/// is too slow, frames are left out and counted.
class LiveRun {
 public:
  struct Config {
    std::uint16_t port = 2368;  ///< UDP port of the sensor's data packets.
    std::string address = "0.0.0.0";
    std::optional<Calibration> calibration;  ///< None: the sensor's own.
    Mount mount;
    /// Finds the mount from the ground seen in the first second, instead of using `mount`; if that
    /// does not show it, from the next seconds, for ten seconds.
    bool find_mount = false;
    /// With find_mount: continues with `mount` if the ground did not show it, instead of failing;
    /// found_mount() is then empty.
    bool guess_mount = false;
    double deadline_ms = 50;  ///< From a frame's last packet to its labels, [1, 10000].
    /// How long packets may wait to be fetched together, never past a frame's end, [0, 20]; 0: each
    /// is fetched as it comes, with more wake-ups.
    double gather_ms = 20;
    int receive_priority = 80;  ///< SCHED_FIFO, [1, 99]; 0: shared scheduling.
    int segment_priority = 70;
    bool lock_memory = true;
    std::optional<double> patience_s;  ///< How long to wait for the sensor; none: without limit.
  };
  /// Counts all that was received by outcome.
  struct Figures {
    std::uint64_t datagrams = 0;        ///< Datagrams received.
    std::uint64_t decoded = 0;          ///< Data packets that are in frames.
    std::uint64_t frames = 0;           ///< Frames handed to on_frame.
    std::uint64_t frames_skipped = 0;   ///< Skipped to keep the deadline.
    std::uint64_t frames_left_out = 0;  ///< Left out because on_frame was too slow.
    std::uint64_t deadlines_missed = 0;
  };
  using OnFrame = std::function<void(const Frame& frame)>;
  using StopWanted = std::function<bool()>;

  /// Opens the socket and listens until a sensor is known. kInvalidArgument, kUnsupported,
  /// kNoCalibration, kMountNotFound, or the system's refusal of the socket. A refused priority or
  /// memory lock is no error; refusals() names it.
  [[nodiscard]] static Expected<LiveRun> open(const Config& config, const StopWanted& stop_wanted);
  LiveRun(LiveRun&&) noexcept;
  LiveRun& operator=(LiveRun&&) noexcept;
  ~LiveRun();

  [[nodiscard]] Sensor sensor() const noexcept;
  /// Returns the mount used for labels, if it was found.
  [[nodiscard]] const std::optional<FoundMount>& found_mount() const noexcept;
  /// Returns what the system refused, one line each; complete when run() has returned.
  [[nodiscard]] const std::string& refusals() const noexcept;

  /// Runs until stop_wanted(), which is asked many times a second.
  void run(const StopWanted& stop_wanted, const OnFrame& on_frame);
  /// To be called from the running thread, or after run().
  [[nodiscard]] Figures figures() const noexcept;

 private:
  struct Engine;
  explicit LiveRun(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
