// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A live run without its thread: packets come from a made source, and the clock, the processor time
// and the waiting are the test's.
#include "pipeline/live/live_labeller.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/ground/stream_segmenter.hpp"
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

/// Every time a test's machine has. Each look at the time of day takes a nanosecond, and each part
/// of a stage `stage_ns` of work.
struct HeldTime {
  std::int64_t now_ns = kStart_ns;
  std::int64_t cpu_ns = 0, stage_ns = 0;
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
    time->work(time->stage_ns);
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

ground::SegmenterConfig method_with_heights() {
  ground::SegmenterConfig method = ground::terracut_profile();
  method.gives_heights = true;
  return method;
}

class LiveFrames : public testing::Test {
 protected:
  using Labeller = LiveLabeller<MadeSource, HeldClock, HeldWait>;
  static constexpr std::int64_t kDeadline_ns = 50 * kMs;

  LiveFrames() { begin(); }

  void begin(std::int64_t longest_gathering_ns = 0, std::size_t room_packets = 10'000,
             SectorPool* sectors = nullptr, FramePool<points::LabelledPoint>* points = nullptr) {
    labeller_.emplace(Labeller::Config{.deadline_ns = kDeadline_ns,
                                       .frame_period_ns = kFramePeriod_ns,
                                       .gathering = {.frame_period_ns = kFramePeriod_ns,
                                                     .longest_ns = longest_gathering_ns,
                                                     .room_packets = room_packets}},
                      turns_, source_,
                      Labeller::Outlets{.records = &queue_,
                                        .intake = &intake_,
                                        .labels = &labels_,
                                        .points = points,
                                        .sectors = sectors,
                                        .points_ready = &points_ready_,
                                        .reader = reader_.get(),
                                        .near_ground = &near_ground_,
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
  /// Labels all that was sent.
  void run() {
    while (source_.has_more()) {
      (void)labeller_->work_round(100 * kMs);
      expect_balance();
      take_records();
    }
    (void)labeller_->work_round(0);
    take_records();
  }
  /// The same up to a time of day; what comes then is left waiting.
  void run_until(std::int64_t end_ns) {
    while (source_.has_more() && source_.next_ns() < end_ns) {
      (void)labeller_->work_round(100 * kMs);
      take_records();
    }
  }
  void take_records() {
    for (status::FrameRecord record; queue_.take(record);) records_.push_back(record);
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
  /// From a frame's last packet to its labels.
  static std::int64_t lag_ns(const status::FrameRecord& record) {
    return record.labels_ns - record.info.last_packet_ns;
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
  run::LabelledTurns turns_{calibration_, profile_, decoder_config(),
                            ground::turn_maker_of(method_with_heights()), memory_};
  std::vector<std::vector<Packet>> sent_;
  MadeSource source_{time_, turns_.decoder()};
  FrameRecords queue_{memory_};
  queues::LatestValue<status::InputState> intake_;
  recorder::FlightRecorder recorder_{{.datagrams = 8192, .payload_bytes = 8192 * 1208}, memory_};
  FramePool<frame::Label> labels_{"labels", 4, turns_.decoder().return_capacity(), memory_};
  std::unique_ptr<frame::TileReader> reader_ = turns_.decoder().make_reader(memory_);
  threads::WakeEvent points_ready_ = *threads::WakeEvent::make();
  LatestNearGround near_ground_{memory_};
  std::optional<Labeller> labeller_;
  std::vector<status::FrameRecord> records_;
};

TEST_F(LiveFrames, EachDatagramIsInExactlyOnePlaceWithOrWithoutFrames) {
  const std::vector<std::uint8_t> too_short(100);
  const auto packets = drive(3);
  for (int i = 0; i < 10; ++i) source_.add(too_short, kStart_ns);
  source_.leave_out(7, 2);
  (void)labeller_->work_round(100 * kMs);
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
  (void)labeller_->work_round(0);
  EXPECT_EQ(intake().account.losses.kernel_drops, 0U);
  labeller_->finish();
  EXPECT_EQ(intake().account.losses.kernel_drops, 23'162U);
  EXPECT_EQ(intake().account.source.kernel_drops, 23'162U);
}

TEST_F(LiveFrames, WhatCameBeforeTheRunIsCountedApartFromItsAccount) {
  source_.leave_out(7, 2);
  source_.drops_in_kernel = 5;
  begin();
  EXPECT_EQ(intake().before_labelling, 14U);
  source_.leave_out(1, 0);
  (void)labeller_->work_round(100 * kMs);
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

TEST_F(LiveFrames, OutputsAreToldWhenLabelsWereKnown) {
  FramePool<points::LabelledPoint> points{"points", 4, turns_.decoder().return_capacity(), memory_};
  begin(0, 10'000, nullptr, &points);
  send(drive(3));
  run();
  ASSERT_GE(records_.size(), 2U);
  for (const status::FrameRecord& record : records_) {
    FramePool<frame::Label>::Frame labelled;
    ASSERT_TRUE(labels_.take(labelled));
    EXPECT_GT(labelled.record.labels_ns, record.info.last_packet_ns);
    EXPECT_LE(labelled.record.labels_ns, record.labels_ns);
    labels_.give_back(true);
    FramePool<points::LabelledPoint>::Frame with_points;
    ASSERT_TRUE(points.take(with_points));
    EXPECT_EQ(with_points.record.labels_ns, labelled.record.labels_ns);
    points.give_back(true);
  }
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
}

TEST_F(LiveFrames, LetsNothingGoThatMayStillBeLabelledInTimeAfterAStandstill) {
  send(drive(10));
  source_.cost_ns = 10'000;
  while (records_.size() < 3) {
    (void)labeller_->work_round(100 * kMs);
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
    (void)labeller_->work_round(100 * kMs);
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

TEST_F(LiveFrames, AFrameIsJudgedByWhenItsLabelsWereHandedOn) {
  send(drive(2));
  run();
  ASSERT_FALSE(records_.empty());
  FramePool<frame::Label>::Frame frame;
  ASSERT_TRUE(labels_.take(frame));
  EXPECT_EQ(frame.record.info.number, records_.front().info.number);
  EXPECT_GT(records_.front().labels_ns, frame.record.labels_ns);
}

TEST_F(LiveFrames, WhereLabelsAreLateCellsThatAreUncertainKeepTheirCoarseLabel) {
  send(drive(9, 0.9));
  run_until(kStart_ns + 350 * kMs);
  time_.now_ns += 60 * kMs;  // what came meanwhile is labelled late
  run();
  ASSERT_EQ(records_.size(), 9U);
  for (const status::FrameRecord& record : records_) {
    const bool is_late = record.info.number == 4;
    EXPECT_TRUE(is_late || record.level == status::Level::kFull) << record.info.number;
    EXPECT_EQ(record.segmentation.labelled(), record.info.returns);
  }
  EXPECT_EQ(records_[4].level, status::Level::kCutStopped) << "for some degrees";
}

TEST_F(LiveFrames, TheLastTurnIsLabelledWithoutTheNextWhereThatDoesNotCome) {
  send(test::random_packets({.first_cdeg = 0,
                             .last_cdeg = 36'000 * 2 + 1'500,
                             .first_stamp_ns = kStart_ns,
                             .share_of_returns = 0.05}));
  run();
  ASSERT_EQ(records_.size(), 2U);
  time_.now_ns += kDeadline_ns / 2 - kMs;
  (void)labeller_->work_round(0);
  take_records();
  EXPECT_EQ(records_.size(), 2U) << "there is still time";
  time_.now_ns += 2 * kMs;
  (void)labeller_->work_round(0);
  take_records();
  ASSERT_EQ(records_.size(), 3U);
  EXPECT_LT(lag_ns(records_[2]), kDeadline_ns);
}

TEST_F(LiveFrames, TheLastTurnIsLabelledInTimeWherePacketsComeOnThatAreNotDecoded) {
  send(test::random_packets({.first_cdeg = 0,
                             .last_cdeg = 36'000 * 2 + 1'500,
                             .first_stamp_ns = kStart_ns,
                             .share_of_returns = 0.05}));
  run();
  ASSERT_EQ(records_.size(), 2U);
  const std::vector<std::uint8_t> too_short(100);
  for (int i = 1; i <= 100; ++i) source_.add(too_short, time_.now_ns + i * kMs);
  run();
  ASSERT_EQ(records_.size(), 3U) << "as where a head stands";
  EXPECT_LT(lag_ns(records_[2]), kDeadline_ns);
}

TEST_F(LiveFrames, SectorsPutTogetherAreTheFrameThatFollowsThem) {
  using Points = FramePool<points::LabelledPoint>;
  Points whole_ones("points", 2, turns_.decoder().return_capacity(), memory_,
                    Points::Heights::kKept);
  SectorPool sectors("sectors", 400, 64 * frame::kTileFirings, memory_, SectorPool::Heights::kKept);
  begin(0, 10'000, &sectors, &whole_ones);
  send(drive(4));
  std::vector<std::vector<points::LabelledPoint>> of_frame(5);
  std::vector<std::vector<float>> heights_of_frame(5);
  int before_its_last_packet = 0;
  const auto take_sectors = [&] {
    for (SectorPool::Frame sector; sectors.take(sector); sectors.give_back(true)) {
      const points::SectorRecord& record = sector.record;
      std::vector<points::LabelledPoint>& points = of_frame.at(record.frame);
      EXPECT_EQ(record.first_return, points.size());
      EXPECT_LE(record.first_packet_ns, record.last_packet_ns);
      EXPECT_LT(record.last_packet_ns, record.labels_ns);
      const std::int64_t end_ns = kStart_ns + (record.frame + 1) * kFramePeriod_ns;
      before_its_last_packet += record.labels_ns < end_ns ? 1 : 0;
      points.insert(points.end(), sector.items.begin(), sector.items.end());
      std::vector<float>& heights_m = heights_of_frame.at(record.frame);
      heights_m.insert(heights_m.end(), sector.heights_m.begin(), sector.heights_m.end());
    }
  };
  std::uint32_t frames = 0;
  while (source_.has_more()) {
    (void)labeller_->work_round(100 * kMs);
    take_sectors();
    for (Points::Frame whole; whole_ones.take(whole); whole_ones.give_back(true), ++frames) {
      EXPECT_EQ(whole.record.info.number, frames);
      std::vector<points::LabelledPoint>& points = of_frame.at(frames);
      ASSERT_EQ(points.size(), whole.items.size());
      ASSERT_EQ(whole.heights_m.size(), whole.items.size());
      EXPECT_TRUE(std::ranges::equal(heights_of_frame.at(frames), whole.heights_m));
      for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].time_s = whole.items[i].time_s;  // told with the frame alone
        ASSERT_EQ(points[i], whole.items[i]) << i;
      }
    }
  }
  EXPECT_EQ(frames, 4U);
  EXPECT_GT(before_its_last_packet, 100) << "while the rest was still arriving";
  EXPECT_EQ(sectors.unused(), 0U);
}

TEST_F(LiveFrames, SectorsThatNobodyTakesAreCountedAndCostNoFrame) {
  SectorPool sectors("sectors", 2, 64 * frame::kTileFirings, memory_);
  begin(0, 10'000, &sectors);
  send(drive(3));
  run();
  EXPECT_EQ(sectors.waiting(), 2U);
  EXPECT_GT(sectors.unused(), 200U);
  for (const status::FrameRecord& record : records_) {
    EXPECT_EQ(record.segmentation.labelled(), record.info.returns);
  }
  EXPECT_GE(records_.size(), 2U);
}

TEST_F(LiveFrames, WaitingForACoreIsCountedSinceTheFetchBefore) {
  send(drive(6));
  while (source_.has_more()) {
    time_.waited_ns += 1000;
    (void)labeller_->work_round(100 * kMs);
    take_records();
  }
  ASSERT_GT(records_.size(), 3U);
  for (const status::FrameRecord& record : records_) EXPECT_EQ(record.run_queue_wait_ns, 1000);
}

TEST_F(LiveFrames, TimesOfStagesBeforeAFramesLastPacketAreTold) {
  send(drive(6));
  time_.stage_ns = 1000;
  run();
  ASSERT_GT(records_.size(), 3U);
  for (const status::FrameRecord& record : records_) {
    EXPECT_GT(record.ahead_cpu_ns, 0);
    EXPECT_GT(record.segment_cpu_ns, record.ahead_cpu_ns);
    EXPECT_EQ(record.segment_cpu_ns, record.stages.sum_ns());
  }
}

TEST_F(LiveFrames, TheNearGroundOfEveryFifthFrameIsPassedOn) {
  send(drive(12));
  int passed_on = 0;
  while (source_.has_more()) {
    (void)labeller_->work_round(100 * kMs);
    status::FrameRecord record;
    if (!queue_.take(record)) continue;
    const bool is_there = near_ground_.newest() != nullptr;
    EXPECT_EQ(is_there, record.info.number % 5 == 0) << record.info.number;
    passed_on += is_there ? 1 : 0;
  }
  EXPECT_GE(passed_on, 2);
}

TEST_F(LiveFrames, PacketsGatherAsLongAsTold) {
  begin(2 * kMs);
  send(drive(12));
  int fetches = 0;
  while (source_.has_more()) {
    const Labeller::Round round = labeller_->work_round(100 * kMs);
    EXPECT_LE(round.gathering_ns, 2 * kMs);
    time_.now_ns += round.gathering_ns;
    ++fetches;
    take_records();
  }
  ASSERT_GT(records_.size(), 9U);
  EXPECT_LE(fetches, 12 * 51) << "of some 4,200 packets";
}

TEST_F(LiveFrames, NoMorePacketsGatherThanFillHalfOfTheKernelsBuffer) {
  constexpr std::size_t kRoom = 40;
  begin(20 * kMs, kRoom);
  send(drive(6));
  std::uint64_t received = 0, most = 0;
  while (source_.has_more()) {
    time_.now_ns += labeller_->work_round(100 * kMs).gathering_ns;
    most = std::max(
        most, source_.counters().received - std::exchange(received, source_.counters().received));
  }
  EXPECT_LE(most, kRoom / 2 + 2) << "of some 350 packets a frame";
  EXPECT_GE(most, kRoom / 2 - 2);
}

TEST_F(LiveFrames, AFloodOfOthersDatagramsShortensGatheringUntilItIsOver) {
  begin(20 * kMs);
  send(drive(60));
  std::vector<std::int64_t> longest_ns;  // by frames handed over
  bool flooded = false;
  while (source_.has_more()) {
    const Labeller::Round round = labeller_->work_round(100 * kMs);
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
  begin(0);
  send(drive(3));
  while (source_.has_more()) EXPECT_EQ(labeller_->work_round(100 * kMs).gathering_ns, 0);
}

TEST_F(LiveFrames, AFullBatchIsFollowedByTheNextAtOnce) {
  begin(10 * kMs);
  send(drive(3));
  time_.now_ns += 40 * kMs;
  EXPECT_EQ(labeller_->work_round(100 * kMs).gathering_ns, 0);
  EXPECT_EQ(labeller_->work_round(100 * kMs).gathering_ns, 0);
  EXPECT_GT(labeller_->work_round(100 * kMs).gathering_ns, 0) << "none was left waiting";
}

TEST_F(LiveFrames, ABatchThatIsFullOfOthersDatagramsIsFollowedByTheNextAtOnce) {
  begin(10 * kMs);
  send(drive(3));
  run_until(kStart_ns + 40 * kMs);
  EXPECT_GT(labeller_->work_round(100 * kMs).gathering_ns, 0);
  source_.leave_out(net::kBatchDatagrams - 1, 0);  // one of the sensor's was among them
  EXPECT_EQ(labeller_->work_round(100 * kMs).gathering_ns, 0);
  EXPECT_GT(labeller_->work_round(100 * kMs).gathering_ns, 0);
}

TEST_F(LiveFrames, TimesOfAFrameAreItsOwnAndNoOthers) {
  send(drive(22));
  source_.cost_ns = 10'000;
  while (source_.has_more()) {
    time_.waited_ns += 1000;  // before every fetch
    (void)labeller_->work_round(100 * kMs);
    time_.waited_ns += 50;
    take_records();
  }
  ASSERT_GT(records_.size(), 20U);
  for (const std::size_t i : {std::size_t{2}, std::size_t{20}}) {
    const status::FrameRecord& record = records_[i];
    EXPECT_NEAR(static_cast<double>(record.decode_cpu_ns), 347 * 10'000, 20'000) << i;
    EXPECT_GE(record.run_queue_wait_ns, 1000) << i;
    EXPECT_LE(record.run_queue_wait_ns, 1'000'000) << i;
    EXPECT_GE(record.closing_packet_ns, record.info.last_packet_ns) << i;
    EXPECT_LT(record.closing_packet_ns, record.info.last_packet_ns + 15 * kMs) << i;
  }
}

}  // namespace
}  // namespace terracut::live
