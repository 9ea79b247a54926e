// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "firmware_io/net/datagram_account.hpp"
#include "firmware_io/sensor/told_table.hpp"
#include "pipeline/live/frame_exchange.hpp"
#include "pipeline/live/frame_records.hpp"
#include "pipeline/live/live_pipeline.hpp"
#include "pipeline/live/packet_gate.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "pipeline/status/input_status.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// The receiving half of a live run: datagrams in, frames handed over, and most of their coarse
/// stages done by then. One thread with a deadline, which calls work_round() again and again.
///
/// What one packet may cost does not depend on what is in it (docs/design.md, "Work per packet"):
/// its decoding; one block of the coarse stages; and where it ends frames, handing them over, of
/// which one at most needs its last sectors labelled. A frame of which less than three quarters
/// were labelled ahead, be it that motion is removed from it, that packets are missing, or that its
/// stream broke off, is left to the segmenting thread.
///
/// `Source`: a DatagramSource with refresh_drops(). `Clock`: as measure::SystemClock. `Wait`: as
/// measure::RunQueueWait.
template <class Source, class Clock, class Wait>
class FrameReceiver {
 public:
  struct Config {
    std::int64_t deadline_ns = 0;      ///< From a frame's last packet to its labels.
    std::int64_t frame_period_ns = 0;  ///< Of one revolution of the head.
    /// How long packets may gather in the kernel's buffer before they are fetched; 0: each is
    /// fetched as it comes.
    std::int64_t longest_gathering_ns = 0;
    /// Packets that the kernel's buffer holds; half of them gather at most.
    std::size_t room_packets = std::numeric_limits<std::uint32_t>::max();
  };
  /// Where things go; all must outlive this. `recorder` and `told_table` may be null.
  struct Outlets {
    FrameExchange* frames;
    const threads::WakeEvent* frame_ready;
    FrameRecords* skipped;
    queues::LatestValue<status::InputState>* intake;
    recorder::FlightRecorder* recorder;
    sensor::ToldTable* told_table = nullptr;
  };

  /// What waits in `source` is too old for a label and no loss of the run: it is thrown away, and
  /// counted with what came before.
  FrameReceiver(const Config& config, LivePipeline& pipeline, Source& source,
                const Outlets& outlets, Clock clock, Wait wait) noexcept
      : config_(config),
        frame_period_ns_(config.frame_period_ns),
        longest_gathering_ns_(longest_gathering_ns(kMostPacketsAFrame)),
        pipeline_(pipeline),
        source_(source),
        to_(outlets),
        clock_(clock),
        wait_(std::move(wait)),
        coarse_clock_(clock),
        gate_(config.deadline_ns, config.frame_period_ns),
        spent_ns_(clock.thread_cpu_ns()),
        waited_before_fetch_ns_(wait_.read_ns()),
        waited_before_last_fetch_ns_(waited_before_fetch_ns_) {
    for (int batch = 0; batch < kMostBatches && !source_.receive(0).empty(); ++batch) {
    }
    source_.refresh_drops();
    before_ = source_.counters();
    received_ = before_.received;
    received_before_frame_ = received_;
    publish();
  }

  struct Round {
    int frames = 0;  ///< Handed over.
    /// The next packets may gather for so long before they are fetched: none is expected by then
    /// that ends a frame.
    std::int64_t gathering_ns = 0;
  };
  /// Waits for datagrams, at most so long, and takes them in.
  Round work_round(std::int64_t timeout_ns) noexcept TERRACUT_NONBLOCKING {
    waited_before_last_fetch_ns_ = waited_before_fetch_ns_;
    waited_before_fetch_ns_ = wait_.read_ns();
    const std::span<const packet::Datagram> datagrams = source_.receive(timeout_ns);
    // Others' datagrams fill a batch as well, and are not among those returned.
    const std::uint64_t received = source_.counters().received;
    const bool more_may_wait =
        received - std::exchange(received_, received) >= net::kBatchDatagrams;
    const std::int64_t now_ns = clock_.realtime_ns();
    gate_.begin_batch(more_may_wait);
    frames_ = 0;
    for (std::size_t i = 0; i < datagrams.size(); ++i) take(datagrams[i], now_ns);
    publish();
    return {frames_, more_may_wait ? 0 : gathering_ns()};
  }
  /// The run is over: counts what the kernel dropped last.
  void finish() noexcept TERRACUT_NONBLOCKING {
    source_.refresh_drops();
    publish();
  }

 private:
  /// Packets are fetched as they come in the last fiftieth of a frame: a gathering ends that much
  /// sooner than its last packet comes, so that a thread which wakes up late is still in time.
  static constexpr float kFetchedAsTheyCome = 0.02F;
  static constexpr std::int64_t kWorthwhileGathering_ns = 300'000;
  /// A VLS-128's in dual return, at 10 Hz.
  static constexpr std::uint64_t kMostPacketsAFrame = 1875;
  /// More than any buffer holds: who sends without end holds up nothing.
  static constexpr int kMostBatches = 10'000;
  /// At least eight times what a packet brings, so that the coarse stages catch up.
  static constexpr int kBlocksAPacket = 1;
  static constexpr float kEnoughAhead = 0.75F;

