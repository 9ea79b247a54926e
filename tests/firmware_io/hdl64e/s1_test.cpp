// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The HDL-64E S1: packets made here, and a real capture beside VeloView's decode of its frame (data
// not part of the project; skipped where absent).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "calib/hdl64e/hdl64e_file.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/hdl64e/s1_reader.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "random_drive.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/places.hpp"

namespace terracut::hdl64e {
namespace {

using test::Packet;

/// Packets of a head that starts at 350 degrees; each azimuth is the encoder's last mark.
std::vector<Packet> s1_packets(double frames, double spin_hz = 10) {
  const double step_cdeg = 36'000 * spin_hz * kS1Packet_ns * 1e-9 / kBlocksPerPacket;
  std::vector<Packet> packets(static_cast<std::size_t>(frames / (spin_hz * kS1Packet_ns * 1e-9)));
  for (std::size_t n = 0; n < packets.size(); ++n) {
    wire::Packet packet{};
    for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
      const double head_cdeg = 35'000 + step_cdeg * static_cast<double>(12 * n + block);
      const auto mark = static_cast<std::int64_t>(head_cdeg) / kS1Mark_cdeg;
      packet.blocks[block].id = block % 4 == 0 ? kLowerBlockId : kUpperBlockId;
      packet.blocks[block].azimuth_cdeg =
          static_cast<std::uint16_t>(beams::wrap_cdeg(mark * kS1Mark_cdeg));
      for (wire::Return& one : packet.blocks[block].returns) one.distance = std::uint16_t{5'000};
    }
    std::ranges::copy(payload_of(packet), packets[n].bytes.begin());
    packets[n].stamp_ns =
        1'700'000'000'000'000'000 + static_cast<std::int64_t>(n) * std::int64_t{kS1Packet_ns};
  }
  return packets;
}

constexpr std::uint64_t kReturnsAPacket = 12 * 32;

TEST(Hdl64eS1, EveryReturnOfASteadyStreamIsPlacedAndNothingIsLost) {
  for (const double spin_hz : {5.0, 7.93, 10.0, 15.0}) {
    test::Recorder::Config config;
    config.columns = static_cast<int>(1e9 / spin_hz / kS1UpperFiring_ns);
    test::Recorder recorder(config);
    const std::vector<Packet> packets = s1_packets(3.2, spin_hz);
    recorder.decode_all(packets);
    recorder.flush();
    ASSERT_EQ(recorder.frames.size(), 5U) << spin_hz;
    for (std::size_t n = 1; n < 4; ++n) {
      EXPECT_TRUE(recorder.frames[n].info.complete) << spin_hz << " Hz, frame " << n;
    }
    EXPECT_EQ(recorder.returns(), packets.size() * kReturnsAPacket) << spin_hz;
    EXPECT_EQ(recorder.decoder.losses().rejected_total(), 0U) << spin_hz;
    EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U) << spin_hz;
    EXPECT_EQ(recorder.decoder.losses().azimuth_hole_columns, 0U) << spin_hz;
  }
}

TEST(Hdl64eS1, LostPacketsAreCountedByTheHeadsWay) {
  std::vector<Packet> packets = s1_packets(4);
  for (const std::size_t lost : {1U, 7U, 90U}) {
    test::Recorder recorder;
    for (std::size_t n = 0; n < packets.size(); ++n) {
      if (n < 300 || n >= 300 + lost) recorder.decode(packets[n]);
    }
    recorder.flush();
    EXPECT_EQ(recorder.decoder.losses().network_gap_packets, lost);
    EXPECT_EQ(recorder.returns(), (packets.size() - lost) * kReturnsAPacket);
  }
}

TEST(Hdl64eS1, LostRevolutionsAreCountedByTheHostsClock) {
  const std::vector<Packet> packets = s1_packets(8);
  const std::size_t lost = 2 * packets.size() / 8 + 40;  // two revolutions and some
  test::Recorder recorder;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    if (n < 600 || n >= 600 + lost) recorder.decode(packets[n]);
  }
  recorder.flush();
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, lost);
}

