// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Both halves of a live run on one thread: packets come from a made source, and the clock, the
// processor time and the waiting are the test's.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/ground/segmenter.hpp"
#include "pipeline/live/frame_receiver.hpp"
#include "pipeline/live/frame_segmenter.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "tests/firmware_io/hdl64e/random_drive.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::live {
namespace {

using frame::Reject;
using packet::Datagram;
using test::Packet;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000 * kMs;
constexpr std::int64_t kFramePeriod_ns = 100 * kMs;

/// Every time a test's machine has. Each look at the time of day takes a nanosecond, and each look
/// at the processor time `work_ns` of work.
struct HeldTime {
  std::int64_t now_ns = kStart_ns;
  std::int64_t cpu_ns = 0, work_ns = 0;
  std::int64_t waited_ns = 0;

  void work(std::int64_t time_ns) {
    now_ns += time_ns;
    cpu_ns += time_ns;
  }
};
struct HeldClock {
  HeldTime* time;
  [[nodiscard]] std::int64_t realtime_ns() const noexcept { return ++time->now_ns; }
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept { return time->now_ns; }
  [[nodiscard]] std::int64_t thread_cpu_ns() const noexcept {
    time->work(time->work_ns);
    return time->cpu_ns;
  }
};
struct HeldWait {
  HeldTime* time;
  [[nodiscard]] std::int64_t read_ns() const noexcept { return time->waited_ns; }
};

/// Gives the packets that have come by now, and lets time pass for those that were decoded.
class MadeSource {
 public:
  MadeSource(HeldTime& time, const decode::Decoder& decoder) : time_(time), decoder_(decoder) {}

  void add(std::span<const std::uint8_t> payload, std::int64_t stamp_ns) {
    waiting_.push_back({.payload = payload, .stamp_ns = stamp_ns});
  }
  [[nodiscard]] std::int64_t next_ns() const { return waiting_[next_].stamp_ns; }
  [[nodiscard]] bool has_more() const { return next_ < waiting_.size(); }
  /// Of these kinds, as a real source would have counted them.
  void leave_out(std::uint64_t foreign, std::uint64_t truncated) {
    counters_.foreign += foreign;
    counters_.truncated += truncated;
    counters_.received += foreign + truncated;
  }

  std::span<const Datagram> receive(std::int64_t timeout_ns) noexcept {
    const std::uint64_t decoded = decoder_.packets_decoded();
    time_.work(static_cast<std::int64_t>(decoded - std::exchange(decoded_, decoded)) * cost_ns);
    if (timeout_ns == 0 || !has_more()) return {};
    time_.now_ns = std::max(time_.now_ns, waiting_[next_].stamp_ns);
    const std::size_t first = next_;
    while (has_more() && next_ - first < net::kBatchDatagrams &&
           waiting_[next_].stamp_ns <= time_.now_ns)
      ++next_;
    counters_.received += next_ - first;
    counters_.delivered += next_ - first;
    return std::span(waiting_).subspan(first, next_ - first);
  }
  void wake() const noexcept {}
  void refresh_drops() noexcept { counters_.kernel_drops = drops_in_kernel; }
  [[nodiscard]] const net::ReceiveCounters& counters() const noexcept { return counters_; }
  [[nodiscard]] net::LinkState link() const noexcept { return net::LinkState::kUnknown; }

  std::int64_t cost_ns = 0;  ///< Of decoding a packet.
  std::uint64_t drops_in_kernel = 0;

 private:
  HeldTime& time_;
  std::vector<Datagram> waiting_;
  const decode::Decoder& decoder_;
  std::uint64_t decoded_ = 0;
  std::size_t next_ = 0;
  net::ReceiveCounters counters_;
};

class LiveFrames : public testing::Test {
 protected:
  using Receiver = FrameReceiver<MadeSource, HeldClock, HeldWait>;
  using Segmenter = FrameSegmenter<HeldClock, HeldWait>;
  static constexpr std::int64_t kDeadline_ns = 50 * kMs;