  /// Waking up for every packet costs more than decoding it. The kernel's buffer stamps packets and
  /// holds a thousand times as many as gather here.
  [[nodiscard]] std::int64_t gathering_ns() const noexcept {
    const auto left_ns = static_cast<std::int64_t>((share_to_come_ - kFetchedAsTheyCome) *
                                                   static_cast<float>(frame_period_ns_));
    const std::int64_t time_ns = std::min(left_ns, longest_gathering_ns_);
    return time_ns < kWorthwhileGathering_ns ? 0 : time_ns;
  }

  void take(const packet::Datagram& datagram, std::int64_t now_ns) noexcept {
    newest_packet_ns_ = datagram.stamp_ns;
    if (to_.recorder != nullptr) to_.recorder->add(datagram);
    if (to_.told_table != nullptr) to_.told_table->add(datagram);
    if (!gate_.lets_in(datagram.stamp_ns, now_ns)) {
      // The decoder is told, or would take what is left out here for lost on the network.
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
    share_to_come_ = arriving.image == nullptr ? 1 : arriving.share_to_come;
    if (arriving.image == nullptr) return;
    pipeline_.coarse.advance(*arriving.image, arriving.complete_columns,
                             pipeline_.planes_of(*arriving.image), &coarse_clock_, kBlocksAPacket);
  }

  void hand_over_frames() noexcept {
    frame::RangeImage* in_exchange = nullptr;
    while (const frame::Frame* frame = pipeline_.decoder.next(in_exchange)) {
      in_exchange = hand_over(frame->info, *frame->image);
    }
  }

  frame::RangeImage* hand_over(const frame::FrameInfo& info,
                               frame::RangeImage& image) noexcept TERRACUT_NONBLOCKING {
    const bool has_coarse_stages = pipeline_.coarse.share_ahead(image) >= kEnoughAhead;
    if (has_coarse_stages) {
      pipeline_.coarse.finish(image, pipeline_.planes_of(image), &coarse_clock_);
    }
    run::Frame frame{&image, record_of(info)};
    frame.record.stages_ahead = has_coarse_stages ? kCoarseStages : std::uint8_t{0};
    note_period(info.last_packet_ns);
    if (!lets_go_) gate_.note_frame(info.last_packet_ns, frame.record.handed_over_ns);
    frame::RangeImage* next = to_.frames->hand_over(frame, [this](run::Frame& skipped) noexcept {
      skipped.record.level = status::Level::kSkipped;
      skipped.record.labels_ns = clock_.realtime_ns();
      to_.skipped->pass_on(skipped.record);
    });
    to_.frame_ready->wake();
    ++frames_;
    return next;
  }

  /// A head that was set to rotate faster must not be waited for too long; a frame that was lost
  /// looks as if it rotated slower.
  void note_period(std::int64_t last_packet_ns) noexcept {
    const std::int64_t period_ns = last_packet_ns - std::exchange(last_packet_ns_, last_packet_ns);
    frame_period_ns_ = std::clamp<std::int64_t>(period_ns, 0, config_.frame_period_ns);
    const std::uint64_t packets = received_ - std::exchange(received_before_frame_, received_);
    if (period_ns == last_packet_ns) return;  // the first frame, which may have begun anywhere
    // A flood shortens gathering at once, and no longer than some seconds after its end.
    many_packets_a_frame_ = std::max(many_packets_a_frame_ - many_packets_a_frame_ / 16, packets);
    longest_gathering_ns_ = longest_gathering_ns(many_packets_a_frame_);
  }

  /// So that the kernel's buffer is half full at most where a frame has so many packets.
  [[nodiscard]] std::int64_t longest_gathering_ns(std::uint64_t packets_a_frame) const noexcept {
    const double share_of_frame = static_cast<double>(config_.room_packets / 2) /
                                  static_cast<double>(std::max<std::uint64_t>(packets_a_frame, 1));
    const double half_full_ns = share_of_frame * static_cast<double>(frame_period_ns_);
    return static_cast<std::int64_t>(
        std::min(static_cast<double>(config_.longest_gathering_ns), half_full_ns));
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
    // The frame's last packet came with this fetch or the one before.
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

  Config config_;
  std::int64_t frame_period_ns_;       ///< The newest frame's, or less.
  std::int64_t longest_gathering_ns_;  ///< As long as a frame's packets leave room.
  LivePipeline& pipeline_;
  Source& source_;
  Outlets to_;
  Clock clock_;
  Wait wait_;
  run::StageClockOf<Clock> coarse_clock_;
  PacketGate gate_;

  net::ReceiveCounters before_;
  std::uint64_t received_ = 0;               ///< By the source, up to the newest fetch.
  std::uint64_t received_before_frame_ = 0;  ///< Up to the one that ended the frame before.
  /// As many as the newest frames had at most, others' datagrams included: they fill the kernel's
  /// buffer as well.
  std::uint64_t many_packets_a_frame_ = 0;
  std::uint64_t let_go_ = 0, device_info_ = 0;
  std::int64_t newest_packet_ns_ = 0;
  bool lets_go_ = false;
  int frames_ = 0;                   ///< Handed over in this round.
  float share_to_come_ = 1;          ///< Of the frame that is arriving, or of none yet.
  std::int64_t last_packet_ns_ = 0;  ///< Of the newest frame handed over.

  std::int64_t spent_ns_;  ///< Processor time, up to the last hand-over.
  std::int64_t waited_before_fetch_ns_, waited_before_last_fetch_ns_;
};

}  // namespace terracut::live
