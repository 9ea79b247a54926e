// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/capture_survey.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/hdl64e/firing_times.hpp"
#include "tests/firmware_io/capture/capture_bytes.hpp"
#include "tools/lab/tables/status_stream_writer.hpp"

namespace terracut::sensor {
namespace {

using test::Bytes;

Expected<CaptureSurvey> survey_of(const std::filesystem::path& file) {
  return capture::CaptureSource::open(file).map(
      [](capture::CaptureSource source) { return survey_capture(source); });
}

/// A unit that rotates at 10 Hz, 288 us a packet.
class Unit {
 public:
  explicit Unit(bool dual = false) : dual_(dual), status_(table(), hdl64e::StatusFlavour::kS3) {}

  /// The payload of packet `n`, counted from 0 without gaps.
  Bytes packet(std::int64_t n) {
    const std::int64_t period_us = dual_ ? 173 : 288;
    const int columns = dual_ ? hdl64e::kColumnsPerPacketDual : hdl64e::kColumnsPerPacketSingle;
    const int blocks_per_column = hdl64e::kBlocksPerPacket / columns;
    hdl64e::wire::Packet packet = hdl64e::blank_packet();
    for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
      const std::int64_t column = n * columns + static_cast<int>(block) / blocks_per_column;
      const double step_cdeg = 3.6 * static_cast<double>(period_us) / columns / 10.0;
      packet.blocks[block].azimuth_cdeg = static_cast<std::uint16_t>(
          static_cast<std::int64_t>(static_cast<double>(column) * step_cdeg) % 36000);
    }
    packet.stamp_us = static_cast<std::uint32_t>((3'599'000'000 + n * period_us) % 3'600'000'000);
    const hdl64e::StatusPair pair = status_.next(1'600'000'000'000'000'000 + n * period_us * 1000);
    packet.status_type = pair.type;
    packet.status_value = pair.value;
    const auto payload = hdl64e::payload_of(packet);
    return {payload.begin(), payload.end()};
  }

  [[nodiscard]] std::int64_t period_ns() const { return dual_ ? 173'000 : 288'000; }

 private:
  static std::array<std::uint8_t, hdl64e::kStreamTableBytes> table() {
    std::array<std::uint8_t, hdl64e::kStreamTableBytes> bytes{'U', 'N', 'I', 'T', '#'};
    for (std::size_t i = 0; i < 64; ++i) bytes[7 + 28 * i] = static_cast<std::uint8_t>(i);
    const std::uint16_t crc = hdl64e::stream_table_crc(bytes);
    bytes[1818] = static_cast<std::uint8_t>(crc & 0xFF);
    bytes[1819] = static_cast<std::uint8_t>(crc >> 8);
    return bytes;
  }

  bool dual_;
  tables::StatusStreamWriter status_;
};

packet::Datagram from_unit(const Bytes& payload, std::int64_t stamp_ns, std::uint16_t port = 2368) {
  return {.payload = payload,
          .stamp_ns = stamp_ns,
          .source_address = 0xC0A8032B,
          .destination_address = 0xC0A803FF,
          .source_port = 443,
          .destination_port = port};
}

class SurveyOfAUnit : public testing::Test {
 protected:
  /// `keep` says which packets get into the capture.
  template <class Keep>
  Hdl64eFacts survey(std::int64_t packets, bool dual, Keep keep) {
    Unit unit(dual);
    auto writer = capture::PcapWriter::create(folder_ / "unit.pcap");
    for (std::int64_t n = 0; n < packets; ++n) {
      const Bytes payload = unit.packet(n);
      if (!keep(n)) continue;
      EXPECT_TRUE(writer->write(from_unit(payload, n * unit.period_ns())));
    }
    EXPECT_TRUE(writer->finish());
    auto result = survey_of(folder_ / "unit.pcap");
    EXPECT_TRUE(result);
    EXPECT_EQ(result->streams.size(), 1U);
    EXPECT_EQ(result->streams.at(0).sensor, SensorModel::kHdl64e);
    return result->streams.at(0).hdl64e.value();
  }

