// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "firmware_io/net/datagram_account.hpp"
#include "firmware_io/sensor/told_table.hpp"
#include "pipeline/live/frame_exchange.hpp"
#include "pipeline/live/frame_records.hpp"
#include "pipeline/live/gathering_policy.hpp"
#include "pipeline/live/live_pipeline.hpp"
#include "pipeline/live/packet_gate.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "pipeline/status/input_status.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// The receiving half of a live run: takes datagrams and hands over frames with most of their
/// coarse stages done. One thread with a deadline, which calls work_round() repeatedly.
///
/// The cost of one packet does not depend on its content (docs/design.md, "Work per packet"): it is
/// decoded, one block of the coarse stages is done, and the frames that it ends are handed over; at
/// most one of these still needs its first and last sectors labelled. A frame with less than half
/// of its sectors labelled ahead (packets lost, stream broken off, or few sectors in all) is left
/// to the segmenting thread.
///
/// `Source` is a DatagramSource with refresh_drops(), `Clock` is like measure::SystemClock, and
/// `Wait` is like measure::RunQueueWait.
template <class Source, class Clock, class Wait>
class FrameReceiver {
 public:
  struct Config {
    std::int64_t deadline_ns = 0;  ///< Time from a frame's last packet to its labels.
    GatheringPolicy::Config gathering;
  };
  /// Where results go. Everything pointed to must outlive this object; `recorder` and `told_table`
  /// may be null.
  struct Outlets {
    FrameExchange* frames;
    const threads::WakeEvent* frame_ready;
    FrameRecords* skipped;
    queues::LatestValue<status::InputState>* intake;
    recorder::FlightRecorder* recorder;
    sensor::ToldTable* told_table = nullptr;
  };

  /// Throws away the packets waiting in `source`, which are too old to be labelled. They are
  /// counted as packets from before labelling, not as a loss of the run.
  FrameReceiver(const Config& config, LivePipeline& pipeline, Source& source,
                const Outlets& outlets, Clock clock, Wait wait) noexcept
      : pipeline_(pipeline),
        source_(source),
        to_(outlets),
        clock_(clock),
        wait_(std::move(wait)),
        coarse_clock_(clock),
        gate_(config.deadline_ns, config.gathering.frame_period_ns),
        gathering_(config.gathering),
        spent_ns_(clock.thread_cpu_ns()),
        waited_before_fetch_ns_(wait_.read_ns()),
        waited_before_last_fetch_ns_(waited_before_fetch_ns_) {
    for (int batch = 0; batch < kMostBatches && !source_.receive(0).empty(); ++batch) {
    }
    source_.refresh_drops();
    before_ = source_.counters();
    received_ = before_.received;
    gathering_.begin(received_);
    publish();
  }

  struct Round {
    int frames = 0;  ///< Number of frames handed over.
    /// How long the next packets may gather: during this time no packet is due that ends a frame.
    std::int64_t gathering_ns = 0;
  };
  /// Waits at most `timeout_ns` for datagrams and processes those that came.
  Round work_round(std::int64_t timeout_ns) noexcept TERRACUT_NONBLOCKING {
    waited_before_last_fetch_ns_ = waited_before_fetch_ns_;
    waited_before_fetch_ns_ = wait_.read_ns();
    const std::span<const packet::Datagram> datagrams = source_.receive(timeout_ns);
    // Counts received datagrams, not delivered ones: those of other senders also fill a batch.
    const std::uint64_t received = source_.counters().received;
    const bool more_may_wait =
        received - std::exchange(received_, received) >= net::kBatchDatagrams;
    const std::int64_t now_ns = clock_.realtime_ns();
    gate_.begin_batch(more_may_wait);
    frames_ = 0;
    for (std::size_t i = 0; i < datagrams.size(); ++i) take(datagrams[i], now_ns);
    publish();
    return {frames_, more_may_wait ? 0 : gathering_.time_ns(share_to_come_)};
  }
  /// Ends the run: counts the datagrams that the kernel dropped since the last count.
  void finish() noexcept TERRACUT_NONBLOCKING {
    source_.refresh_drops();
    publish();
  }

 private:
  /// Ends the loop even if a sender never stops; no kernel buffer holds so many batches.
  static constexpr int kMostBatches = 10'000;
  /// A block has at least eight times as many columns as a packet, so the coarse stages catch up.
  static constexpr int kBlocksAPacket = 1;
  static constexpr float kEnoughAhead = 0.5F;

