// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Drives of every sensor, in every return mode, written and decoded again.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/ruby128/difop_angles.hpp"
#include "firmware_io/sensor/device_reader.hpp"
#include "made_drive.hpp"
#include "random_columns.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/drive/drive_writer.hpp"

namespace terracut::drive {
namespace {

namespace fs = std::filesystem;
using test::RandomColumns;

/// Intensities of a frame's returns in order of arrival.
std::vector<std::uint8_t> arrivals(const frame::RangeImage& image) {
  std::vector<std::uint8_t> intensities(image.returns());
  for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
    if (image.has_return(cell)) intensities[image.return_index()[cell]] = image.intensity()[cell];
  }
  for (const auto& extra : image.overflow()) {
    intensities[extra.return_index] = extra.point.intensity;
  }
  return intensities;
}

template <class EncoderTraits>
class DriveRoundTrip : public testing::Test {
 protected:
  using Written = EncoderTraits;
  using Column = typename Written::Column;

  void SetUp() override { folder = terracut::test::make_scratch_folder(); }
  void TearDown() override { fs::remove_all(folder); }

  [[nodiscard]] fs::path pcap() const { return folder / "drive.pcap"; }

  DriveSummary write(const std::vector<Column>& columns, const typename Written::Config& config) {
    auto writer = DriveWriter<Written>::create(pcap(), Written::nominal(), config);
    EXPECT_TRUE(writer) << writer.error().message;
    for (const Column& column : columns) {
      const Status added =
          writer->add_column(column.stamp_ns, column.unwrapped_azimuth_cdeg, column.by_laser);
      EXPECT_TRUE(added) << added.error().message;
    }
    const auto summary = writer->finish();
    EXPECT_TRUE(summary) << summary.error().message;
    return *summary;
  }

  [[nodiscard]] std::vector<std::uint32_t> truth(std::size_t frame) const {
    char name[32];
    std::snprintf(name, sizeof name, "%06zu.label", frame);
    std::ifstream file(folder / "drive.truth" / name, std::ios::binary);
    EXPECT_TRUE(file) << name;
    std::vector<std::uint32_t> labels;
    packet::Le32 label{};
    while (file.read(reinterpret_cast<char*>(label.bytes.data()), 4)) {
      labels.push_back(label.value());
    }
    return labels;
  }

  /// Reads the drive as anybody would and holds each frame against its truth file.
  void expect_truth_fits(const DriveSummary& written, packets::ReturnMode returns, double spin_hz) {
    const auto calibration = test::table_beside<Written>(pcap());
    ASSERT_TRUE(calibration) << calibration.error().message;
    decode::Decoder::Config config;
    config.columns = packets::image_columns<Written>(spin_hz, returns);
    memory::FixedMemory memory;
    decode::Decoder decoder(*calibration, {}, config, memory);
    std::uint64_t frames = 0, arrived = 0;
    std::int64_t last_number = -1;
    std::uint64_t out_of_place = 0, out_of_order = 0;
    const auto on_frame = [&](const frame::FrameInfo&, const frame::RangeImage& image) noexcept {
      const auto seen = arrivals(image);
      const auto labels = truth(frames++);
      arrived += seen.size();
      EXPECT_EQ(labels.size(), seen.size()) << "frame " << frames - 1;
      last_number = -1;  // frames overlap around the seam; order holds inside of each
      for (std::size_t i = 0; i < std::min(labels.size(), seen.size()); ++i) {
        out_of_place += (labels[i] & 0xFFU) != seen[i] ? 1 : 0;
        out_of_order += static_cast<std::int64_t>(labels[i] >> 8) <= last_number ? 1 : 0;
        last_number = labels[i] >> 8;
      }
    };
    auto source = capture::PcapSource::open(pcap(), {.port = test::data_port<Written>()});
    ASSERT_TRUE(source) << source.error().message;
    while (true) {
      const auto datagram = source->next();
      ASSERT_TRUE(datagram) << datagram.error().message;
      if (!*datagram) break;
      ASSERT_EQ(test::decode(decoder, **datagram, on_frame), std::nullopt);
    }
    EXPECT_EQ(decoder.dual_return(), returns == packets::ReturnMode::kDual);
    EXPECT_EQ(decoder.packets_decoded(), written.packets);
    test::end_stream(decoder, on_frame);
    EXPECT_EQ(decoder.losses().network_gap_packets, 0U);
    EXPECT_EQ(decoder.losses().clock_jumps, 0U);
    EXPECT_EQ(decoder.losses().overflow_full_returns, 0U);
    EXPECT_EQ(frames, written.frames);
    EXPECT_EQ(arrived, written.returns);
    EXPECT_EQ(out_of_place, 0U);
    EXPECT_EQ(out_of_order, 0U);
  }