  test::ScratchFolder folder_;
};

TEST_F(SurveyOfAUnit, TellsSpinStepFramesAndCalibration) {
  const Hdl64eFacts facts = survey(5000, false, [](std::int64_t) { return true; });
  EXPECT_EQ(facts.packets, 5000U);
  EXPECT_EQ(facts.return_mode, ReturnMode::kSingle);
  EXPECT_NEAR(facts.packet_period_us, 288.0, 0.01);
  EXPECT_NEAR(facts.spin_rpm, 600.0, 0.5);
  EXPECT_NEAR(facts.step_deg, 0.1728, 0.0005);
  EXPECT_NEAR(facts.frames, 5000 * 288e-6 * 10, 0.02);
  EXPECT_EQ(facts.packets_lost, 0U);
  EXPECT_EQ(facts.clock_jumps, 0U);
  EXPECT_TRUE(facts.table);
}

TEST_F(SurveyOfAUnit, TellsDualReturn) {
  const Hdl64eFacts facts = survey(2000, true, [](std::int64_t) { return true; });
  EXPECT_EQ(facts.return_mode, ReturnMode::kDual);
  EXPECT_NEAR(facts.packet_period_us, 173.0, 0.01);
  EXPECT_NEAR(facts.spin_rpm, 600.0, 0.5);
}

TEST_F(SurveyOfAUnit, CountsLostPacketsAndFramesAcrossGaps) {
  std::uint64_t dropped = 0;
  const Hdl64eFacts facts = survey(5000, false, [&](std::int64_t n) {
    const bool lost = (n > 10 && n % 97 == 0) || (n > 1000 && n < 2000);
    dropped += lost ? 1 : 0;
    return !lost;
  });
  EXPECT_EQ(facts.packets_lost, dropped);
  EXPECT_NEAR(facts.frames, 5000 * 288e-6 * 10, 0.05);
}

/// The head's azimuth, degrees, at packet `n` of a unit in single return.
double rotor_deg(std::int64_t n) {
  return std::fmod(static_cast<double>(n) * 288e-6 * 3600, 360);
}

TEST_F(SurveyOfAUnit, NamesItsBlindSectorAndDoesNotTakeItsTimeForLoss) {
  for (const auto& [from_deg, to_deg] : {std::pair{90.0, 270.0}, {355.0, 5.0}, {20.0, 340.0}}) {
    const auto is_blind = [from = from_deg, to = to_deg](std::int64_t n) {
      const double deg = rotor_deg(n);
      return from < to ? deg >= from && deg < to : deg >= from || deg < to;
    };
    const Hdl64eFacts facts = survey(5000, false, [&](std::int64_t n) { return !is_blind(n); });
    EXPECT_EQ(facts.packets_lost, 0U) << from_deg;
    EXPECT_NEAR(std::remainder(facts.blind.from_cdeg * 0.01 - from_deg, 360), 0, 1.1);
    EXPECT_NEAR(std::remainder(facts.blind.to_cdeg * 0.01 - to_deg, 360), 0, 1.1);
    EXPECT_NEAR(facts.frames, 5000 * 288e-6 * 10, 1);

    std::uint64_t dropped = 0;
    const Hdl64eFacts lossy = survey(5000, false, [&](std::int64_t n) {
      const bool is_beside_it = !is_blind(n) && (is_blind(n - 5) || is_blind(n + 5));
      const bool lost = n > 10 && n % 29 == 0 && !is_beside_it && !is_blind(n);
      dropped += lost ? 1 : 0;
      return !lost && !is_blind(n);
    });
    EXPECT_GT(dropped, 5U);
    EXPECT_EQ(lossy.packets_lost, dropped) << from_deg;
  }
}

TEST_F(SurveyOfAUnit, WithItsWholeViewIsBlindNowhereWhateverIsLost) {
  std::uint64_t dropped = 0;
  const Hdl64eFacts facts = survey(5000, false, [&](std::int64_t n) {
    const bool lost = (n > 500 && n < 520) || (n > 850 && n < 870) || n >= 4960;  // not the last
    dropped += lost && n < 4999 ? 1 : 0;
    return !lost || n == 4999;
  });
  EXPECT_TRUE(facts.blind.is_none());
  EXPECT_EQ(facts.packets_lost, dropped);
}

TEST(CaptureSurvey, TellsNoMoreThan64SizesOfAStreamAndCountsTheOthersTogether) {
  const test::ScratchFolder folder;
  auto writer = capture::PcapWriter::create(folder / "a.pcap");
  ASSERT_TRUE(writer);
  for (std::size_t bytes = 1; bytes <= 100; ++bytes) {
    ASSERT_TRUE(writer->write(from_unit(Bytes(bytes, 0), 1'000'000'000, 9999)));
  }
  ASSERT_TRUE(writer->finish());
  const auto survey = survey_of(folder / "a.pcap");
  ASSERT_TRUE(survey);
  ASSERT_EQ(survey->streams.size(), 1U);
  const auto& sizes = survey->streams[0].payload_sizes;
  EXPECT_EQ(sizes.size(), 64U + 1);
  EXPECT_EQ(sizes.at(0), 100U - 64);
}

TEST(CaptureSurvey, TellsStreamsApart) {
  const test::ScratchFolder folder;
  auto writer = capture::PcapWriter::create(folder / "a.pcap");
  ASSERT_TRUE(writer);
  Unit unit;
  for (std::int64_t n = 0; n < 100; ++n) {
    const std::int64_t stamp_ns = 1'000'000'000 + n * 1'000'000;
    ASSERT_TRUE(writer->write(from_unit(unit.packet(n), stamp_ns)));
    if (n % 2 == 0) {
      ASSERT_TRUE(writer->write(from_unit(Bytes(512, 0), stamp_ns, 8308)));
    }
    if (n % 10 == 0) {
      ASSERT_TRUE(writer->write(from_unit(Bytes(99, 1), stamp_ns, 9999)));
    }
  }
  ASSERT_TRUE(writer->finish());
  const auto survey = survey_of(folder / "a.pcap");
  ASSERT_TRUE(survey);
  ASSERT_EQ(survey->streams.size(), 3U);
  EXPECT_EQ(survey->link_type_name, "EN10MB");
  EXPECT_EQ(survey->counters.frames, 160U);

  const UdpStream& data = survey->streams[0];
  EXPECT_EQ(data.packets, 100U);
  EXPECT_EQ(data.source_address, 0xC0A8032BU);
  EXPECT_EQ(data.destination_port, 2368);
  EXPECT_EQ(data.first_stamp_ns, 1'000'000'000);
  EXPECT_EQ(data.last_stamp_ns, 1'099'000'000);
  EXPECT_NEAR(data.rate_hz(), 1000.0, 0.001);
  EXPECT_THAT(data.payload_sizes, testing::ElementsAre(testing::Pair(1206U, 100U)));
  EXPECT_EQ(survey->streams[1].sensor, SensorModel::kVelodynePosition);
  EXPECT_EQ(survey->streams[2].sensor, SensorModel::kUnknown);
  EXPECT_FALSE(survey->broke_off);
}

TEST(CaptureSurvey, ReportsACaptureThatBreaksOff) {
  const test::ScratchFolder folder;
  test::CaptureFile file;
  file.add(test::ethernet(test::IpFrame{}.bytes())).add(test::ethernet(test::IpFrame{}.bytes()));
  Bytes cut = file.bytes();
  cut.resize(cut.size() - 5);
  test::write_file(folder / "cut.pcap", cut);
  const auto survey = survey_of(folder / "cut.pcap");
  ASSERT_TRUE(survey);
  ASSERT_TRUE(survey->broke_off);
  EXPECT_EQ(survey->streams.at(0).packets, 1U);
}

TEST(CaptureSurvey, BoundsTheNumberOfStreams) {
  test::CaptureFile file;
  constexpr std::size_t kStreams = 1100;
  for (std::size_t i = 0; i < kStreams; ++i) {
    test::IpFrame frame;
    frame.source_port = static_cast<std::uint16_t>(i);
    file.add(test::ethernet(frame.bytes()));
  }
  auto source = capture::CaptureSource::open_memory(file.bytes(), "memory");
  ASSERT_TRUE(source);
  const CaptureSurvey survey = survey_capture(*source);
  EXPECT_EQ(survey.streams.size(), CaptureSurvey::kMostStreams);
  EXPECT_EQ(survey.packets_of_further_streams, kStreams - CaptureSurvey::kMostStreams);
}

}  // namespace
}  // namespace terracut::sensor