  void take(const packet::Datagram& datagram, std::int64_t now_ns) noexcept {
    newest_packet_ns_ = datagram.stamp_ns;
    if (to_.recorder != nullptr) to_.recorder->add(datagram);
    if (to_.told_table != nullptr) to_.told_table->add(datagram);
    if (!gate_.lets_in(datagram.stamp_ns, now_ns)) {
      // Otherwise the decoder would count the packets left out here as lost on the network.
      if (!std::exchange(lets_go_, true)) {
        pipeline_.decoder.end_stream();
        hand_over_frames();
      }
      ++let_go_;
      return;
    }
    lets_go_ = false;
    pipeline_.decoder.push(datagram);
    hand_over_frames();
    if (pipeline_.decoder.rejected() == frame::Reject::kDeviceInfo) ++device_info_;
    const frame::ArrivingFrame arriving = pipeline_.decoder.arriving();
    share_to_come_ = arriving.returns == nullptr ? 1 : arriving.share_to_come;
    if (arriving.returns == nullptr) return;
    pipeline_.coarse.advance(*arriving.returns, arriving.complete_columns,
                             pipeline_.planes_of(*arriving.returns), &coarse_clock_,
                             kBlocksAPacket);
  }

  void hand_over_frames() noexcept {
    frame::MeasuredReturns* in_exchange = nullptr;
    while (const frame::Frame* frame = pipeline_.decoder.next(in_exchange)) {
      in_exchange = hand_over(*frame);
    }
  }

  frame::MeasuredReturns* hand_over(const frame::Frame& decoded) noexcept TERRACUT_NONBLOCKING {
    frame::MeasuredReturns& returns = *decoded.returns;
    const bool has_coarse_stages = pipeline_.coarse.share_ahead(returns) >= kEnoughAhead;
    if (has_coarse_stages) {
      pipeline_.coarse.finish(returns, pipeline_.planes_of(returns), &coarse_clock_);
    }
    run::Frame frame{&returns, decoded.motions, nullptr, record_of(decoded.info)};
    frame.record.stages_ahead = has_coarse_stages ? kCoarseStages : std::uint8_t{0};
    gathering_.note_frame(decoded.info.last_packet_ns, received_);
    if (!lets_go_) gate_.note_frame(decoded.info.last_packet_ns, frame.record.handed_over_ns);
    frame::MeasuredReturns* next =
        to_.frames->hand_over(frame, [this](run::Frame& skipped) noexcept {
          skipped.record.level = status::Level::kSkipped;
          skipped.record.labels_ns = clock_.realtime_ns();
          to_.skipped->pass_on(skipped.record);
        });
    to_.frame_ready->wake();
    ++frames_;
    return next;
  }

  [[nodiscard]] status::FrameRecord record_of(const frame::FrameInfo& info) noexcept
      TERRACUT_NONBLOCKING {
    status::FrameRecord record;
    record.info = info;
    record.closing_packet_ns = newest_packet_ns_;
    record.stages = coarse_clock_.take();
    record.segment_cpu_ns = record.ahead_cpu_ns = record.stages.sum_ns();
    const std::int64_t now_ns = clock_.thread_cpu_ns();
    record.decode_cpu_ns = now_ns - std::exchange(spent_ns_, now_ns) - record.segment_cpu_ns;
    // The frame's last packet came with this fetch or the previous one.
    record.run_queue_wait_ns = wait_.read_ns() - waited_before_last_fetch_ns_;
    record.handed_over_ns = clock_.realtime_ns();
    return record;
  }

  void publish() noexcept {
    status::InputState& intake = to_.intake->draft();
    intake.account = {.source = source_.counters(),
                      .let_go = let_go_,
                      .device_info = device_info_,
                      .losses = pipeline_.decoder.losses(),
                      .in_doubt = pipeline_.decoder.packets_kept(),
                      .decoded = pipeline_.decoder.packets_decoded()};
    intake.account.source -= before_;
    intake.account.losses.kernel_drops = intake.account.source.kernel_drops;
    intake.link = source_.link();
    intake.newest_packet_ns = newest_packet_ns_;
    intake.before_labelling = before_.received + before_.kernel_drops;
    intake.blind = pipeline_.decoder.blind();
    (void)to_.intake->publish();
  }

  static constexpr auto kCoarseStages = static_cast<std::uint8_t>(stage::Stage::kSeeds);

  LivePipeline& pipeline_;
  Source& source_;
  Outlets to_;
  Clock clock_;
  Wait wait_;
  run::StageClockOf<Clock> coarse_clock_;
  PacketGate gate_;
  GatheringPolicy gathering_;

  net::ReceiveCounters before_;
  std::uint64_t received_ = 0;  ///< Datagrams received up to the newest fetch.
  std::uint64_t let_go_ = 0, device_info_ = 0;
  std::int64_t newest_packet_ns_ = 0;
  bool lets_go_ = false;
  int frames_ = 0;           ///< Frames handed over in this round.
  float share_to_come_ = 1;  ///< Share of the arriving frame to come; 1 if there is none.

  std::int64_t spent_ns_;  ///< Processor time at the last hand-over.
  std::int64_t waited_before_fetch_ns_, waited_before_last_fetch_ns_;
};

}  // namespace terracut::live
