// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

#include "firmware_io/live/flight_recorder.hpp"
#include "firmware_io/live/wake_event.hpp"
#include "firmware_io/sinks/labelled_turn_wire.hpp"
#include "frame_exchange.hpp"
#include "frame_slots.hpp"
#include "frame_timings.hpp"
#include "latest_near_ground.hpp"
#include "live_chain.hpp"
#include "live_options.hpp"
#include "live_source.hpp"
#include "live_thread_state.hpp"
#include "rt/grant.hpp"
#include "rt/latest_value.hpp"
#include "rt/nonblocking.hpp"
#include "rt/run_queue_wait.hpp"
#include "rt/thread_cpu_clock.hpp"
#include "told_table.hpp"
#include "turn_receiver.hpp"
#include "turn_segmenter.hpp"

namespace terracut::cli {

/// The two threads of `terracut live` that have a deadline, and the queues through which a third
/// one hears of them. They allocate nothing, lock nothing and write nothing:
///
///   TurnReceiver  datagrams -> recorder,  --FrameExchange-->  TurnSegmenter  turns -> labels
///      |          decoder, coarse stages                         |                      |
///      '-- timings of skipped turns --.      .---- timings ------'                      |
///      FrameSlots
///                                     v      v                                          v
///                              whoever calls take_timing()            label files, stream of
///                              points
class LiveThreads {
 public:
  struct Events {
    firmware_io::WakeEvent turn_ready;    ///< A turn was handed over.
    firmware_io::WakeEvent points_ready;  ///< A turn's labelled points were passed on.
    /// kCapacityExceeded when the process has no descriptor left.
    [[nodiscard]] static Expected<Events> make();
  };

  /// Takes all memory from `memory`. `turn_ns`: of one turn of the head. `recorder` may be null.
  /// Everything must outlive this.
  LiveThreads(const LiveOptions& options, std::int64_t turn_ns, LiveChain& chain,
              LiveSource& source, Events events, firmware_io::FlightRecorder* recorder,
              rt::FixedMemory& memory);

  /// Starts both; answers what the system granted and refused them.
  [[nodiscard]] std::vector<rt::Grant> start();
  void stop();

  /// The next judged-to-be frame's times, in no strict order between skipped ones and others.
  [[nodiscard]] bool take_timing(rt::FrameTiming& timing) noexcept {
    return segmented_.take(timing) || skipped_.take(timing);
  }
  /// The labels of every turn, by return index; nothing without options.labels.
  [[nodiscard]] FrameSlots<pipeline::Label>* labels() noexcept {
    return labels_ ? &*labels_ : nullptr;
  }
  /// The labelled points of every turn; nothing without options.stream.
  [[nodiscard]] FrameSlots<firmware_io::LabelledPoint>* points() noexcept {
    return points_ ? &*points_ : nullptr;
  }
  /// Woken after every turn that points() was given.
  [[nodiscard]] const firmware_io::WakeEvent& points_ready() const noexcept {
    return events_.points_ready;
  }

  /// The near ground of a turn now and then (MountWatch::kTurnsApart), where there is a newer one
  /// than was taken last; else null. From one thread; valid until its next call.
  [[nodiscard]] const pipeline::NearGround* near_ground() noexcept { return near_ground_.newest(); }

  /// What the packets tell of the unit's table, where options.capture.calibration is in use.
  [[nodiscard]] ToldTable& told_table() noexcept { return told_table_; }

  /// From one thread.
  [[nodiscard]] const Intake& intake() noexcept;
  /// Frames that nobody judged because the one who takes timings was too slow.
  [[nodiscard]] std::uint64_t timings_dropped() const noexcept {
    return segmented_.dropped() + skipped_.dropped();
  }
  [[nodiscard]] const LiveThreadState& receive_state() const noexcept { return receive_state_; }
  [[nodiscard]] const LiveThreadState& segment_state() const noexcept { return segment_state_; }

 private:
  static constexpr std::size_t kLabelSlots = 8;
  static constexpr std::size_t kPointSlots = 2;  // the stream wants the newest, not all

  using Receiver = TurnReceiver<LiveSource, rt::SystemClock, rt::RunQueueWait>;
  using Segmenter = TurnSegmenter<rt::SystemClock, rt::RunQueueWait>;

  void receive() noexcept;
  void receive_turns(Receiver& receiver) noexcept TERRACUT_NONBLOCKING;
  void segment() noexcept;
  void segment_turns(Segmenter& segmenter) noexcept TERRACUT_NONBLOCKING;

  const LiveOptions& options_;
  std::int64_t deadline_ns_, turn_ns_;
  LiveChain& chain_;
  LiveSource& source_;
  Events events_;
  firmware_io::FlightRecorder* recorder_;
  ToldTable told_table_;

  FrameExchange exchange_;
  FrameTimings segmented_, skipped_;

  LatestNearGround near_ground_;

  std::optional<FrameSlots<pipeline::Label>> labels_;
  std::optional<FrameSlots<firmware_io::LabelledPoint>> points_;

  std::atomic<bool> stop_{false};
  rt::LatestValue<Intake> intake_;
  LiveThreadState receive_state_, segment_state_;
  std::jthread receive_thread_, segment_thread_;
};

}  // namespace terracut::cli
