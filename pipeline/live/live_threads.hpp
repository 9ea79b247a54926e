// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

#include "firmware_io/net/live_source.hpp"
#include "firmware_io/sensor/told_table.hpp"
#include "pipeline/live/frame_exchange.hpp"
#include "pipeline/live/frame_pool.hpp"
#include "pipeline/live/frame_receiver.hpp"
#include "pipeline/live/frame_records.hpp"
#include "pipeline/live/frame_segmenter.hpp"
#include "pipeline/live/latest_near_ground.hpp"
#include "pipeline/live/live_pipeline.hpp"
#include "pipeline/live/live_thread_state.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/stream/labelled_frame_wire.hpp"
#include "rt/measure/run_queue_wait.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/grant.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/thread_setup.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// The two threads of a live run that have a deadline, and the queues from them to a third thread,
/// which calls take_record(). The two allocate nothing, take no lock and write to no file or
/// socket. The coarse stages are the part of the method that is done while a frame arrives
/// (ground/coarse_stages.hpp).
///
///   FrameReceiver     --FrameExchange-->     FrameSegmenter
///   datagrams -> recorder, decoder,          frames -> labels
///   coarse stages                               |          |
///      |                                     records   FramePool
///      '-- records of skipped frames --.        |          |
///                                      v        v          v
///                            whoever calls take_record()   label files, stream of points
class LiveThreads {
 public:
  struct Events {
    threads::WakeEvent frame_ready;   ///< Set when a frame was handed over.
    threads::WakeEvent points_ready;  ///< Set when a frame's labelled points were passed on.
    /// Makes both events. Fails with kCapacityExceeded when the process has no descriptor left.
    [[nodiscard]] static Expected<Events> make();
  };

  struct Config {
    std::int64_t deadline_ns = 50'000'000;       ///< Time from a frame's last packet to its labels.
    std::int64_t frame_period_ns = 100'000'000;  ///< Duration of one revolution of the head.
    std::int64_t longest_gathering_ns = 20'000'000;  ///< See GatheringPolicy::Config.
    bool keeps_labels = false;                       ///< Provides labels().
    bool keeps_points = false;                       ///< Provides points().
    bool compares_tables = false;                    ///< Provides told_table().
    threads::ThreadRequest receive, segment;
  };

  /// Takes all memory from `memory`. `recorder` may be null. All must outlive this object.
  LiveThreads(const Config& config, LivePipeline& pipeline, net::LiveSource& source, Events events,
              recorder::FlightRecorder* recorder, memory::FixedMemory& memory);
  /// Calls stop(), which ends both threads.
  ~LiveThreads() { stop(); }
  LiveThreads(const LiveThreads&) = delete;
  LiveThreads& operator=(const LiveThreads&) = delete;

  /// Starts both threads; returns what the system granted and refused. Throws std::system_error if
  /// the system refuses to start a thread.
  [[nodiscard]] std::vector<threads::Grant> start();
  /// Ends both threads. May be called on any thread and repeatedly.
  void stop();

  /// Takes the record of the next frame to judge. Skipped frames may come out of order.
  [[nodiscard]] bool take_record(status::FrameRecord& record) noexcept {
    return segmented_.take(record) || skipped_.take(record);
  }
  /// Returns the labels of every frame, by return index; null without Config::keeps_labels.
  [[nodiscard]] FramePool<frame::Label>* labels() noexcept { return labels_ ? &*labels_ : nullptr; }
  /// Returns the labelled points of every frame; null without Config::keeps_points.
  [[nodiscard]] FramePool<points::LabelledPoint>* points() noexcept {
    return points_ ? &*points_ : nullptr;
  }
  /// Returns the event that is woken after every frame given to points().
  [[nodiscard]] const threads::WakeEvent& points_ready() const noexcept {
    return events_.points_ready;
  }

  /// Returns the near ground of the newest examined frame (one in LatestNearGround::kFramesApart)
  /// unless it was returned before; else null. For one thread; valid until its next call.
  [[nodiscard]] const ground::NearGround* near_ground() noexcept { return near_ground_.newest(); }

  /// Returns the reader of the calibration table in the packets (Config::compares_tables).
  [[nodiscard]] sensor::ToldTable& told_table() noexcept { return told_table_; }

  /// Returns the state of the input. To be called from one thread.
  [[nodiscard]] const status::InputState& intake() noexcept;
  /// Returns how many frames were not judged because their records were taken too slowly.
  [[nodiscard]] std::uint64_t records_dropped() const noexcept {
    return segmented_.dropped() + skipped_.dropped();
  }
  [[nodiscard]] const LiveThreadState& receive_state() const noexcept { return receive_state_; }
  [[nodiscard]] const LiveThreadState& segment_state() const noexcept { return segment_state_; }

 private:
  static constexpr std::size_t kLabelSlots = 8;
  static constexpr std::size_t kPointSlots = 2;  // few, as the stream wants only the newest frame

  using Receiver = FrameReceiver<net::LiveSource, measure::SystemClock, measure::RunQueueWait>;
  using Segmenter = FrameSegmenter<measure::SystemClock, measure::RunQueueWait>;

  void receive() noexcept;
  void receive_frames(Receiver& receiver) noexcept TERRACUT_NONBLOCKING;
  void segment() noexcept;
  void segment_frames(Segmenter& segmenter) noexcept TERRACUT_NONBLOCKING;

  Config config_;
  LivePipeline& pipeline_;
  net::LiveSource& source_;
  Events events_;
  recorder::FlightRecorder* recorder_;
  sensor::ToldTable told_table_;

  FrameExchange exchange_;
  FrameRecords segmented_, skipped_;

  LatestNearGround near_ground_;

  std::optional<FramePool<frame::Label>> labels_;
  std::optional<FramePool<points::LabelledPoint>> points_;

  std::atomic<bool> stop_{false};
  queues::LatestValue<status::InputState> intake_;
  LiveThreadState receive_state_, segment_state_;
  std::jthread receive_thread_, segment_thread_;
};

}  // namespace terracut::live
