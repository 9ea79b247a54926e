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

/// Labels a live sensor's returns before a deadline. It starts a thread that receives and labels;
/// this allocates nothing and locks nothing, and when late it leaves out the cut until it has
/// caught up. The thread that calls run() calls on_frame, without a deadline: if on_frame is too
/// slow, frames are left out and counted. A frame's last returns wait some milliseconds for those
/// that follow it; on_sector gets returns as soon as they are labelled.
class LiveRun {
 public:
  using OnFrame = std::function<void(const Frame& frame)>;
  using OnSector = std::function<void(const Sector& sector)>;
  using StopWanted = std::function<bool()>;

  struct Config {
    std::uint16_t port = 2368;  ///< UDP port of the sensor's data packets.
    std::string address = "0.0.0.0";
    std::optional<Calibration> calibration;  ///< If empty, the sensor's own table is used.
    Mount mount;
    /// Finds the mount from the ground seen in the first second, instead of using `mount`. If that
    /// second does not show it, later seconds are tried, up to ten.
    bool find_mount = false;
    /// With find_mount: if the ground did not show the mount, continues with `mount` instead of
    /// failing; found_mount() is then empty.
    bool guess_mount = false;
    double deadline_ms = 50;  ///< Time from a return's packet to its label, [1, 10000].
    /// How long packets may wait to be fetched together, and labels with them, [0, 20]. With 0 each
    /// packet is fetched as it comes, with more wake-ups.
    double gather_ms = 2;
    int priority = 80;  ///< SCHED_FIFO priority, [1, 99]; 0: shared scheduling.
    bool lock_memory = true;
    std::optional<double> patience_s;  ///< Time to wait for the sensor; empty: no limit.
    bool heights = false;              ///< Frames and sectors come with height_above_ground_m.
    /// Frames come with their objects, found on the thread of run(), and with heights; sectors with
    /// those that are complete.
    bool objects = false;
    bool free_way = false;  ///< The same of their free way.
    /// If set, run() also calls this for each sector, before on_frame for its frame. A sector is
    /// valid during the call.
    OnSector on_sector;
  };
  /// Counts datagrams and frames by what became of them.
  struct Figures {
    std::uint64_t datagrams = 0;         ///< Datagrams received.
    std::uint64_t decoded = 0;           ///< Data packets that are in frames.
    std::uint64_t frames = 0;            ///< Frames handed to on_frame.
    std::uint64_t frames_left_out = 0;   ///< Frames left out because on_frame was too slow.
    std::uint64_t sectors = 0;           ///< Sectors handed to on_sector.
    std::uint64_t sectors_left_out = 0;  ///< Sectors left out because a callback was too slow.
    std::uint64_t deadlines_missed = 0;
  };

  /// Opens the socket and listens until a sensor is known. Fails with kInvalidArgument,
  /// kUnsupported, kNoCalibration, kMountNotFound, or the system's refusal of the socket. A refused
  /// priority or memory lock is no error; refusals() names it.
  [[nodiscard]] static Expected<LiveRun> open(const Config& config, const StopWanted& stop_wanted);
  LiveRun(LiveRun&&) noexcept;
  LiveRun& operator=(LiveRun&&) noexcept;
  ~LiveRun();

  [[nodiscard]] Sensor sensor() const noexcept;
  /// Returns the mount used for labels if it was found; empty if it was stated or guessed.
  [[nodiscard]] const std::optional<FoundMount>& found_mount() const noexcept;
  /// Returns what the system refused, one line each; complete when run() has returned.
  [[nodiscard]] const std::string& refusals() const noexcept;

  /// Runs until stop_wanted() returns true; it is called many times a second.
  void run(const StopWanted& stop_wanted, const OnFrame& on_frame);
  /// Returns the counts so far. Call it on the thread of run(), or after run().
  [[nodiscard]] Figures figures() const noexcept;

 private:
  struct Engine;
  explicit LiveRun(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
