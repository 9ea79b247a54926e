// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/recorder/flight_recorder.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <thread>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "tests/firmware_io/hdl64e/random_drive.hpp"
#include "tests/firmware_io/ruby128/random_stream.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_disk.hpp"

namespace terracut::test {
namespace {

namespace fs = std::filesystem;
using net::PacketRingSize;
using packet::Datagram;
using recorder::DumpFrames;
using recorder::DumpLimits;
using recorder::DumpPolicy;
using recorder::DumpReason;
using recorder::DumpRefusal;
using recorder::DumpReport;
using recorder::FlightRecorder;

/// All datagrams of a capture, with their bytes.
struct Replay {
  explicit Replay(const fs::path& path) {
    auto source = capture::CaptureSource::open(path);
    if (!source) throw std::runtime_error(source.error().message);
    for (auto next = source->next(); next && *next; next = source->next()) {
      bytes.emplace_back((*next)->payload.begin(), (*next)->payload.end());
      datagrams.push_back(**next);
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) datagrams[i].payload = bytes[i];
  }
  std::vector<std::vector<std::uint8_t>> bytes;
  std::vector<Datagram> datagrams;
};

/// Every frame of a stream, decoded as it comes.
template <class Decoder, class Calibration>
std::vector<Frame> frames_of(const std::vector<Datagram>& datagrams, const Calibration& calibration,
                             std::size_t& rejected) {
  memory::FixedMemory memory;
  Decoder decoder(calibration, {}, {}, memory);
  std::vector<Frame> frames;
  const auto keep = [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
    frames.push_back(copy_of(info, image));
  };
  for (const Datagram& datagram : datagrams)
    rejected += test::decode(decoder, datagram, keep).has_value();
  test::end_stream(decoder, keep);
  return frames;
}

void expect_same_image(const Frame& live, const Frame& replayed) {
  EXPECT_EQ(live.info.last_packet_ns, replayed.info.last_packet_ns);
  ASSERT_EQ(live.returns.size(), replayed.returns.size());
  for (std::size_t i = 0; i < live.returns.size(); ++i) {
    const Frame::Placed &a = live.returns[i], &b = replayed.returns[i];
    ASSERT_TRUE(a.row == b.row && a.column == b.column && a.overflow == b.overflow) << i;
    ASSERT_EQ(std::memcmp(&a.point.x_m, &b.point.x_m, sizeof(float)), 0) << i;
    ASSERT_EQ(std::memcmp(&a.point.y_m, &b.point.y_m, sizeof(float)), 0) << i;
    ASSERT_EQ(std::memcmp(&a.point.z_m, &b.point.z_m, sizeof(float)), 0) << i;
    ASSERT_EQ(a.point.intensity, b.point.intensity) << i;
  }
}

class FlightRecorderTest : public test::InScratchFolder {
 protected:
  [[nodiscard]] DumpLimits limits() const {
    DumpLimits limits;
    limits.folder.folder = folder_;
    limits.folder.least_free_bytes = 0;
    limits.asked = {.interval_s = 1e6, .burst = 100};
    return limits;
  }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
  static nlohmann::json json_of(const fs::path& path) {
    std::ifstream file(path);
    return nlohmann::json::parse(file);
  }
  /// `count` numbered datagrams of 1206 bytes, a millisecond apart.
  static void add(FlightRecorder& recorder, std::int64_t first, std::int64_t count) {
    std::array<std::uint8_t, 1206> payload{};
    for (std::int64_t n = first; n < first + count; ++n) {
      std::memcpy(payload.data(), &n, sizeof n);
      std::memcpy(payload.data() + payload.size() - sizeof n, &n, sizeof n);
      recorder.add({.payload = payload,
                    .stamp_ns = n * 1'000'000,
                    .source_address = 0xC0A80001,
                    .destination_address = 0xC0A800FF,
                    .source_port = 2368,
                    .destination_port = 2369});
    }
  }