  fs::path folder;
};

using Sensors = testing::Types<packets::Hdl64eEncoderTraits, packets::Ruby128EncoderTraits,
                               packets::Vlp16EncoderTraits, packets::Hdl32eEncoderTraits,
                               packets::Vlp32cEncoderTraits, packets::Vls128EncoderTraits>;
TYPED_TEST_SUITE(DriveRoundTrip, Sensors);

TYPED_TEST(DriveRoundTrip, TheNthTruthEntryIsTheNthReturnDecodedInEveryModeAtEverySpin) {
  using EncoderTraits = TypeParam;
  for (const packets::ReturnMode returns :
       {packets::ReturnMode::kSingle, packets::ReturnMode::kDual}) {
    for (const double spin_hz : {5.0, 10.0, 20.0}) {
      SCOPED_TRACE(std::to_string(packets::returns_per_firing(returns)) + " returns at " +
                   std::to_string(spin_hz) + " Hz");
      const auto columns = test::random_columns<EncoderTraits>(
          {.returns = returns, .spin_hz = spin_hz, .share_of_returns = 0.3});
      const auto written = this->write(columns, {.returns = returns});
      EXPECT_EQ(written.frames, 4U);
      EXPECT_EQ(written.columns, columns.size());
      EXPECT_EQ(
          written.packets * static_cast<std::uint64_t>(EncoderTraits::columns_per_packet(returns)),
          columns.size());
      this->expect_truth_fits(written, returns, spin_hz);
    }
  }
}

TYPED_TEST(DriveRoundTrip, SeamsFallOnAnyPlaceOfAGroup) {
  using EncoderTraits = TypeParam;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const auto columns = test::random_columns<EncoderTraits>({.returns = packets::ReturnMode::kDual,
                                                              .spin_hz = 9.7 + 0.13 * seed,
                                                              .first_cdeg = 34'900 + 7.0 * seed,
                                                              .last_cdeg = 37'100,
                                                              .share_of_returns = 0.9,
                                                              .seed = seed});
    const auto written = this->write(columns, {.returns = packets::ReturnMode::kDual});
    this->expect_truth_fits(written, packets::ReturnMode::kDual, 10);
  }
}

TYPED_TEST(DriveRoundTrip, AnUnfinishedDriveLeavesNothingBehind) {
  using EncoderTraits = TypeParam;
  {
    auto writer = DriveWriter<EncoderTraits>::create(this->pcap(), EncoderTraits::nominal());
    ASSERT_TRUE(writer);
    for (const auto& c : test::random_columns<EncoderTraits>({.last_cdeg = 38'000})) {
      ASSERT_TRUE(writer->add_column(c.stamp_ns, c.unwrapped_azimuth_cdeg, c.by_laser));
    }
  }
  EXPECT_TRUE(fs::is_empty(this->folder));
}

TYPED_TEST(DriveRoundTrip, ColumnsThatFillNoPacketAreRefusedAtTheEnd) {
  using EncoderTraits = TypeParam;
  auto writer = DriveWriter<EncoderTraits>::create(this->pcap(), EncoderTraits::nominal());
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->add_column(1'000'000'000, 100, typename EncoderTraits::Column{}.by_laser));
  const auto finished = writer->finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().code, ErrorCode::kInvalidArgument);
}

using Ruby128Drive = DriveRoundTrip<packets::Ruby128EncoderTraits>;

TEST_F(Ruby128Drive, SendsADevicePacketFirstAndThenOnceASecond) {
  const auto columns = test::random_columns<packets::Ruby128EncoderTraits>(
      {.first_cdeg = 0, .last_cdeg = 36'000.0 * 21, .share_of_returns = 0});
  packets::Ruby128EncoderTraits::Config config;
  config.unit = {.rpm = 601, .serial = {1, 2, 3, 4, 5, 6}};
  write(columns, config);
  auto source = capture::PcapSource::open(pcap());
  ASSERT_TRUE(source);
  std::vector<std::int64_t> heard_ns;
  std::uint64_t others = 0;
  while (true) {
    const auto datagram = source->next();
    ASSERT_TRUE(datagram);
    if (!*datagram) break;
    const auto difop = ruby128::read_difop((*datagram)->payload);
    if (!difop) {
      EXPECT_FALSE(heard_ns.empty()) << "data before the device packet";
      ++others;
      continue;
    }
    EXPECT_EQ((*datagram)->destination_port, ruby128::kRubyDevicePort);
    heard_ns.push_back(ruby128::read_ruby_timestamp(difop->stamp, config.timestamp));
    const auto calibration = ruby128::calibration_of(*difop);
    ASSERT_TRUE(calibration) << calibration.error().message;
    EXPECT_EQ(fingerprint(*calibration), fingerprint(ruby128::nominal_ruby128()));
    EXPECT_EQ(difop->rpm_set.value(), 601);
    EXPECT_EQ(difop->rpm_actual.value(), 601);
    EXPECT_EQ(difop->serial, config.unit.serial);
    EXPECT_EQ(difop->data_port.value(), ruby128::kRubyDataPort);
    EXPECT_EQ(difop->device_port.value(), ruby128::kRubyDevicePort);
    EXPECT_EQ(difop->return_mode, 1);
  }
  ASSERT_EQ(heard_ns.size(), 3U);
  EXPECT_EQ(heard_ns[0], columns.front().stamp_ns);
  for (int second : {1, 2}) {
    const auto late_ns = heard_ns[static_cast<std::size_t>(second)] - heard_ns[0] -
                         std::int64_t{second} * 1'000'000'000;
    EXPECT_GE(late_ns, 0);
    EXPECT_LT(late_ns, 170'000);
  }
  EXPECT_EQ(others, columns.size() / 3);
}

TEST_F(Ruby128Drive, AnyEncodingOfTheStampsIsUnderstoodFromTheFirstPacketOn) {
  for (const ruby128::RubyTimestamp timestamp :
       {ruby128::RubyTimestamp::kCalendar, ruby128::RubyTimestamp::kUtcMicroseconds,
        ruby128::RubyTimestamp::kUtcNanoseconds}) {
    for (const packets::ReturnMode returns :
         {packets::ReturnMode::kSingle, packets::ReturnMode::kDual}) {
      SCOPED_TRACE(to_string(timestamp));
      const auto columns = test::random_columns<packets::Ruby128EncoderTraits>(
          {.returns = returns, .last_cdeg = 37'100});
      const auto written = write(columns, {.returns = returns, .timestamp = timestamp});
      expect_truth_fits(written, returns, 10);
    }
  }
}

}  // namespace
}  // namespace terracut::drive