  LiveFrames() {
    begin_receiving();
    segmenter_.emplace(kDeadline_ns, chain_, frames_,
                       Segmenter::Outlets{.records = &segmented_,
                                          .labels = &labels_,
                                          .points = nullptr,
                                          .points_ready = nullptr,
                                          .near_ground = &near_ground_},
                       HeldClock{&time_}, HeldWait{&time_});
  }

  void begin_receiving() { receive_gathering(0); }
  void receive_gathering(std::int64_t longest_gathering_ns, std::size_t room_packets = 10'000) {
    receiver_.emplace(Receiver::Config{.deadline_ns = kDeadline_ns,
                                       .gathering = {.frame_period_ns = kFramePeriod_ns,
                                                     .longest_ns = longest_gathering_ns,
                                                     .room_packets = room_packets}},
                      chain_, source_,
                      Receiver::Outlets{.frames = &frames_,
                                        .frame_ready = &*frame_ready_,
                                        .skipped = &skipped_,
                                        .intake = &intake_,
                                        .recorder = &recorder_},
                      HeldClock{&time_}, HeldWait{&time_});
  }

  /// A head that rotates `frames` times, beginning at 0 degrees now.
  std::vector<Packet> drive(int frames, double share_of_returns = 0.05) {
    return test::random_packets({.first_cdeg = 0,
                                 .last_cdeg = 36'000 * frames,
                                 .first_stamp_ns = kStart_ns,
                                 .share_of_returns = share_of_returns});
  }
  /// The source reads packets where they lie, so they are kept.
  void send(std::vector<Packet> packets) {
    sent_.push_back(std::move(packets));
    for (const Packet& packet : sent_.back()) source_.add(packet.bytes, packet.stamp_ns);
  }
  /// Receives all that was sent, and segments each frame as soon as it is there.
  void run() {
    while (source_.has_more()) {
      (void)receiver_->work_round(100 * kMs);
      expect_balance();
      (void)segmenter_->work_round();
      take_records();
    }
    (void)receiver_->work_round(0);
  }
  /// The same up to a time of day; what comes then is left waiting.
  void run_until(std::int64_t end_ns) {
    while (source_.has_more() && source_.next_ns() < end_ns) {
      (void)receiver_->work_round(100 * kMs);
      (void)segmenter_->work_round();
      take_records();
    }
  }
  void take_records() {
    for (status::FrameRecord record; skipped_.take(record) || segmented_.take(record);) {
      records_.push_back(record);
    }
  }
  const status::InputState& intake() {
    (void)intake_.take_if_new();
    return intake_.newest_taken();
  }
  void expect_balance() {
    const net::DatagramAccount& account = intake().account;
    EXPECT_TRUE(account.balances());
    std::uint64_t sum = account.in_doubt;
    for (const status::NamedCount& outcome : status::outcomes_of(account)) sum += outcome.count;
    EXPECT_EQ(sum, account.source.received);
  }
  [[nodiscard]] std::uint64_t rejected(Reject reason) {
    return intake().account.losses.rejected[static_cast<std::size_t>(reason)];
  }
  /// From a frame's last packet to where it was handed over.
  static std::int64_t lag_ns(const status::FrameRecord& record) {
    return record.handed_over_ns - record.info.last_packet_ns;
  }