  /// Frames that the recorder still holds in whole are decoded from its dump as they were live.
  template <class Decoder, class Calibration>
  void expect_same_frames(const std::vector<Datagram>& datagrams, const Calibration& calibration) {
    const PacketRingSize size{datagrams.size() * 3 / 5, datagrams.size() * 3 / 5 * 1248};
    FlightRecorder recorder(size, memory_);
    for (const Datagram& datagram : datagrams) recorder.add(datagram);
    std::size_t rejected = 0;
    const auto live = frames_of<Decoder>(datagrams, calibration, rejected);

    std::vector<status::FrameRecord> times;
    for (const Frame& frame : live) {
      status::FrameRecord& timing = times.emplace_back();
      timing.info = frame.info;
    }
    const auto report =
        recorder.dump(folder_ / "dump.pcap", DumpReason::kMissedDeadline, {times, {}});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_GT(report->datagrams, 0U);
    EXPECT_LT(report->datagrams, datagrams.size());

    const Replay replay(report->capture);
    ASSERT_EQ(replay.datagrams.size(), report->datagrams);
    const auto replayed = frames_of<Decoder>(replay.datagrams, calibration, rejected);
    EXPECT_EQ(rejected, 0U);
    const nlohmann::json json = json_of(report->frame_times);
    std::size_t compared = 0;
    for (const auto& entry : json["frames"]) {
      if (!entry["whole"]) continue;
      const Frame& frame = live.at(entry["number"]);
      if (!frame.info.complete) continue;  // the last frame breaks off
      const auto same = std::find_if(replayed.begin(), replayed.end(), [&](const Frame& candidate) {
        return candidate.info.last_packet_ns == entry["last_packet_ns"];
      });
      ASSERT_NE(same, replayed.end()) << entry;
      EXPECT_TRUE(same->info.complete);
      expect_same_image(frame, *same);
      ++compared;
    }
    EXPECT_GE(compared, 2U) << json;
  }
  memory::FixedMemory memory_;
};

TEST_F(FlightRecorderTest, ReplayingADumpOfAnHdl64eGivesTheFramesThatWereDecodedLive) {
  const auto packets = random_packets(DriveSettings{.last_cdeg = 37'100 + 6 * 36'000});
  std::vector<Datagram> datagrams;
  for (const Packet& packet : packets) datagrams.push_back(packet.datagram());
  expect_same_frames<decode::Decoder>(datagrams, hdl64e::nominal_hdl64e());
}

TEST_F(FlightRecorderTest, ReplayingADumpOfARuby128GivesTheFramesThatWereDecodedLive) {
  const auto packets = random_packets(RubyStream{.last_cdeg = 34'000 + 6 * 36'000});
  std::vector<Datagram> datagrams;
  for (const RubyPacket& packet : packets) datagrams.push_back(packet.datagram());
  expect_same_frames<decode::Decoder>(datagrams, ruby128::nominal_ruby128());
}

TEST_F(FlightRecorderTest, KeepsAddressesPortsStampsAndBytes) {
  FlightRecorder recorder({10, 12080}, memory_);
  add(recorder, 100, 25);
  const auto report = recorder.dump(folder_ / "dump.pcap", DumpReason::kAsked, {});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->datagrams, 10U);
  EXPECT_EQ(report->overwritten, 0U);
  EXPECT_EQ(report->first_stamp_ns, 115'000'000);
  EXPECT_EQ(report->last_stamp_ns, 124'000'000);
  const Replay replay(report->capture);
  ASSERT_EQ(replay.datagrams.size(), 10U);
  for (std::int64_t i = 0; i < 10; ++i) {
    const Datagram& datagram = replay.datagrams[static_cast<std::size_t>(i)];
    std::int64_t number = 0;
    ASSERT_EQ(datagram.payload.size(), 1206U);
    std::memcpy(&number, datagram.payload.data(), sizeof number);
    EXPECT_EQ(number, 115 + i);
    EXPECT_EQ(datagram.stamp_ns, (115 + i) * 1'000'000);
    EXPECT_EQ(datagram.source_address, 0xC0A80001);
    EXPECT_EQ(datagram.destination_address, 0xC0A800FF);
    EXPECT_EQ(datagram.source_port, 2368);
    EXPECT_EQ(datagram.destination_port, 2369);
  }
}

TEST_F(FlightRecorderTest, WritesTheTimesOfTheCapturesFramesBesideIt) {
  FlightRecorder recorder({100, 120800}, memory_);
  add(recorder, 1000, 100);  // 1.000 s to 1.099 s
  std::array<status::FrameRecord, 3> times{};
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i].info.number = static_cast<std::uint32_t>(40 + i);
    times[i].info.first_packet_ns = 950'000'000 + static_cast<std::int64_t>(i) * 60'000'000;
    times[i].info.last_packet_ns = times[i].info.first_packet_ns + 60'000'000;
  }
  times[1].labels_ns = 1'155'000'000;
  times[1].missed = true;
  times[1].cause = status::FrameMissCause::kStolenTime;
  times[1].info.deskew.state = frame::DeskewState::kNoEgoMotion;
  times[1].level = status::Level::kCoarse;
  times[1].stages.stage_ns = {11, 22, 33};
  times[1].segmentation.cut.persistency_ops = 9'223'372'036'854'775'807;
  constexpr std::array<std::string_view, 2> kStages{"elevation_map", "adjacent_points"};
  const auto report =
      recorder.dump(folder_ / "dump.pcap", DumpReason::kMissedDeadline, {times, kStages});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->frame_times, folder_ / "dump.frames.json");

  const nlohmann::json json = json_of(report->frame_times);
  EXPECT_EQ(json["reason"], "missed_deadline");
  EXPECT_EQ(json["datagrams"], 100);
  EXPECT_EQ(json["overwritten"], 0);
  EXPECT_EQ(json["first_stamp_ns"], 1'000'000'000);
  EXPECT_EQ(json["last_stamp_ns"], 1'099'000'000);
  ASSERT_EQ(json["frames"].size(), 2U) << "the third ended after the capture";
  EXPECT_EQ(json["frames"][0]["number"], 40);
  EXPECT_EQ(json["frames"][0]["whole"], false) << "it began before the capture";
  EXPECT_FALSE(json["frames"][0].contains("cause"));
  const nlohmann::json& frame = json["frames"][1];
  EXPECT_EQ(frame["number"], 41);
  EXPECT_EQ(frame["whole"], true);
  EXPECT_EQ(frame["missed"], true);
  EXPECT_EQ(frame["cause"], "stolen_time");
  EXPECT_EQ(frame["motion"], "no_ego_motion");
  EXPECT_EQ(frame["level"], "coarse");
  EXPECT_EQ(frame["labels_ns"], 1'155'000'000);
  EXPECT_EQ(frame["cut_operations"], 9'223'372'036'854'775'807);
  EXPECT_EQ(frame["stage_cpu_ns"],
            nlohmann::json({{"elevation_map", 11}, {"adjacent_points", 22}}));
}

TEST_F(FlightRecorderTest, LeavesOutWhatAPcapCannotHoldAndCountsIt) {
  FlightRecorder recorder({10, 12080}, memory_);
  add(recorder, -1, 3);
  const auto report = recorder.dump(folder_ / "dump.pcap", DumpReason::kAsked, {});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->unwritable, 1U);
  EXPECT_EQ(report->datagrams, 2U);
  EXPECT_EQ(Replay(report->capture).datagrams.size(), 2U);
}

TEST_F(FlightRecorderTest, BeforeTheFirstDatagramThereIsNothingToDump) {
  FlightRecorder recorder({10, 12080}, memory_);
  EXPECT_EQ(recorder.dump(folder_ / "dump.pcap", DumpReason::kAsked, {}).error().code,
            ErrorCode::kNothingCameOut);
  DumpPolicy policy(limits());
  EXPECT_EQ(recorder.dump(policy, DumpReason::kAsked, {}).error().refusal,
            DumpRefusal::kNothingHeld);
  EXPECT_TRUE(files().empty());
}

TEST_F(FlightRecorderTest, CountsEveryDumpThatWasWrittenOrRefused) {
  FlightRecorder recorder({10, 12080}, memory_);
  DumpPolicy policy(limits());
  const auto dump = [&](DumpReason reason) { return recorder.dump(policy, reason, {}); };
  EXPECT_FALSE(dump(DumpReason::kAsked).has_value());  // nothing held
  add(recorder, 0, 10);
  const auto first = dump(DumpReason::kMissedDeadline);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_FALSE(dump(DumpReason::kMissedDeadline).has_value());  // too soon
  EXPECT_TRUE(dump(DumpReason::kAsked).has_value());
  EXPECT_EQ(files().size(), 4U);

  const recorder::DumpCounters& counters = policy.counters();
  const auto sum = [](const auto& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  };
  EXPECT_EQ(counters.written, 2U);
  EXPECT_EQ(counters.refused[static_cast<std::size_t>(DumpRefusal::kNothingHeld)], 1U);
  EXPECT_EQ(counters.refused[static_cast<std::size_t>(DumpRefusal::kTooSoon)], 1U);
  EXPECT_EQ(sum(counters.wanted), counters.written + sum(counters.refused));
}

TEST_F(FlightRecorderTest, TheRoomAskedForIsTheSizeOfTheFiles) {
  FlightRecorder recorder({10, 12080}, memory_);
  add(recorder, 0, 10);
  DumpPolicy plenty(limits());
  const auto report = recorder.dump(plenty, DumpReason::kAsked, {});
  ASSERT_TRUE(report) << report.error().message;
  const std::uint64_t bytes = fs::file_size(report->capture) + fs::file_size(report->frame_times);
  fs::remove(report->capture);
  fs::remove(report->frame_times);

  DumpLimits tight = limits();
  tight.folder.most_bytes = bytes - 1;
  DumpPolicy too_tight(tight);
  EXPECT_EQ(recorder.dump(too_tight, DumpReason::kAsked, {}).error().refusal,
            DumpRefusal::kOverQuota);
  tight.folder.most_bytes = bytes;
  DumpPolicy just_enough(tight);
  EXPECT_TRUE(recorder.dump(just_enough, DumpReason::kAsked, {}).has_value());
}

TEST_F(FlightRecorderTest, DumpsWhileTheStreamGoesOn) {
  FlightRecorder recorder({64, 64 * 1208}, memory_);
  std::jthread receiver([&](const std::stop_token& stop) {
    for (std::int64_t n = 0; !stop.stop_requested(); ++n) add(recorder, n, 1);
  });
  DumpPolicy policy(limits());
  while (recorder.ring().added() < 1000) std::this_thread::yield();
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const auto report = recorder.dump(policy, DumpReason::kAsked, {});
    if (!report) {
      EXPECT_EQ(report.error().refusal, DumpRefusal::kNothingHeld) << report.error().message;
      continue;
    }
    for (const Datagram& datagram : Replay(report->capture).datagrams) {
      std::int64_t front = 0, back = 0;
      std::memcpy(&front, datagram.payload.data(), sizeof front);
      std::memcpy(&back, datagram.payload.data() + datagram.payload.size() - sizeof back,
                  sizeof back);
      EXPECT_EQ(front, back);
      EXPECT_EQ(datagram.stamp_ns, front * 1'000'000);
    }
  }
  EXPECT_GT(policy.counters().written, 0U);
}

