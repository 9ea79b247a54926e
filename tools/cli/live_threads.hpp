// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "deadline_ladder.hpp"
#include "firmware_io/live/flight_recorder.hpp"
#include "firmware_io/live/udp_source.hpp"
#include "firmware_io/live/wake_event.hpp"
#include "frame_exchange.hpp"
#include "live_options.hpp"
#include "packet_chain.hpp"
#include "rt/grant.hpp"
#include "rt/latest_value.hpp"
#include "rt/spsc_queue.hpp"

namespace terracut::cli {

/// The two threads of `terracut live` that have a deadline, and the queues through which a third
/// one hears of them. They allocate nothing, lock nothing and write nothing:
///
///   receive  datagrams -> recorder, decoder --FrameExchange--> segment  turns -> labels
///      |                                                          |
///      '-- timings of skipped turns --.      .-- timings, labels -'
///                                     v      v
///                              whoever calls take_timing(), take_labels()
class LiveThreads {
 public:
  struct Labels {
    std::uint32_t number = 0;
    std::span<pipeline::Label> labels;
  };
  /// What a thread says of itself, readable at any time.
  struct Faults {
    std::atomic<std::int64_t> minor{0}, major{0};
  };

  /// Takes all memory from `memory`. `recorder` may be null. Everything must outlive this.
  LiveThreads(const LiveOptions& options, PacketChain& chain, firmware_io::UdpSource& source,
              firmware_io::WakeEvent ready, firmware_io::FlightRecorder* recorder,
              rt::FixedMemory& memory);

  /// Starts both; answers what the system granted and refused them.
  [[nodiscard]] std::vector<rt::Grant> start();
  void stop();

  /// The next judged-to-be frame's times, in no strict order between skipped ones and others.
  [[nodiscard]] bool take_timing(rt::FrameTiming& timing) noexcept {
    return segmented_.try_pop(timing) || skipped_.try_pop(timing);
  }
  /// Labels of the next frame; give_back() before long, or further frames' labels are dropped.
  [[nodiscard]] bool take_labels(Labels& labels) noexcept;
  void give_back() noexcept;

  [[nodiscard]] std::uint64_t packets() const noexcept { return packets_.load(); }
  [[nodiscard]] std::uint64_t kernel_drops() const noexcept { return kernel_drops_.load(); }
  /// Frames whose labels found no room because the one who takes them was too slow.
  [[nodiscard]] std::uint64_t labels_dropped() const noexcept { return labels_dropped_.load(); }
  /// Up to the newest turn that was segmented. From one thread.
  [[nodiscard]] firmware_io::LossCounters losses() noexcept;
  [[nodiscard]] const Faults& receive_faults() const noexcept { return receive_faults_; }
  [[nodiscard]] const Faults& segment_faults() const noexcept { return segment_faults_; }

 private:
  static constexpr std::size_t kTimings = 64;
  static constexpr std::size_t kLabelSlots = 8;

  void receive() noexcept;
  void segment() noexcept;
  void segment_turn(FrameExchange::Turn& turn) noexcept;
  void pass_on_labels(std::uint32_t number) noexcept;

  const LiveOptions& options_;
  PacketChain& chain_;
  firmware_io::UdpSource& source_;
  firmware_io::WakeEvent ready_;  ///< A turn was handed over.
  firmware_io::FlightRecorder* recorder_;

  FrameExchange exchange_;
  DeadlineLadder ladder_;
  StageClock clock_;
  rt::SpscQueue<rt::FrameTiming> segmented_, skipped_;
  rt::LatestValue<firmware_io::LossCounters> losses_;

  struct LabelSlot {
    std::uint32_t number = 0;
    std::size_t count = 0;
    std::span<pipeline::Label> labels;
  };
  std::array<LabelSlot, kLabelSlots> label_slots_;
  rt::SpscQueue<std::uint32_t> full_slots_, free_slots_;
  std::uint32_t taken_slot_ = 0;

  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> packets_{0}, kernel_drops_{0}, labels_dropped_{0};
  Faults receive_faults_, segment_faults_;
  std::jthread receive_thread_, segment_thread_;
};

}  // namespace terracut::cli