  HeldTime time_;
  memory::FixedMemory memory_;
  calib::SensorCalibration calibration_ = hdl64e::nominal_hdl64e();
  mount::RingProfile profile_ = calib::ring_profile(calibration_, mount::Mount{});
  static decode::Decoder::Config decoder_config() {
    decode::Decoder::Config config;
    config.columns = 2083;
    config.reorder_packets = 0;
    return config;
  }
  LivePipeline chain_{calibration_, profile_, decoder_config(), {}, memory_};
  std::vector<std::vector<Packet>> sent_;
  MadeSource source_{time_, chain_.decoder};
  FrameExchange frames_{chain_.decoder.buffers()};
  Expected<threads::WakeEvent> frame_ready_ = threads::WakeEvent::make();
  FrameRecords skipped_{memory_}, segmented_{memory_};
  queues::LatestValue<status::InputState> intake_;
  recorder::FlightRecorder recorder_{{.datagrams = 8192, .payload_bytes = 8192 * 1208}, memory_};
  FramePool<frame::Label> labels_{"labels", 4, chain_.decoder.return_capacity(), memory_};
  LatestNearGround near_ground_{memory_};
  std::optional<Receiver> receiver_;
  std::optional<Segmenter> segmenter_;
  std::vector<status::FrameRecord> records_;
};

TEST_F(LiveFrames, EachDatagramIsInExactlyOnePlaceWithOrWithoutFrames) {
  const std::vector<std::uint8_t> too_short(100);
  const auto packets = drive(3);
  for (int i = 0; i < 10; ++i) source_.add(too_short, kStart_ns);
  source_.leave_out(7, 2);
  (void)receiver_->work_round(100 * kMs);
  EXPECT_EQ(rejected(Reject::kWrongSize), 10U) << "shown although no frame came";
  EXPECT_EQ(intake().account.source.received, 19U);
  expect_balance();
  send(packets);
  source_.add(packets.back().bytes, packets.back().stamp_ns);
  run();
  EXPECT_EQ(rejected(Reject::kRepeated), 1U);
  EXPECT_EQ(intake().account.decoded, packets.size());
  EXPECT_EQ(intake().account.source.received, packets.size() + 20);
  expect_balance();
}

TEST_F(LiveFrames, AHeadThatStandsShowsInTheCountsAlthoughNoFrameComes) {
  std::vector<Packet> standing = drive(1);
  for (Packet& packet : standing) {
    for (std::size_t block = 0; block < 12; ++block) packet.set_u16(100 * block + 2, 1234);
  }
  send(standing);
  run();
  EXPECT_TRUE(records_.empty());
  EXPECT_GT(rejected(Reject::kStationary), standing.size() * 9 / 10);
  expect_balance();
}

TEST_F(LiveFrames, ALimitedFieldOfViewIsNamedAndCostsNoDeadline) {
  auto packets = drive(20);
  std::erase_if(packets, [](const Packet& packet) {
    const int rotor_cdeg = packet.bytes[2] + 256 * packet.bytes[3];
    return rotor_cdeg < 9'000 || rotor_cdeg >= 27'000;
  });
  send(packets);
  run();
  EXPECT_NEAR(intake().blind.from_cdeg, 27'000, 105) << "a packet";
  EXPECT_NEAR(intake().blind.to_cdeg, 9'000, 105);
  EXPECT_EQ(intake().account.losses.network_gap_packets, 0U);
  EXPECT_GE(records_.size(), 19U);
  for (const status::FrameRecord& record : records_) {
    // The sector is known after three frames, after five more how packets come to lie beside it.
    if (record.info.number < 9) continue;
    EXPECT_NE(record.level, status::Level::kSkipped) << record.info.number;
  }
}

TEST_F(LiveFrames, CountsWhatTheKernelDroppedLastAtTheEnd) {
  source_.drops_in_kernel = 23'162;
  (void)receiver_->work_round(0);
  EXPECT_EQ(intake().account.losses.kernel_drops, 0U);
  receiver_->finish();
  EXPECT_EQ(intake().account.losses.kernel_drops, 23'162U);
  EXPECT_EQ(intake().account.source.kernel_drops, 23'162U);
}

TEST_F(LiveFrames, WhatCameBeforeTheRunIsCountedApartFromItsAccount) {
  source_.leave_out(7, 2);
  source_.drops_in_kernel = 5;
  begin_receiving();
  EXPECT_EQ(intake().before_labelling, 14U);
  source_.leave_out(1, 0);
  (void)receiver_->work_round(100 * kMs);
  EXPECT_EQ(intake().account.source.received, 1U);
  EXPECT_EQ(intake().account.source.foreign, 1U);
  EXPECT_EQ(intake().account.source.kernel_drops, 0U);
  EXPECT_EQ(intake().before_labelling, 14U);
  expect_balance();
}

TEST_F(LiveFrames, TheRecorderHasEveryDatagramWhateverBecameOfIt) {
  const std::vector<std::uint8_t> too_short(100);
  source_.add(too_short, kStart_ns);
  const auto packets = drive(10);
  send(packets);
  run_until(kStart_ns + 300 * kMs);
  time_.now_ns += 400 * kMs;  // some of what comes now is let go
  run();
  EXPECT_GT(intake().account.let_go, 0U);
  const test::ScratchFolder folder;
  const auto dump = recorder_.dump(folder / "all.pcap", recorder::DumpReason::kAsked, {});
  ASSERT_TRUE(dump) << dump.error().message;
  EXPECT_EQ(dump->datagrams, packets.size() + 1);
}

TEST_F(LiveFrames, FramesThatBreakOffWhereABacklogIsLetGoDoNotCountAsLate) {
  send(drive(8));
  // Labels of a frame whose last packet comes 5 ms after that are 55 ms late.
  const auto stand_still_at_the_end_of = [&](int frame) {
    run_until(kStart_ns + frame * kFramePeriod_ns - 5 * kMs);
    time_.now_ns += 60 * kMs;
    run_until(kStart_ns + frame * kFramePeriod_ns + 70 * kMs);
    return intake().account.let_go;
  };
  stand_still_at_the_end_of(1);
  EXPECT_EQ(stand_still_at_the_end_of(2), 0U);
  const std::uint64_t let_go = stand_still_at_the_end_of(3);
  EXPECT_GT(let_go, 0U) << "three in a row were late";
  EXPECT_EQ(stand_still_at_the_end_of(4), let_go);
  EXPECT_EQ(stand_still_at_the_end_of(5), let_go) << "two since then";
  EXPECT_GT(stand_still_at_the_end_of(6), let_go);
}

TEST_F(LiveFrames, NothingGetsOlderWithTimeUnderAnOverloadThatLasts) {
  const auto packets = drive(60);
  send(packets);
  const std::int64_t period_ns = 6 * 48'000;
  source_.cost_ns = period_ns * 13 / 10;
  run();
  std::int64_t longest_lag_ns = 0;
  for (const status::FrameRecord& record : records_) {
    longest_lag_ns = std::max(longest_lag_ns, lag_ns(record));
  }
  EXPECT_LE(longest_lag_ns, kDeadline_ns + kFramePeriod_ns + 64 * source_.cost_ns) << "and a batch";
  EXPECT_GT(intake().account.let_go, packets.size() / 10);
  EXPECT_EQ(intake().account.losses.network_gap_packets, 0U) << "nothing was lost on the network";
  const auto in_time = std::ranges::count_if(records_, [](const status::FrameRecord& record) {
    return record.level != status::Level::kSkipped &&
           record.labels_ns - record.info.last_packet_ns <= kDeadline_ns;
  });
  EXPECT_GE(in_time, 10) << "and labels are still made, all through it";
  for (const status::FrameRecord& record : records_) {
    if (record.level == status::Level::kSkipped) continue;
    EXPECT_LE(record.labels_ns - record.info.last_packet_ns, kDeadline_ns) << record.info.number;
  }
}

TEST_F(LiveFrames, LetsNothingGoThatMayStillBeLabelledInTimeAfterAStandstill) {
  send(drive(10));
  source_.cost_ns = 10'000;
  while (records_.size() < 3) {
    (void)receiver_->work_round(100 * kMs);
    (void)segmenter_->work_round();
    take_records();
  }
  time_.now_ns += 140 * kMs;  // less than a frame and the deadline
  run();
  EXPECT_EQ(intake().account.let_go, 0U);
}

TEST_F(LiveFrames, IsBackWithTheNextWholeFrameAfterAStandstillOfASecond) {
  const auto packets = drive(20);
  send(packets);
  source_.cost_ns = 10'000;
  while (records_.size() < 3) {
    (void)receiver_->work_round(100 * kMs);
    (void)segmenter_->work_round();
    take_records();
  }
  const std::size_t before = records_.size();
  const std::int64_t back_ns = time_.now_ns += 1000 * kMs;
  run();
  EXPECT_NEAR(static_cast<double>(intake().account.let_go), 850.0 / 1000 * 3472, 30)
      << "what was older than a frame and the deadline";
  EXPECT_EQ(intake().account.losses.network_gap_packets, 0U) << "nothing was lost on the network";
  for (std::size_t i = before; i < records_.size(); ++i) {
    if (records_[i].info.first_packet_ns < back_ns) continue;
    EXPECT_NE(records_[i].level, status::Level::kSkipped) << records_[i].info.number;
  }
  expect_balance();
}

TEST_F(LiveFrames, FramesThatBreakOffCostNoCoarsePassEach) {
  // As many packets as it takes to begin another stream, then the next one, elsewhere and at
  // another time.
  constexpr std::size_t kStreams = 60, kPackets = decode::StreamTracker::kNewStream_packets;
  const std::vector<Packet> ordered = drive(1);
  std::vector<Packet> packets;
  for (std::size_t stream = 0; stream < kStreams; ++stream) {
    const std::size_t first = 20 + stream * 97 % 200;
    for (std::size_t i = 0; i < kPackets; ++i) {
      packets.push_back(ordered[first + i]);
      packets.back().stamp_ns = kStart_ns + static_cast<std::int64_t>(packets.size()) * 288'000;
      packets.back().set_device_stamp_us(
          static_cast<std::uint32_t>((stream * 7'919'000 + i * 288) % 3'600'000'000));
    }
  }
  send(packets);
  int frames = 0, with_coarse_stages = 0;
  while (source_.has_more()) {
    frames += receiver_->work_round(100 * kMs).frames;
    if (const run::Frame* frame = frames_.take_if_new()) {
      with_coarse_stages += frame->record.stages_ahead > 0 ? 1 : 0;
    }
  }
  EXPECT_GE(frames, static_cast<int>(kStreams) - 1) << "the stream breaks off again and again";
  EXPECT_EQ(with_coarse_stages, 0);
}

TEST_F(LiveFrames, CoarseStagesThatWereNotFarEnoughAreDoneByTheSegmentingHalf) {
  // The stream breaks off in the midst of a frame and goes on elsewhere.
  const auto packets = test::random_packets(
      {.first_cdeg = 0, .last_cdeg = 54'000, .first_stamp_ns = kStart_ns, .share_of_returns = 0.2});
  auto later = test::random_packets({.first_cdeg = 3'000,
                                     .last_cdeg = 54'000,
                                     .first_stamp_ns = packets.back().stamp_ns,
                                     .share_of_returns = 0.2});
  for (std::size_t i = 0; i < later.size(); ++i) {
    later[i].set_device_stamp_us(static_cast<std::uint32_t>(i * 288));
  }
  send(packets);
  send(later);
  ground::Segmenter at_once(ground::terracut_profile(), profile_, chain_.decoder.shape(),
                            chain_.decoder.return_capacity(), memory_,
                            chain_.decoder.make_reader(memory_));
  int ahead = 0, late = 0;
  while (source_.has_more()) {
    if (receiver_->work_round(100 * kMs).frames == 0) continue;
    // What the segmenting half is about to label, labelled here first.
    ASSERT_TRUE(segmenter_->work_round());
    FramePool<frame::Label>::Frame frame;
    ASSERT_TRUE(labels_.take(frame));
    (frame.record.stages_ahead > 0 ? ahead : late) += 1;
    const auto returns = std::ranges::find_if(
        chain_.decoder.buffers(), [&](const frame::MeasuredReturns& candidate) {
          return candidate.returns() == frame.record.info.returns;
        });
    ASSERT_NE(returns, chain_.decoder.buffers().end());
    (void)at_once.segment(*returns);
    EXPECT_TRUE(std::ranges::equal(frame.items, at_once.labels())) << frame.record.info.number;
    labels_.give_back(true);
  }
  EXPECT_GT(ahead, 0);
  EXPECT_GE(late, 1);
}

TEST_F(LiveFrames, AFrameIsJudgedByWhenItsLabelsWereHandedOn) {
  send(drive(2));
  run();
  ASSERT_FALSE(records_.empty());
  FramePool<frame::Label>::Frame frame;
  ASSERT_TRUE(labels_.take(frame));
  EXPECT_EQ(frame.record.info.number, records_.front().info.number);
  EXPECT_GT(records_.front().labels_ns, frame.record.labels_ns);
}

TEST_F(LiveFrames, AFrameThatIsTakenLateEndsOnALowerLevel) {
  struct Case {
    std::int64_t left_ns;
    status::Level level;
  };
  send(drive(5));
  for (const Case& late : {Case{30 * kMs, status::Level::kFull},
                           {2 * kMs, status::Level::kCoarse},
                           {-kMs, status::Level::kSkipped}}) {
    while (receiver_->work_round(100 * kMs).frames == 0) {
    }
    take_records();
    time_.now_ns += kDeadline_ns - late.left_ns;
    ASSERT_TRUE(segmenter_->work_round());
    records_.clear();
    for (status::FrameRecord record; segmented_.take(record);) records_.push_back(record);
    ASSERT_EQ(records_.size(), 1U);
    EXPECT_EQ(records_[0].level, late.level) << late.left_ns / kMs << " ms left";
  }
}

TEST_F(LiveFrames, LabelsOfAFrameThatWasTriedAndCameLateAreHandedToNobody) {
  send(drive(12));
  std::vector<std::uint32_t> handed_on, labelled;
  int tried_and_late = 0;
  while (source_.has_more()) {
    (void)receiver_->work_round(100 * kMs);
    time_.work_ns = 26 * kMs;  // labels made and handed on take longer than the deadline
    (void)segmenter_->work_round();
    time_.work_ns = 0;
    for (FramePool<frame::Label>::Frame frame; labels_.take(frame); labels_.give_back(true)) {
      handed_on.push_back(frame.record.info.number);
    }
    for (status::FrameRecord record; segmented_.take(record);) {
      if (record.level != status::Level::kSkipped) labelled.push_back(record.info.number);
      const bool was_tried = record.segment_cpu_ns > kDeadline_ns;
      if (record.level == status::Level::kSkipped && was_tried) ++tried_and_late;
    }
  }
  EXPECT_EQ(handed_on, labelled);
  EXPECT_GT(tried_and_late, 0);
  EXPECT_EQ(labelled.size(), 3U) << "until the cost was known";
}

TEST_F(LiveFrames, WaitingForACoreIsCountedSinceTheFetchBefore) {
  send(drive(6));
  while (source_.has_more()) {
    time_.waited_ns += 1000;
    (void)receiver_->work_round(100 * kMs);
    take_records();  // of frames that nobody segments
  }
  ASSERT_GT(records_.size(), 3U);
  for (const status::FrameRecord& record : records_) EXPECT_EQ(record.run_queue_wait_ns, 1000);
}

TEST_F(LiveFrames, SegmentingAFrameCostsAllItsStagesThoseDoneAheadIncluded) {
  send(drive(6));
  time_.work_ns = 1000;  // each look at the processor time
  int frames = 0;
  while (source_.has_more()) {
    (void)receiver_->work_round(100 * kMs);
    const std::int64_t before_ns = time_.cpu_ns;
    if (!segmenter_->work_round()) continue;
    const std::int64_t spent_ns = time_.cpu_ns - before_ns;
    status::FrameRecord record;
    ASSERT_TRUE(segmented_.take(record));
    EXPECT_GT(record.ahead_cpu_ns, 0);
    EXPECT_GT(record.stages.sum_ns(), record.ahead_cpu_ns);
    EXPECT_GE(record.segment_cpu_ns, record.stages.sum_ns());
    EXPECT_EQ(record.segment_cpu_ns, record.ahead_cpu_ns + spent_ns - 1000)
        << "from the first look";
    ++frames;
  }
  EXPECT_GT(frames, 3);
}

TEST_F(LiveFrames, WaitingOfBothThreadsCounts) {
  send(drive(6));
  std::int64_t waited_at_last_frame_ns = 0;
  int frames = 0;
  while (source_.has_more()) {
    time_.waited_ns += 1000;
    (void)receiver_->work_round(100 * kMs);
    if (!segmenter_->work_round()) continue;
    status::FrameRecord record;
    ASSERT_TRUE(segmented_.take(record));
    const std::int64_t of_segmenter_ns = time_.waited_ns - waited_at_last_frame_ns;
    EXPECT_EQ(record.run_queue_wait_ns, 1000 + of_segmenter_ns) << frames;
    waited_at_last_frame_ns = time_.waited_ns;
    ++frames;
  }
  EXPECT_GT(frames, 3);
}

TEST_F(LiveFrames, TheNearGroundOfEveryFifthFrameIsPassedOn) {
  send(drive(12));
  int passed_on = 0;
  while (source_.has_more()) {
    (void)receiver_->work_round(100 * kMs);
    if (!segmenter_->work_round()) continue;
    status::FrameRecord record;
    ASSERT_TRUE(segmented_.take(record));
    const bool is_there = near_ground_.newest() != nullptr;
    EXPECT_EQ(is_there, record.info.number % 5 == 0) << record.info.number;
    passed_on += is_there ? 1 : 0;
  }
  EXPECT_GE(passed_on, 2);
}

TEST_F(LiveFrames, PacketsGatherAsLongAsToldButNeverPastAFramesEnd) {
  receive_gathering(10 * kMs);
  send(drive(12));
  int fetches = 0;
  while (source_.has_more()) {
    const Receiver::Round round = receiver_->work_round(100 * kMs);
    EXPECT_LE(round.gathering_ns, 10 * kMs);
    time_.now_ns += round.gathering_ns;
    ++fetches;
    (void)segmenter_->work_round();
    take_records();
  }
  ASSERT_GT(records_.size(), 9U);
  EXPECT_LE(fetches, 12 * 20) << "of some 4,200 packets";
  for (const status::FrameRecord& record : records_) {
    EXPECT_LT(lag_ns(record), kMs) << record.info.number;
  }
}

TEST_F(LiveFrames, NoMorePacketsGatherThanFillHalfOfTheKernelsBuffer) {
  constexpr std::size_t kRoom = 40;
  receive_gathering(20 * kMs, kRoom);
  send(drive(6));
  std::uint64_t received = 0, most = 0;
  while (source_.has_more()) {
    time_.now_ns += receiver_->work_round(100 * kMs).gathering_ns;
    most = std::max(
        most, source_.counters().received - std::exchange(received, source_.counters().received));
  }
  EXPECT_LE(most, kRoom / 2 + 2) << "of some 350 packets a frame";
  EXPECT_GE(most, kRoom / 2 - 2);
}

TEST_F(LiveFrames, AFloodOfOthersDatagramsShortensGatheringUntilItIsOver) {
  receive_gathering(20 * kMs);
  send(drive(60));
  std::vector<std::int64_t> longest_ns;  // by frames handed over
  bool flooded = false;
  while (source_.has_more()) {
    const Receiver::Round round = receiver_->work_round(100 * kMs);
    longest_ns.resize(static_cast<std::size_t>(intake().account.decoded) / 347 + 1);
    longest_ns.back() = std::max(longest_ns.back(), round.gathering_ns);
    time_.now_ns += round.gathering_ns;
    if (longest_ns.size() == 10 && !std::exchange(flooded, true)) source_.leave_out(100'000, 0);
  }
  ASSERT_GT(longest_ns.size(), 58U);
  EXPECT_GT(longest_ns[8], 15 * kMs);
  EXPECT_LT(longest_ns[13], 10 * kMs) << "the buffer holds 5,000, and more came within a frame";
  EXPECT_GT(longest_ns[55], 15 * kMs) << "as before";
}

TEST_F(LiveFrames, NothingGathersWhereEachPacketIsWantedAsItComes) {
  receive_gathering(0);
  send(drive(3));
  while (source_.has_more()) EXPECT_EQ(receiver_->work_round(100 * kMs).gathering_ns, 0);
}

TEST_F(LiveFrames, AFullBatchIsFollowedByTheNextAtOnce) {
  receive_gathering(10 * kMs);
  send(drive(3));
  time_.now_ns += 40 * kMs;
  EXPECT_EQ(receiver_->work_round(100 * kMs).gathering_ns, 0);
  EXPECT_EQ(receiver_->work_round(100 * kMs).gathering_ns, 0);
  EXPECT_GT(receiver_->work_round(100 * kMs).gathering_ns, 0) << "none was left waiting";
}

TEST_F(LiveFrames, ABatchThatIsFullOfOthersDatagramsIsFollowedByTheNextAtOnce) {
  receive_gathering(10 * kMs);
  send(drive(3));
  run_until(kStart_ns + 40 * kMs);
  EXPECT_GT(receiver_->work_round(100 * kMs).gathering_ns, 0);
  source_.leave_out(net::kBatchDatagrams - 1, 0);  // one of the sensor's was among them
  EXPECT_EQ(receiver_->work_round(100 * kMs).gathering_ns, 0);
  EXPECT_GT(receiver_->work_round(100 * kMs).gathering_ns, 0);
}

TEST_F(LiveFrames, AHeadThatIsSetToRotateFasterIsNotWaitedForTooLong) {
  receive_gathering(20 * kMs);
  send(test::random_packets({.first_cdeg = 0,
                             .last_cdeg = 36'000 * 12,
                             .step_deg = 4 * 0.1728,
                             .first_stamp_ns = kStart_ns,
                             .share_of_returns = 0.05}));
  while (source_.has_more()) {
    time_.now_ns += receiver_->work_round(100 * kMs).gathering_ns;
    (void)segmenter_->work_round();
    take_records();
  }
  ASSERT_GT(records_.size(), 9U);
  for (std::size_t i = 2; i < records_.size(); ++i) {
    EXPECT_LT(lag_ns(records_[i]), kMs) << records_[i].info.number;
  }
}

TEST_F(LiveFrames, AFrameThatNobodyTookIsGivenUpWhenTheNextOneComes) {
  send(drive(6));
  while (source_.has_more()) (void)receiver_->work_round(100 * kMs);
  take_records();
  ASSERT_GT(records_.size(), 3U);
  for (std::size_t i = 1; i < records_.size(); ++i) {
    EXPECT_EQ(records_[i].level, status::Level::kSkipped);
    EXPECT_GT(records_[i - 1].labels_ns, records_[i].handed_over_ns);
    EXPECT_LT(records_[i - 1].labels_ns, records_[i].handed_over_ns + kMs);
  }
}

TEST_F(LiveFrames, TimesOfAFrameAreItsOwnAndNoOthers) {
  send(drive(22));
  source_.cost_ns = 10'000;
  while (source_.has_more()) {
    time_.waited_ns += 1000;  // before every fetch
    (void)receiver_->work_round(100 * kMs);
    time_.waited_ns += 50;
    (void)segmenter_->work_round();
    take_records();
  }
  ASSERT_GT(records_.size(), 20U);
  for (const std::size_t i : {std::size_t{2}, std::size_t{20}}) {
    const status::FrameRecord& record = records_[i];
    EXPECT_NEAR(static_cast<double>(record.decode_cpu_ns), 347 * 10'000, 20'000) << i;
    EXPECT_GE(record.run_queue_wait_ns, 1000) << i;
    EXPECT_LE(record.run_queue_wait_ns, 1'000'000) << i;
    EXPECT_GE(record.closing_packet_ns, record.info.last_packet_ns) << i;
    EXPECT_LT(record.closing_packet_ns, record.info.last_packet_ns + 2 * kMs) << i;
  }
}

}  // namespace
}  // namespace terracut::live