/// A disk that is too small for the dump: refused, nothing left, and the recorder goes on.
class FlightRecorderOnAFullDisk : public FlightRecorderTest {
 protected:
  FlightRecorderOnAFullDisk() : recorder_({2000, 2000 * 1208}, memory_) { add(recorder_, 0, 2000); }
  [[nodiscard]] InChild refuses_and_leaves_nothing() {
    DumpPolicy policy(limits());
    const auto report = recorder_.dump(policy, DumpReason::kAsked, {});
    const bool right = !report && report.error().refusal == expected_ && files().empty();
    return right ? InChild::kAsExpected : InChild::kOtherwise;
  }
  static void expect(InChild end) {
    if (end == InChild::kNotPossible) GTEST_SKIP() << "not permitted to make a small disk";
    EXPECT_EQ(end, InChild::kAsExpected);
  }

  FlightRecorder recorder_;
  DumpRefusal expected_ = DumpRefusal::kDiskLow;
};

TEST_F(FlightRecorderOnAFullDisk, RefusesBeforeItWritesWhenTheFreeSpaceIsTooLow) {
  expect(on_a_disk_of(1024, folder_, [&] { return refuses_and_leaves_nothing(); }));
}

TEST_F(FlightRecorderOnAFullDisk, LeavesNothingWhenTheDiskFillsUpWhileItIsWritten) {
  expect(on_a_disk_of(1024, folder_, [&] {
    const auto report = recorder_.dump(folder_ / "dump.pcap", DumpReason::kAsked, {});
    const bool right = !report && report.error().code == ErrorCode::kWriteFailed && files().empty();
    return right ? InChild::kAsExpected : InChild::kOtherwise;
  }));
}