TEST(Hdl64eS1, PacketsOutOfOrderAndRepeatedOnesAreFound) {
  std::vector<Packet> packets = s1_packets(3);
  std::swap(packets[200], packets[201]);
  packets.insert(packets.begin() + 320, packets[319]);
  test::Recorder recorder(packets);
  EXPECT_EQ(recorder.rejected(frame::Reject::kRepeated), 1U);
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), 1U);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
  EXPECT_EQ(recorder.returns(), (packets.size() - 1) * kReturnsAPacket);
}

TEST(Hdl64eS1, AnAzimuthBeyondTheRevolutionIsRefusedByItsName) {
  std::vector<Packet> packets = s1_packets(1);
  packets[50].set_u16(100 * 7 + 2, 36'000);
  test::Recorder recorder(packets);
  EXPECT_EQ(recorder.rejected(frame::Reject::kAzimuthOutOfRange), 1U);
}

TEST(Hdl64eS1, AStepBackBeyondTheJitterOfItsEncoderIsRefused) {
  const auto rejected = [](std::uint32_t back_cdeg) {
    std::vector<Packet> packets = s1_packets(1);
    const auto& bytes = packets[50].bytes;
    packets[50].set_u16(702, bytes[602] + 256U * bytes[603] - back_cdeg);
    return test::Recorder(packets).rejected(frame::Reject::kAzimuthJump);
  };
  EXPECT_EQ(rejected(kMaxJitter_cdeg), 0U);
  EXPECT_EQ(rejected(kMaxJitter_cdeg + 1), 1U);
}

TEST(Hdl64eS1, AStandingHeadIsNoLoss) {
  const std::vector<Packet> packets = s1_packets(2);
  test::Recorder recorder;
  std::int64_t later_ns = 0;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    Packet packet = packets[n];
    packet.stamp_ns += later_ns;
    if (n == 300) {
      Packet standing = packet;
      for (std::size_t block = 0; block < 12; ++block) {
        standing.set_u16(100 * block + 2, packet.bytes[2] + 256U * packet.bytes[3]);
      }
      for (int second = 0; second < 5; ++second) {
        for (int i = 0; i < 2600; ++i) {
          standing.stamp_ns += kS1Packet_ns;
          EXPECT_EQ(recorder.decode(standing), frame::Reject::kStationary);
        }
      }
      later_ns = standing.stamp_ns - packet.stamp_ns + kS1Packet_ns;
      packet.stamp_ns = standing.stamp_ns + kS1Packet_ns;
    }
    recorder.decode(packet);
  }
  recorder.flush();
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
  EXPECT_EQ(recorder.returns(), packets.size() * kReturnsAPacket);
}

TEST(Hdl64eS1, IsDecodedWithoutAllocating) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  std::vector<Packet> packets = s1_packets(4);
  packets.erase(packets.begin() + 200, packets.begin() + 210);
  memory::FixedMemory memory;
  decode::Decoder decoder(nominal_hdl64e(), {}, {}, memory);
  std::uint64_t returns = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::MeasuredReturns&) noexcept {
    returns += info.returns;
  };
  const std::uint64_t before = test::allocations_of_this_thread();
  for (const Packet& packet : packets) test::decode(decoder, packet.datagram(), on_frame);
  test::end_stream(decoder, on_frame);
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
  EXPECT_EQ(returns, packets.size() * kReturnsAPacket);
}

TEST(Hdl64eS1, IsFoundByItselfAndWhereAnHdl64eIsWanted) {
  for (const auto wanted :
       {std::optional<sensor::SensorModel>(), std::optional(sensor::SensorModel::kHdl64e)}) {
    streams::FirstSeconds::Config config;
    config.model = wanted;
    config.calibration.unit = nominal_hdl64e();
    streams::FirstSeconds first(config);
    for (const Packet& packet : s1_packets(10)) first.add(packet.datagram());
    ASSERT_TRUE(first.is_enough());
    const auto found = first.conclude();
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->model, sensor::SensorModel::kHdl64eS1);
    EXPECT_NEAR(found->spin_hz, 10, 0.02);
    EXPECT_EQ(found->columns, 2342);  // firings of an upper laser
  }
}

