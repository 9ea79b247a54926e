// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

#include "deadline_ladder.hpp"
#include "firmware_io/live/flight_recorder.hpp"
#include "firmware_io/live/wake_event.hpp"
#include "firmware_io/sinks/labelled_turn_wire.hpp"
#include "frame_exchange.hpp"
#include "frame_slots.hpp"
#include "live_chain.hpp"
#include "live_options.hpp"
#include "live_source.hpp"
#include "live_thread_state.hpp"
#include "rt/grant.hpp"
#include "rt/latest_value.hpp"
#include "rt/nonblocking.hpp"
#include "rt/run_queue_wait.hpp"
#include "rt/spsc_queue.hpp"
#include "rt/stolen_time.hpp"

namespace terracut::cli {

/// The two threads of `terracut live` that have a deadline, and the queues through which a third
/// one hears of them. They allocate nothing, lock nothing and write nothing:
///
///   receive  datagrams -> recorder, decoder, --FrameExchange--> segment  turns -> cut, labels
///      |                 coarse stages                             |                |
///      '-- timings of skipped turns --.      .---- timings --------'                | FrameSlots
///                                     v      v                                      v
///                              whoever calls take_timing()       label files, stream of points
class LiveThreads {
 public:
  /// What came in, as of the newest look of the receiving thread.
  struct Intake {
    firmware_io::ReceiveCounters counters;  ///< Since the threads were started.
    firmware_io::LinkState link = firmware_io::LinkState::kUnknown;
    std::int64_t newest_packet_ns = 0;  ///< Kernel's stamp; 0: none yet.
  };

  struct Events {
    firmware_io::WakeEvent turn_ready;    ///< A turn was handed over.
    firmware_io::WakeEvent points_ready;  ///< A turn's labelled points were passed on.
    /// kCapacityExceeded when the process has no descriptor left.
    [[nodiscard]] static Expected<Events> make();
  };

  /// Takes all memory from `memory`. `recorder` may be null. Everything must outlive this.
  LiveThreads(const LiveOptions& options, LiveChain& chain, LiveSource& source, Events events,
              firmware_io::FlightRecorder* recorder, rt::FixedMemory& memory);

  /// Starts both; answers what the system granted and refused them.
  [[nodiscard]] std::vector<rt::Grant> start();
  void stop();

  /// The next judged-to-be frame's times, in no strict order between skipped ones and others.
  [[nodiscard]] bool take_timing(rt::FrameTiming& timing) noexcept {
    return segmented_.try_pop(timing) || skipped_.try_pop(timing);
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

  /// From one thread.
  [[nodiscard]] const Intake& intake() noexcept;
  /// Up to the newest turn that was segmented, with what the kernel dropped. From one thread.
  [[nodiscard]] firmware_io::LossCounters losses() noexcept;
  /// Frames that nobody judged because the one who takes timings was too slow.
  [[nodiscard]] std::uint64_t timings_dropped() const noexcept { return timings_dropped_.load(); }
  [[nodiscard]] const LiveThreadState& receive_state() const noexcept { return receive_state_; }
  [[nodiscard]] const LiveThreadState& segment_state() const noexcept { return segment_state_; }

 private:
  static constexpr std::size_t kTimings = 64;
  static constexpr std::size_t kLabelSlots = 8;
  static constexpr std::size_t kPointSlots = 2;  // the stream wants the newest, not all

  void receive() noexcept;
  void receive_turns(const rt::RunQueueWait& wait) noexcept TERRACUT_NONBLOCKING;
  void segment() noexcept;
  void segment_turns(const rt::RunQueueWait& wait,
                     const Expected<rt::StolenTime>& stolen) noexcept TERRACUT_NONBLOCKING;
  void segment_turn(FrameExchange::Turn& turn) noexcept;
  void pass_on_results(const FrameExchange::Turn& turn) noexcept;
  void pass_on(rt::SpscQueue<rt::FrameTiming>& queue, const rt::FrameTiming& timing) noexcept;

  const LiveOptions& options_;
  LiveChain& chain_;
  LiveSource& source_;
  Events events_;
  firmware_io::FlightRecorder* recorder_;

  FrameExchange exchange_;
  DeadlineLadder ladder_;
  StageClock coarse_clock_;  // receiving thread
  StageClock fine_clock_;    // segmenting thread
  rt::SpscQueue<rt::FrameTiming> segmented_, skipped_;
  rt::LatestValue<firmware_io::LossCounters> losses_;

  std::optional<FrameSlots<pipeline::Label>> labels_;
  std::optional<FrameSlots<firmware_io::LabelledPoint>> points_;

  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> timings_dropped_{0};
  rt::LatestValue<Intake> intake_;
  LiveThreadState receive_state_, segment_state_;
  std::jthread receive_thread_, segment_thread_;
};

}  // namespace terracut::cli