TEST_F(FlightRecorderOnAFullDisk, LeavesNothingWhenTheSystemLimitsFileSizes) {
  expected_ = DumpRefusal::kWriteFailed;
  expect(where_files_end_at(1'000'000, [&] { return refuses_and_leaves_nothing(); }));
}

TEST_F(FlightRecorderOnAFullDisk, LeavesNoCaptureWithoutItsTimes) {
  fs::create_directory(folder_ / "dump.frames.json");  // in the way: a folder cannot be replaced
  const auto report = recorder_.dump(folder_ / "dump.pcap", DumpReason::kAsked, {});
  ASSERT_FALSE(report.has_value());
  EXPECT_THAT(files(), testing::UnorderedElementsAre("dump.frames.json"));
}

TEST_F(FlightRecorderOnAFullDisk, LeavesNoTimesWithoutTheirCapture) {
  expected_ = DumpRefusal::kWriteFailed;
  const ::rlim_t whole = 24 + 2000 * (16 + 14 + 20 + 8 + 1206);
  expect(where_files_end_at(whole - 1, [&] { return refuses_and_leaves_nothing(); }));
  expect(where_files_end_at(whole, [&] {
    return refuses_and_leaves_nothing() == InChild::kOtherwise ? InChild::kAsExpected
                                                               : InChild::kOtherwise;
  }));
}

}  // namespace
}  // namespace terracut::test