// --- A real one ---

struct SensorPoint {
  double x_m, y_m, z_m;
};

/// VeloView's frame: x to the right, y ahead, z up.
std::vector<SensorPoint> read_veloview(const std::filesystem::path& zip) {
  std::vector<SensorPoint> points;
  const std::string command =
      "python3 -c 'import sys, zipfile as z; f = z.ZipFile(sys.argv[1]);"
      " sys.stdout.buffer.write(f.read(f.namelist()[0]))' " +
      zip.string();
  std::FILE* csv = ::popen(command.c_str(), "r");
  if (csv == nullptr) return points;
  std::array<char, 256> line{};
  while (std::fgets(line.data(), line.size(), csv) != nullptr) {
    SensorPoint point{};
    if (std::sscanf(line.data(), "%lf,%lf,%lf", &point.x_m, &point.y_m, &point.z_m) == 3) {
      points.push_back({point.y_m, -point.x_m, point.z_m});
    }
  }
  ::pclose(csv);
  return points;
}

class RealS1 : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path folder = test::shared_data("hdl64e_s1");
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
    auto table = load_hdl64e_calibration(folder / "atwall.db.xml");
    ASSERT_TRUE(table) << table.error().message;
    table_ = *table;
    auto source = capture::CaptureSource::open(folder / "atwall.pcap");
    ASSERT_TRUE(source);
    for (auto next = source->next(); next && *next; next = source->next()) {
      Packet& packet = packets_.emplace_back();
      std::ranges::copy((*next)->payload, packet.bytes.begin());
      packet.stamp_ns = (*next)->stamp_ns;
    }
    ASSERT_EQ(packets_.size(), 306U);
  }
  Hdl64eCalibration table_;
  std::vector<Packet> packets_;
};

TEST_F(RealS1, EqualsVeloViewsDecodeInOrder) {
  const auto theirs = read_veloview(test::shared_data("hdl64e_s1") / "atwall_veloview.zip");
  ASSERT_EQ(theirs.size(), 89'105U);

  // VeloView leaves the near corrections of the table out.
  for (Hdl64eLaser& laser : table_.lasers) laser.two_point = false;
  const mount::Mount mount{.height_m = 1.9};
  test::Recorder recorder(packets_, {}, table_, mount);
  EXPECT_EQ(recorder.returns(), 104'661U);
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), 0U);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
  ASSERT_EQ(recorder.frames.size(), 3U);  // none complete: it ends half a degree behind the seam

  // Each is the next return of one of our frames, which end by beams where VeloView's ends by the
  // head; where VeloView's begins, ours of the frame before have begun already.
  std::vector<std::size_t> next(recorder.frames.size());
  std::vector<bool> has_begun(recorder.frames.size());
  std::size_t missing = 0;
  for (const SensorPoint& point : theirs) {
    bool is_found = false;
    for (std::size_t f = 0; f < next.size() && !is_found; ++f) {
      const auto& returns = recorder.frames[f].returns;
      const std::size_t until =
          has_begun[f] ? std::min(next[f] + 1, returns.size()) : returns.size();
      for (std::size_t n = next[f]; n < until && !is_found; ++n) {
        const frame::Return& ours = returns[n].point;
        is_found = std::abs(ours.x_m - point.x_m) < 1e-3 && std::abs(ours.y_m - point.y_m) < 1e-3 &&
                   std::abs(ours.z_m - mount.height_m - point.z_m) < 1e-3;
        if (!is_found) continue;
        has_begun[f] = true;
        next[f] = n + 1;
      }
    }
    missing += is_found ? 0U : 1U;
  }
  EXPECT_EQ(missing, 0U);
}

TEST_F(RealS1, ALostPacketIsCounted) {
  test::Recorder recorder({}, table_);
  packets_.erase(packets_.begin() + 150);
  recorder.decode_all(packets_);
  recorder.flush();
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 1U);
  EXPECT_NEAR(static_cast<double>(recorder.decoder.losses().azimuth_hole_columns), 12, 1);
}

}  // namespace
}  // namespace terracut::hdl64e
