// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "firmware_io/net/datagram_account.hpp"
#include "firmware_io/sensor/told_table.hpp"
#include "pipeline/live/frame_pool.hpp"
#include "pipeline/live/frame_records.hpp"
#include "pipeline/live/gathering_policy.hpp"
#include "pipeline/live/latest_near_ground.hpp"
#include "pipeline/live/packet_gate.hpp"
#include "pipeline/live/sector_pool.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/run/labelled_turns.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "pipeline/status/input_status.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// Takes datagrams and hands on labels before their deadline. One thread, which calls work_round()
/// repeatedly.
///
/// The cost of one packet does not depend on its content (docs/design.md, "Work per packet"). Where
/// this thread is behind, cells that are still uncertain keep their coarse label until it has
/// caught up (CutReport::coarse_by_budget): an overload costs quality for some degrees.
///
/// `Source` is a DatagramSource with refresh_drops(), `Clock` is like measure::SystemClock, and
/// `Wait` is like measure::RunQueueWait.
template <class Source, class Clock, class Wait>
class LiveLabeller {
 public:
  struct Config {
    std::int64_t deadline_ns = 0;      ///< Time from a return's packet to its label.
    std::int64_t frame_period_ns = 0;  ///< Duration of one revolution of the head.
    GatheringPolicy::Config gathering;
  };
  /// Where results go. Everything pointed to must outlive this object; all but `records` and
  /// `intake` may be null.
  struct Outlets {
    FrameRecords* records;
    queues::LatestValue<status::InputState>* intake;
    FramePool<frame::Label>* labels = nullptr;
    FramePool<points::LabelledPoint>* points = nullptr;
    SectorPool* sectors = nullptr;
    /// Needed with `points` or `sectors`, as is `reader`, the sensor's.
    const threads::WakeEvent* points_ready = nullptr;
    frame::TileReader* reader = nullptr;
    LatestNearGround* near_ground = nullptr;
    recorder::FlightRecorder* recorder = nullptr;
    sensor::ToldTable* told_table = nullptr;
  };

