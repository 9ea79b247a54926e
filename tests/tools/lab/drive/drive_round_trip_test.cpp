// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Drives of every sensor, in every return mode, written and decoded again.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
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
class DriveRoundTrip : public terracut::test::InScratchFolder {
 protected:
  using Written = EncoderTraits;
  using Column = typename Written::Column;

  [[nodiscard]] fs::path pcap() const { return folder_ / "drive.pcap"; }
  [[nodiscard]] static typename Written::Calibration unit(packets::ReturnMode returns,
                                                          double spin_hz) {
    return packets::unit_in_mode<Written>(Written::nominal(), returns, spin_hz);
  }

  DriveSummary write(const std::vector<Column>& columns,
                     const typename Written::Config& config = {},
                     const typename Written::Calibration& calibration = Written::nominal()) {
    auto writer = DriveWriter<Written>::create(pcap(), calibration, config);
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
    std::ifstream file(folder_ / "drive.truth" / name, std::ios::binary);
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
    auto source = capture::CaptureSource::open(pcap(), {.port = test::data_port<Written>()});
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

  [[nodiscard]] std::size_t files_in_folder() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
};

template <class... VelodyneModel>
using SensorsWith = testing::Types<
    packets::Hdl64eEncoderTraits, packets::Ruby128EncoderTraits,
    packets::VelodyneEncoderTraits<VelodyneModel>..., packets::HesaiEncoderTraits<hesai::Pandar40p>,
    packets::RoboSenseEncoderTraits<robosense::Rs32>,
    packets::RoboSenseEncoderTraits<robosense::Helios>,
    packets::HesaiEncoderTraits<hesai::PandarQt128>,
    packets::HesaiEncoderTraits<hesai::PandarXt32m>, packets::HesaiEncoderTraits<hesai::Ot128>,
    packets::OusterEncoderTraits<32>, packets::OusterEncoderTraits<128>>;
using Sensors = velodyne::Models::In<SensorsWith>;
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
      const auto written = this->write(columns, {.returns = returns}, this->unit(returns, spin_hz));
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
    const auto written = this->write(columns, {.returns = packets::ReturnMode::kDual},
                                     this->unit(packets::ReturnMode::kDual, 10));
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
  EXPECT_TRUE(fs::is_empty(this->folder_));
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
  auto source = capture::CaptureSource::open(pcap());
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

using Hdl64e = packets::Hdl64eEncoderTraits;
using Hdl64eDrive = DriveRoundTrip<Hdl64e>;

TEST_F(Hdl64eDrive, WideRotationalCorrectionsKeepTheirFrames) {
  hdl64e::Hdl64eCalibration calibration = hdl64e::nominal_hdl64e();
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any_deg(-10, 10);
  for (auto& laser : calibration.lasers) {
    laser.rot_correction_rad = beams::deg_to_rad(any_deg(random));
  }
  for (const unsigned seed : {0U, 1U, 2U}) {
    const double spin_hz = 10 + 2.9 * seed;
    const auto columns = test::random_columns<Hdl64e>({.spin_hz = spin_hz,
                                                       .first_cdeg = 20'000 + 3'333.0 * seed,
                                                       .share_of_returns = 0.4,
                                                       .seed = seed});
    expect_truth_fits(write(columns, {}, calibration), packets::ReturnMode::kSingle, spin_hz);
  }
}

TEST_F(Hdl64eDrive, OneRevolutionIsOneFrame) {
  auto columns =
      test::random_columns<Hdl64e>({.first_cdeg = 35'000, .last_cdeg = 73'000, .seed = 3});
  const hdl64e::BeamOffsets offsets(hdl64e::nominal_hdl64e());
  for (std::size_t n = 0; n < columns.size(); ++n) {
    const std::size_t packet = n / 6 * 6;
    const std::int32_t step_ticks =
        hdl64e::column_step_ticks(beams::wrap_cdeg(columns[packet].unwrapped_azimuth_cdeg),
                                  beams::wrap_cdeg(columns[packet + 5].unwrapped_azimuth_cdeg));
    for (int i = 0; i < 64; ++i) {
      const auto beam = packet::beam_azimuth(columns[n].unwrapped_azimuth_cdeg,
                                             offsets.offset_ticks(step_ticks, i));
      if (beam.frame != 1) columns[n].by_laser[static_cast<std::size_t>(i)] = {};
    }
  }
  const auto summary = write(columns);
  EXPECT_EQ(summary.frames, 1U);
  expect_truth_fits(summary, packets::ReturnMode::kSingle, 10);
}

TEST_F(Hdl64eDrive, TheCaptureCarriesTheCalibration) {
  write(test::random_columns<Hdl64e>(
      {.last_cdeg = 37'000 + 13 * 36'000.0, .share_of_returns = 0.01}));
  auto source = capture::CaptureSource::open(pcap());
  ASSERT_TRUE(source);
  std::array<std::uint8_t, hdl64e::kStreamTableBytes> table{};
  std::size_t written = 0;
  // The first round of the status stream, byte by byte: places 9..15 of each cycle of 16.
  for (std::size_t n = 0; written < table.size(); ++n) {
    const auto datagram = source->next();
    ASSERT_TRUE(datagram);
    ASSERT_TRUE(*datagram) << "the drive is shorter than a round";
    if (n % 16 >= 9) table[written++] = (*datagram)->payload[1205];
  }
  const auto parsed = hdl64e::parse_stream_table(table);
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(fingerprint(*parsed), fingerprint(hdl64e::nominal_hdl64e()));
}

TEST_F(Hdl64eDrive, ReplacesAnOlderDriveAndItsTruth) {
  EXPECT_EQ(write(test::random_columns<Hdl64e>({.share_of_returns = 0.1})).frames, 4U);
  const auto shorter = test::random_columns<Hdl64e>({.last_cdeg = 38'000, .share_of_returns = 0.1});
  EXPECT_EQ(write(shorter).frames, 2U);
  EXPECT_FALSE(fs::exists(folder_ / "drive.truth" / "000002.label"));
  EXPECT_EQ(files_in_folder(), 3U);
}

TEST_F(Hdl64eDrive, ReplacesNeitherAFolderThatIsNotTruthNorATableThatIsOfNoDrive) {
  for (const char* const name : {"drive.calibration.xml", "drive.truth/thesis.tex"}) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "precious";
    const auto writer = DriveWriter<Hdl64e>::create(pcap(), Hdl64e::nominal());
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(writer.error().message.find(fs::path(name).filename()), std::string::npos);
    EXPECT_EQ(files_in_folder(), 1U);
    EXPECT_TRUE(fs::remove(folder_ / name));
  }
}

TEST_F(Hdl64eDrive, IsNotMadeOfAnUnusableCalibration) {
  hdl64e::Hdl64eCalibration broken = hdl64e::nominal_hdl64e();
  broken.lasers[7].vert_correction_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DriveWriter<Hdl64e>::create(pcap(), broken));
  EXPECT_EQ(files_in_folder(), 0U);
}

}  // namespace
}  // namespace terracut::drive
