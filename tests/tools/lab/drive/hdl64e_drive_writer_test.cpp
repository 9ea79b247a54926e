// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/drive/drive_writer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "calib/hdl64e/hdl64e_xml.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "tests/firmware_io/hdl64e/random_drive.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut::test {
namespace {

namespace fs = std::filesystem;
using DriveWriter = drive::Hdl64eDriveWriter;

class DriveWriterTest : public testing::Test {
 protected:
  DriveWriterTest()
      : folder(fs::temp_directory_path() /
               ("terracut_drive_" + std::to_string(getpid()) + "_" +
                testing::UnitTest::GetInstance()->current_test_info()->name())),
        pcap(folder / "drive.pcap") {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~DriveWriterTest() override { fs::remove_all(folder); }

  /// Writes the firings, numbering the truth so that every label says which return it is.
  drive::DriveSummary write(std::vector<FiringColumn>& firings,
                            const hdl64e::Hdl64eCalibration& calibration) {
    auto writer = DriveWriter::create(pcap, calibration);
    EXPECT_TRUE(writer) << writer.error().message;
    std::uint32_t number = 0;
    for (FiringColumn& firing : firings) {
      for (auto& beam : firing.by_laser) {
        if (beam.raw != 0) beam.truth = number++ << 8 | beam.intensity;
      }
      const Status added =
          writer->add_column(firing.stamp_ns, firing.unwrapped_azimuth_cdeg, firing.by_laser);
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

  /// Reads the drive back as anybody would, and checks each frame against its truth file.
  void expect_truth_fits(std::size_t frames, std::uint64_t returns) {
    const auto calibration = hdl64e::read_hdl64e_xml(folder / "drive.calibration.xml");
    ASSERT_TRUE(calibration) << calibration.error().message;
    Recorder recorder({}, *calibration);
    auto source = capture::PcapSource::open(pcap, {.port = 2368});
    ASSERT_TRUE(source) << source.error().message;
    auto keep = recorder.keep();
    while (true) {
      const auto datagram = source->next();
      ASSERT_TRUE(datagram) << datagram.error().message;
      if (!*datagram) break;
      ASSERT_EQ(test::decode(recorder.decoder, **datagram, keep), std::nullopt);
    }
    test::end_stream(recorder.decoder, keep);
    EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
    ASSERT_EQ(recorder.frames.size(), frames);
    EXPECT_EQ(recorder.returns(), returns);
    for (std::size_t n = 0; n < frames; ++n) {
      const std::vector<std::uint32_t> labels = truth(n);
      ASSERT_EQ(labels.size(), recorder.frames[n].returns.size()) << "frame " << n;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        ASSERT_EQ(labels[i] & 0xFFU, recorder.frames[n].returns[i].point.intensity);
        ASSERT_TRUE(i == 0 || labels[i] > labels[i - 1]) << "not in order of arrival";
      }
    }
    EXPECT_FALSE(fs::exists(folder / "drive.truth" / "999999.label"));
  }

  [[nodiscard]] std::size_t files_in_folder() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  fs::path folder, pcap;
};

TEST_F(DriveWriterTest, WideRotationalCorrectionsKeepTheirFrames) {
  hdl64e::Hdl64eCalibration calibration = hdl64e::nominal_hdl64e();
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any_deg(-10, 10);
  for (auto& laser : calibration.lasers) {
    laser.rot_correction_rad = beams::deg_to_rad(any_deg(random));
  }
  for (unsigned seed = 0; seed < 3; ++seed) {
    auto firings = random_firings({.first_cdeg = 20'000 + 3'333 * static_cast<int>(seed),
                                   .step_deg = 0.1728 + 0.05 * seed,
                                   .share_of_returns = 0.4,
                                   .seed = seed});
    const auto summary = write(firings, calibration);
    expect_truth_fits(summary.frames, summary.returns);
  }
}

TEST_F(DriveWriterTest, OneRevolutionIsOneFrame) {
  auto firings = random_firings({.first_cdeg = 35'000, .last_cdeg = 73'000, .seed = 3});
  const hdl64e::BeamOffsets offsets(hdl64e::nominal_hdl64e());
  for (std::size_t n = 0; n < firings.size(); ++n) {
    const std::size_t packet = n / 6 * 6;
    const std::int32_t step_ticks =
        hdl64e::column_step_ticks(beams::wrap_cdeg(firings[packet].unwrapped_azimuth_cdeg),
                                  beams::wrap_cdeg(firings[packet + 5].unwrapped_azimuth_cdeg));
    for (int i = 0; i < 64; ++i) {
      if (packet::beam_azimuth(firings[n].unwrapped_azimuth_cdeg,
                               offsets.offset_ticks(step_ticks, i))
              .frame != 1) {
        firings[n].by_laser[static_cast<std::size_t>(i)] = {};
      }
    }
  }
  const auto summary = write(firings, hdl64e::nominal_hdl64e());
  EXPECT_EQ(summary.frames, 1U);
  expect_truth_fits(1, summary.returns);
}

TEST_F(DriveWriterTest, TheCaptureCarriesTheCalibration) {
  auto firings = random_firings({.last_cdeg = 37'000 + 13 * 36'000, .share_of_returns = 0.01});
  write(firings, hdl64e::nominal_hdl64e());
  auto source = capture::PcapSource::open(pcap);
  ASSERT_TRUE(source);
  std::array<std::uint8_t, hdl64e::kStreamTableBytes> table{};
  std::size_t written = 0;
  bool from_start = true;
  // The first round of the status stream, byte by byte: places 9..15 of each cycle of 16.
  for (std::size_t n = 0; from_start && written < table.size(); ++n) {
    const auto datagram = source->next();
    ASSERT_TRUE(datagram);
    ASSERT_TRUE(*datagram) << "the drive is shorter than a round";
    if (n % 16 >= 9) table[written++] = (*datagram)->payload[1205];
  }
  const auto parsed = hdl64e::parse_stream_table(table);
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(fingerprint(*parsed), fingerprint(hdl64e::nominal_hdl64e()));
}

TEST_F(DriveWriterTest, ReplacesAnOlderDriveAndItsTruth) {
  auto longer = random_firings({.share_of_returns = 0.1});
  EXPECT_EQ(write(longer, hdl64e::nominal_hdl64e()).frames, 4U);
  auto shorter = random_firings({.last_cdeg = 38'000, .share_of_returns = 0.1});
  EXPECT_EQ(write(shorter, hdl64e::nominal_hdl64e()).frames, 2U);
  EXPECT_FALSE(fs::exists(folder / "drive.truth" / "000002.label"));
  EXPECT_EQ(files_in_folder(), 3U);
}

TEST_F(DriveWriterTest, RefusesToReplaceAFolderThatIsNotTruth) {
  fs::create_directories(folder / "drive.truth");
  std::ofstream(folder / "drive.truth" / "thesis.tex") << "precious";
  const auto writer = DriveWriter::create(pcap, hdl64e::nominal_hdl64e());
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ErrorCode::kInvalidArgument);
  EXPECT_NE(writer.error().message.find("thesis.tex"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "drive.truth" / "thesis.tex"));
  EXPECT_EQ(files_in_folder(), 1U);
}

TEST_F(DriveWriterTest, RefusesToReplaceATableThatIsOfNoDrive) {
  std::ofstream(folder / "drive.calibration.xml") << "my unit's";
  const auto writer = DriveWriter::create(pcap, hdl64e::nominal_hdl64e());
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ErrorCode::kInvalidArgument);
  EXPECT_NE(writer.error().message.find("drive.calibration.xml"), std::string::npos);
  EXPECT_EQ(files_in_folder(), 1U);
}

TEST_F(DriveWriterTest, RefusesAnUnusableCalibration) {
  hdl64e::Hdl64eCalibration broken = hdl64e::nominal_hdl64e();
  broken.lasers[7].vert_correction_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DriveWriter::create(pcap, broken));
  EXPECT_EQ(files_in_folder(), 0U);
}

}  // namespace
}  // namespace terracut::test
