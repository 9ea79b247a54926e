// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "firmware_io/net/live_source.hpp"
#include "firmware_io/sensor/told_table.hpp"
#include "pipeline/live/frame_pool.hpp"
#include "pipeline/live/frame_records.hpp"
#include "pipeline/live/latest_near_ground.hpp"
#include "pipeline/live/live_labeller.hpp"
#include "pipeline/live/live_thread_state.hpp"
#include "pipeline/live/sector_pool.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/run/labelled_turns.hpp"
#include "rt/measure/run_queue_wait.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/grant.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/thread_setup.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// The thread of a live run that has a deadline, and the queues from it to other threads. It
/// allocates nothing, takes no lock and writes to no file or socket.
///
///   LiveLabeller: datagrams -> recorder, decoder, method -> labels
///        |                  |
///     records       FramePool, SectorPool
///        v                  v
///   take_record()      label files, labelled points
class LiveThread {
 public:
  struct Config {
    std::int64_t deadline_ns = 50'000'000;          ///< Time from a return's packet to its label.
    std::int64_t frame_period_ns = 100'000'000;     ///< Duration of one revolution of the head.
    std::int64_t longest_gathering_ns = 2'000'000;  ///< See GatheringPolicy::Config.
    bool keeps_labels = false;                      ///< Provides labels().
    bool keeps_points = false;                      ///< Provides points().
    bool keeps_sectors = false;                     ///< Provides sectors().
    bool keeps_heights = false;                     ///< Points come with their heights.
    bool compares_tables = false;                   ///< Provides told_table().
    threads::ThreadRequest thread;
  };

  /// Takes all memory from `memory`. `points_ready` is set when labelled points were passed on;
  /// `recorder` may be null. All must outlive this object.
  LiveThread(const Config& config, run::LabelledTurns& turns, net::LiveSource& source,
             threads::WakeEvent points_ready, recorder::FlightRecorder* recorder,
             memory::FixedMemory& memory);
  /// Calls stop(), which ends the thread.
  ~LiveThread() { stop(); }
  LiveThread(const LiveThread&) = delete;
  LiveThread& operator=(const LiveThread&) = delete;

  /// Starts the thread; returns what the system granted and refused. Throws std::system_error if
  /// the system refuses to start a thread.
  [[nodiscard]] std::vector<threads::Grant> start();
  /// Ends the thread. May be called on any thread and repeatedly.
  void stop();

  /// Takes the record of the next frame to judge.
  [[nodiscard]] bool take_record(status::FrameRecord& record) noexcept {
    return records_.take(record);
  }
  /// Returns the labels of every frame, by return index; null without Config::keeps_labels.
  [[nodiscard]] FramePool<frame::Label>* labels() noexcept { return labels_ ? &*labels_ : nullptr; }
  /// Returns the labelled points of every frame; null without Config::keeps_points.
  [[nodiscard]] FramePool<points::LabelledPoint>* points() noexcept {
    return points_ ? &*points_ : nullptr;
  }
  /// Returns the labelled points of every sector, those of a frame before the frame itself; null
  /// without Config::keeps_sectors.
  [[nodiscard]] SectorPool* sectors() noexcept { return sectors_ ? &*sectors_ : nullptr; }
  /// Returns the event that is woken after what is given to points() and sectors().
  [[nodiscard]] const threads::WakeEvent& points_ready() const noexcept { return points_ready_; }

  /// Returns the near ground of the newest examined frame (one in LatestNearGround::kFramesApart)
  /// unless it was returned before; else null. For one thread; valid until its next call.
  [[nodiscard]] const ground::NearGround* near_ground() noexcept { return near_ground_.newest(); }

  /// Returns the reader of the calibration table in the packets (Config::compares_tables).
  [[nodiscard]] sensor::ToldTable& told_table() noexcept { return told_table_; }

  /// Returns the state of the input. To be called from one thread.
  [[nodiscard]] const status::InputState& intake() noexcept;
  /// Returns how many frames were not judged because their records were taken too slowly.
  [[nodiscard]] std::uint64_t records_dropped() const noexcept { return records_.dropped(); }
  [[nodiscard]] const LiveThreadState& state() const noexcept { return state_; }

 private:
  static constexpr std::size_t kLabelSlots = 8;
  static constexpr std::size_t kPointSlots = 2;  // few, as the stream wants only the newest frame

  using Labeller = LiveLabeller<net::LiveSource, measure::SystemClock, measure::RunQueueWait>;

  void work() noexcept;
  void label(Labeller& labeller) noexcept TERRACUT_NONBLOCKING;

  Config config_;
  run::LabelledTurns& turns_;
  net::LiveSource& source_;
  threads::WakeEvent points_ready_;
  recorder::FlightRecorder* recorder_;
  sensor::ToldTable told_table_;
  FrameRecords records_;
  LatestNearGround near_ground_;
  std::optional<FramePool<frame::Label>> labels_;
  std::optional<FramePool<points::LabelledPoint>> points_;
  std::optional<SectorPool> sectors_;
  std::unique_ptr<frame::TileReader> reader_;  ///< For points and sectors; else null.

  std::atomic<bool> stop_{false};
  queues::LatestValue<status::InputState> intake_;
  LiveThreadState state_;
  std::jthread thread_;
};

}  // namespace terracut::live