  /// Throws away the packets waiting in `source`, which are too old to be labelled. They are
  /// counted as packets from before labelling, not as a loss of the run.
  LiveLabeller(const Config& config, run::LabelledTurns& turns, Source& source,
               const Outlets& outlets, Clock clock, Wait wait) noexcept
      : config_(config),
        turns_(turns),
        source_(source),
        to_(outlets),
        clock_(clock),
        wait_(std::move(wait)),
        stage_clock_(clock),
        gate_(config.deadline_ns, config.frame_period_ns),
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
    watch_near_ground(0);
    publish();
  }

  struct Round {
    int frames = 0;                 ///< Number of frames of which the last labels were handed on.
    std::int64_t gathering_ns = 0;  ///< How long the next packets may gather.
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
    fetched_ns_ = clock_.realtime_ns();
    gate_.begin_batch(more_may_wait);
    frames_ = 0;
    const std::uint64_t decoded = turns_.decoder().packets_decoded();
    for (const packet::Datagram& datagram : datagrams) take(datagram);
    const bool is_quiet = turns_.decoder().packets_decoded() == decoded && !more_may_wait;
    if (is_quiet) close_if_quiet();
    publish();
    return {frames_, more_may_wait ? 0 : gathering_.time_ns()};
  }
  /// Ends the run: counts the datagrams that the kernel dropped since the last count.
  void finish() noexcept TERRACUT_NONBLOCKING {
    source_.refresh_drops();
    publish();
  }

 private:
  /// Ends the loop even if a sender never stops; no kernel buffer holds so many batches.
  static constexpr int kMostBatches = 10'000;

  void take(const packet::Datagram& datagram) noexcept {
    newest_packet_ns_ = datagram.stamp_ns;
    if (to_.recorder != nullptr) to_.recorder->add(datagram);
    if (to_.told_table != nullptr) to_.told_table->add(datagram);
    if (!gate_.lets_in(datagram.stamp_ns, fetched_ns_)) {
      // Otherwise the decoder would count the packets left out here as lost on the network.
      if (!std::exchange(lets_go_, true)) {
        turns_.end_stream();
        work(datagram.stamp_ns);
      }
      ++let_go_;
      return;
    }
    lets_go_ = false;
    const std::uint64_t decoded = turns_.decoder().packets_decoded();
    turns_.push(datagram);
    work(datagram.stamp_ns);
    if (turns_.decoder().packets_decoded() != decoded) {
      newest_decoded_ns_ = datagram.stamp_ns;
      is_closed_ = false;
    }
    if (turns_.decoder().rejected() == frame::Reject::kDeviceInfo) ++device_info_;
  }

  /// A turn's last returns wait for the next turn's first. If these do not come, they are labelled
  /// without, though other datagrams may come: those of a head that stands, or of no sensor.
  void close_if_quiet() noexcept {
    const std::int64_t quiet_ns = fetched_ns_ - newest_decoded_ns_;
    if (quiet_ns < config_.deadline_ns / 2 || std::exchange(is_closed_, true)) return;
    turns_.wait_no_longer();
    work(newest_decoded_ns_);
  }

  /// Works on what was pushed, up to the packet with this stamp.
  void work(std::int64_t packet_ns) noexcept {
    at_work_ns_ = packet_ns;
    // A packet makes labels known for returns of up to an eighth of a turn before it.
    due_ns_ = packet_ns + config_.deadline_ns - config_.frame_period_ns / 8;
    const std::int64_t stages_before_ns = stage_clock_.sum_ns();
    const min_cut::CutBudget budget{min_cut::CutBudget::kDefaultOps,
                                    [](void* labeller) noexcept TERRACUT_NONBLOCKING {
                                      const auto& self =
                                          *static_cast<const LiveLabeller*>(labeller);
                                      return self.clock_.realtime_ns() > self.due_ns_;
                                    },
                                    this};
    while (const frame::Frame* turn = turns_.next(budget, &stage_clock_)) {
      note_labels();
      end_frame(*turn, stages_before_ns);
    }
    note_labels();
  }

  /// Notes how long the returns waited that got their labels now, and hands these on by sectors.
  void note_labels() noexcept {
    const frame::MeasuredReturns* const turn = turns_.method().at_work();
    if (turn == nullptr) return;
    if (std::exchange(noted_turn_, turn->turn()) != turn->turn()) {
      noted_tiles_ = 0;
      waits_ = {};
    }
    const std::size_t labels = turns_.labels().size();
    const std::int64_t now_ns = clock_.realtime_ns();
    const std::size_t first_tile = noted_tiles_;
    for (; noted_tiles_ < turn->tiles() && turn->end_of(noted_tiles_) <= labels; ++noted_tiles_) {
      const frame::MeasuredReturns::Tile& tile = turn->tile(noted_tiles_);
      const double turns =
          static_cast<double>(tile.least) / static_cast<double>(turn->shape().columns);
      waits_.note(turns, now_ns - tile.first_ns);
      waits_.note(turns, now_ns - tile.last_ns);
    }
    if (to_.sectors != nullptr && noted_tiles_ > first_tile) {
      hand_on_sectors(*turn, first_tile, now_ns);
    }
  }

  /// Hands on the returns of the noted tiles from `first_tile` on, each tile as a sector.
  void hand_on_sectors(const frame::MeasuredReturns& turn, std::size_t first_tile,
                       std::int64_t now_ns) noexcept {
    const std::span<const frame::Label> labels = turns_.labels();
    const std::span<const float> heights_m = turns_.heights_m();
    for (std::size_t t = first_tile; t < noted_tiles_; ++t) {
      const frame::MeasuredReturns::Tile& tile = turn.tile(t);
      const std::uint32_t first = tile.first_return[0], returns = turn.end_of(t) - first;
      if (returns == 0) continue;
      to_.sectors->pass_on(
          {next_frame_, first, tile.first_ns, tile.last_ns, now_ns}, returns,
          [&](std::span<points::LabelledPoint> room) noexcept {
            points::pack_labelled_tile(turn, t, *to_.reader, labels.subspan(first, returns), room);
          },
          heights_m.empty() ? heights_m : heights_m.subspan(first, returns));
    }
    to_.points_ready->wake();
  }

  void end_frame(const frame::Frame& turn, std::int64_t stages_before_ns) noexcept {
    status::FrameRecord record;
    record.info = turn.info;
    record.closing_packet_ns = at_work_ns_;
    record.labels_ns = clock_.realtime_ns();
    record.handed_over_ns = fetched_ns_;
    record.segmentation = turns_.report();
    record.level = level_of(record.segmentation);
    record.firing_to_label = waits_;
    record.stages = stage_clock_.take();
    record.segment_cpu_ns = record.stages.sum_ns();
    record.ahead_cpu_ns = std::min(stages_before_ns, record.segment_cpu_ns);
    hand_on(turn, record);
    const std::int64_t now_ns = clock_.thread_cpu_ns();
    record.decode_cpu_ns = std::max<std::int64_t>(
        now_ns - std::exchange(spent_ns_, now_ns) - record.segment_cpu_ns, 0);
    // The frame's closing packet came with this fetch or the previous one.
    record.run_queue_wait_ns = wait_.read_ns() - waited_before_last_fetch_ns_;
    record.labels_ns = clock_.realtime_ns();  // with the work of handing them on
    gathering_.note_frame(turn.info.last_packet_ns, received_);
    if (!lets_go_) gate_.note_frame(turn.info.last_packet_ns, record.labels_ns);
    to_.records->pass_on(record);
    next_frame_ = turn.info.number + 1;
    ++frames_;
  }

  void hand_on(const frame::Frame& turn, const status::FrameRecord& record) noexcept {
    const std::span<const frame::Label> labels = turns_.labels();
    if (to_.labels != nullptr) {
      to_.labels->pass_on(record, labels.size(), [&](std::span<frame::Label> room) noexcept {
        std::copy(labels.begin(), labels.end(), room.begin());
      });
    }
    if (to_.points != nullptr) {
      to_.points->pass_on(
          record, labels.size(),
          [&](std::span<points::LabelledPoint> room) noexcept { pack(turn, labels, room); },
          turns_.heights_m());
      to_.points_ready->wake();
    }
    watch_near_ground(turn.info.number + 1);
  }

  void pack(const frame::Frame& turn, std::span<const frame::Label> labels,
            std::span<points::LabelledPoint> room) noexcept {
    (void)points::pack_labelled_points(
        *turn.returns, turn.motions, *to_.reader, labels, room,
        points::FrameTiming::of(turn.info, turns_.decoder().beam_turns()));
  }

  /// Passes on the near ground of the frame just labelled, if it was watched, and lets that of the
  /// next one be watched, if it is due.
  void watch_near_ground(std::uint32_t next_frame) noexcept {
    if (to_.near_ground == nullptr) return;
    if (is_watched_) to_.near_ground->publish();
    is_watched_ = next_frame % LatestNearGround::kFramesApart == 0;
    turns_.method().watch_near_ground(is_watched_ ? &to_.near_ground->draft() : nullptr);
  }

  static status::Level level_of(const stage::SegmentationReport& report) noexcept {
    if (report.last_stage < stage::Stage::kMinCut) return status::Level::kCoarse;
    return report.cut.coarse_by_budget > 0 ? status::Level::kCutStopped : status::Level::kFull;
  }

  void publish() noexcept {
    const decode::Decoder& decoder = turns_.decoder();
    status::InputState& intake = to_.intake->draft();
    intake.account = {.source = source_.counters(),
                      .let_go = let_go_,
                      .device_info = device_info_,
                      .losses = decoder.losses(),
                      .in_doubt = decoder.packets_kept(),
                      .decoded = decoder.packets_decoded()};
    intake.account.source -= before_;
    intake.account.losses.kernel_drops = intake.account.source.kernel_drops;
    intake.link = source_.link();
    intake.newest_packet_ns = newest_packet_ns_;
    intake.before_labelling = before_.received + before_.kernel_drops;
    intake.blind = decoder.blind();
    (void)to_.intake->publish();
  }

  Config config_;
  run::LabelledTurns& turns_;
  Source& source_;
  Outlets to_;
  Clock clock_;
  Wait wait_;
  run::StageClockOf<Clock> stage_clock_;
  PacketGate gate_;
  GatheringPolicy gathering_;

  net::ReceiveCounters before_;
  std::uint64_t received_ = 0;  ///< Datagrams received up to the newest fetch.
  std::uint64_t let_go_ = 0, device_info_ = 0;
  // Stamps: of the newest packet, of the newest that was decoded, and of the one at work.
  std::int64_t newest_packet_ns_ = 0, newest_decoded_ns_ = 0, at_work_ns_ = 0;
  std::int64_t fetched_ns_ = 0;  ///< When the packets at work were fetched.
  std::int64_t due_ns_ = 0;      ///< When labels that become known now are due.
  // Of the turn that gets its labels:
  std::uint32_t next_frame_ = 0;  ///< The number that its frame will have.
  std::int64_t noted_turn_ = 0;
  std::size_t noted_tiles_ = 0;  ///< Number of tiles of which all labels were noted.
  status::FiringToLabel waits_;
  bool lets_go_ = false;
  bool is_closed_ = false;   ///< No packet was decoded since the newest turn was closed.
  bool is_watched_ = false;  ///< The near ground of the frame at work is watched.
  int frames_ = 0;           ///< Frames of this round.

  std::int64_t spent_ns_;  ///< Processor time at the end of the last frame.
  std::int64_t waited_before_fetch_ns_, waited_before_last_fetch_ns_;
};

}  // namespace terracut::live
