// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/scan_resampler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <unordered_set>
#include <vector>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/ruby128/difop.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "firmware_io/scan/scan_reader.hpp"
#include "tests/firmware_io/scan/recorded_sequences.hpp"
#include "tests/firmware_io/scan/scratch_folder.hpp"
#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tests/support/hand_out.hpp"
#include "tools/lab/encode/scan_drive.hpp"

namespace terracut::encode {
namespace {

/// Scans of flat ground and nothing else, a centimetre lower each time; label 40 + number.
void write_ground(const scan::ScratchFolder& folder, int scans) {
  for (int n = 0; n < scans; ++n) {
    std::vector<scan::ScanPoint> points;
    for (const scan::RingLine& ring : synthetic::table()) {
      const double slope = std::tan(ring.elevation_rad);
      for (int i = 0; i < 2000; ++i) {
        const double azimuth = beams::deg_to_rad(0.05 + 0.18 * i);
        const double d = slope < -0.02 ? (-1.73 - 0.01 * n - ring.vert_offset_m) / slope : 40;
        points.push_back({static_cast<float>(d * std::cos(azimuth)),
                          static_cast<float>(d * std::sin(azimuth)),
                          static_cast<float>(ring.vert_offset_m + d * slope), 0.25F});
      }
    }
    const std::string name = "00000" + std::to_string(n);
    folder.write_records("scans/velodyne/" + name + ".bin", points);
    folder.write_records("scans/labels/" + name + ".label",
                         std::vector<std::uint32_t>(points.size(), 40U + static_cast<unsigned>(n)));
  }
}

TEST(ScanResampler, AFolderBecomesADriveOfOneFrameAScan) {
  const scan::ScratchFolder folder;
  write_ground(folder, 2);
  const auto pcap = folder.path() / "drive.pcap";
  ResampleOptions<packets::Ruby128EncoderTraits> options;
  std::size_t progress = 0;
  options.on_scan = [&](std::size_t done, std::size_t of) {
    progress = done;
    EXPECT_EQ(of, 2U);
    return Status{};
  };
  const auto report =
      resample_scan_folder<packets::Ruby128EncoderTraits>(folder.path() / "scans", pcap, options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(progress, 2U);
  EXPECT_EQ(report->drive.frames, 2U);
  EXPECT_EQ(report->drive.returns, report->rays.returns);
  const ResampleSummary& rays = report->rays;
  EXPECT_NEAR(static_cast<double>(rays.rays), 2 * 128 * 1800.18, 300);
  EXPECT_EQ(rays.rays, rays.returns + rays.outside + rays.nothing_near + rays.out_of_span);
  // The top ring is seen at some 2.3 degrees from the origin; 26 channels point clearly above it.
  EXPECT_NEAR(static_cast<double>(rays.outside) / static_cast<double>(rays.rays), 26 / 128.0,
              0.004);

  memory::FixedMemory memory;
  decode::Decoder decoder(ruby128::nominal_ruby128(), {.height_m = 0}, {}, memory);
  int frames = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
    EXPECT_TRUE(info.complete);
    const double ground_m = -1.73 - 0.01 * frames;
    std::size_t near_ground = 0, ground = 0;
    for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
      if (!image.has_return(cell) || image.ground_range_m()[cell] > 30) continue;
      ++ground;
      near_ground += std::abs(image.z_m()[cell] - ground_m) < 0.01 ? 1 : 0;
    }
    EXPECT_GT(ground, 60'000U);
    EXPECT_GT(near_ground, ground * 999 / 1000);
    std::vector<std::uint32_t> truth;
    const auto labels =
        drive::truth_folder_of(pcap) / ("00000" + std::to_string(frames) + ".label");
    EXPECT_TRUE(scan::read_label_file(labels, image.returns(), truth));
    EXPECT_THAT(truth, testing::Each(40U + static_cast<unsigned>(frames)));
    ++frames;
  };
  auto source = capture::PcapSource::open(pcap, {.port = ruby128::kRubyDataPort});
  ASSERT_TRUE(source);
  for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
    EXPECT_EQ(test::decode(decoder, **datagram, on_frame), std::nullopt);
  }
  test::end_stream(decoder, on_frame);
  EXPECT_EQ(frames, 2);
}

template <class EncoderTraits>
class VelodyneResampled : public testing::Test {};
using Velodynes = testing::Types<packets::Vlp16EncoderTraits, packets::Hdl32eEncoderTraits,
                                 packets::Vlp32cEncoderTraits, packets::Vls128EncoderTraits>;
TYPED_TEST_SUITE(VelodyneResampled, Velodynes);

TYPED_TEST(VelodyneResampled, SeesTheGroundOfTheScanWhereItLies) {
  const scan::ScratchFolder folder;
  write_ground(folder, 1);
  const auto pcap = folder.path() / "drive.pcap";
  const auto report = resample_scan_folder<TypeParam>(folder.path() / "scans", pcap, {});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->drive.frames, 1U);
  EXPECT_EQ(report->drive.returns, report->rays.returns);

  memory::FixedMemory memory;
  decode::Decoder decoder(TypeParam::nominal(), {.height_m = 0}, {}, memory);
  std::uint64_t returns = 0, near_ground = 0, ground = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
    EXPECT_TRUE(info.complete);
    returns += image.returns();
    for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
      if (!image.has_return(cell) || image.ground_range_m()[cell] > 30) continue;
      ++ground;
      near_ground += std::abs(image.z_m()[cell] + 1.73) < 0.01 ? 1 : 0;
    }
  };
  auto source = capture::PcapSource::open(pcap);
  ASSERT_TRUE(source);
  for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
    EXPECT_EQ(test::decode(decoder, **datagram, on_frame), std::nullopt);
  }
  test::end_stream(decoder, on_frame);
  EXPECT_EQ(returns, report->rays.returns);
  EXPECT_GT(ground, 5'000U);
  EXPECT_GT(near_ground, ground * 999 / 1000);
}

TEST(ScanResampler, SaysByItsSerialNumberThatTheDriveIsNotRecorded) {
  const scan::ScratchFolder folder;
  write_ground(folder, 1);
  const auto pcap = folder.path() / "drive.pcap";
  ASSERT_TRUE(
      resample_scan_folder<packets::Ruby128EncoderTraits>(folder.path() / "scans", pcap, {}));
  auto source = capture::PcapSource::open(pcap, {.port = ruby128::kRubyDevicePort});
  ASSERT_TRUE(source);
  const auto datagram = source->next();
  ASSERT_TRUE(datagram && *datagram);
  const auto difop = ruby128::read_difop((*datagram)->payload);
  ASSERT_TRUE(difop);
  EXPECT_EQ(std::string(difop->serial.begin(), difop->serial.end()), "RESAMP");
}

TEST(ScanResampler, LeavesNothingWhenAScanIsRefused) {
  const scan::ScratchFolder folder;
  write_ground(folder, 1);
  folder.write("scans/velodyne/000001.bin", "seven b");
  const auto report = resample_scan_folder<packets::Ruby128EncoderTraits>(
      folder.path() / "scans", folder.path() / "drive.pcap", {});
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, testing::HasSubstr("000001.bin"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "drive.pcap"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "drive.truth"));
}

TEST(RecordedScans, ResampledReturnsLieBesideRecordedOnes) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    SCOPED_TRACE(sequence.filename());
    auto reader = scan::ScanReader::open(sequence);
    ASSERT_TRUE(reader) << reader.error().message;
    ASSERT_TRUE(reader->fit_rings());
    const ruby128::Ruby128Calibration unit = ruby128::nominal_ruby128();
    ScanResampler<packets::Ruby128EncoderTraits> resampler(unit);
    scan::KittiScan scan;
    std::vector<frame::Ruby128Column> columns;
    const auto rays = resampler.run(
        1, 0,
        [&](std::int64_t, ScanResampler<packets::Ruby128EncoderTraits>::Frame& into) {
          const Status status = reader->read(0, into.scan, into.rings);
          scan = into.scan;
          return status;
        },
        [&](const frame::Ruby128Column& column) -> Status {
          columns.push_back(column);
          return {};
        });
    ASSERT_TRUE(rays) << rays.error().message;
    EXPECT_GT(rays->returns, rays->rays / 2);
    EXPECT_EQ(rays->out_of_span, 0U);

    // Cells of half a metre that hold a recorded point, or lie beside one that does.
    const auto cell = [](double x, double y, double z) {
      const auto at = [](double v) {
        return static_cast<std::uint64_t>(std::llround(v * 2) + 4096);
      };
      return at(x) << 26 | at(y) << 13 | at(z);
    };
    std::unordered_set<std::uint64_t> held;
    for (const scan::ScanPoint& p : scan.points) {
      for (const double dx : {-0.5, 0.0, 0.5}) {
        for (const double dy : {-0.5, 0.0, 0.5}) {
          for (const double dz : {-0.5, 0.0, 0.5})
            held.insert(cell(p.x_m + dx, p.y_m + dy, p.z_m + dz));
        }
      }
    }
    const ruby128::Ruby128Geometry geometry(unit);
    std::size_t beside = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      packets::GroupAzimuths rotor;
      for (std::size_t k = 0; k < 3; ++k) {
        rotor.cdeg[k] = beams::wrap_cdeg(columns[i - i % 3 + k].unwrapped_azimuth_cdeg);
      }
      const auto step =
          packets::Ruby128EncoderTraits::step_ticks(rotor, 0, packets::ReturnMode::kSingle);
      for (int c = 0; c < ruby128::kRuby128Lasers; ++c) {
        const auto raw = columns[i].by_laser[static_cast<std::size_t>(c)].raw;
        if (raw == 0) continue;
        const double rotor_rad = packet::firing_azimuth_rad(columns[i].unwrapped_azimuth_cdeg,
                                                            ruby128::ruby_advance_ticks(step, c));
        const beams::Point at = geometry.point(c, rotor_rad, raw);
        beside += held.contains(cell(at.x_m, at.y_m, at.z_m)) ? 1 : 0;
      }
    }
    EXPECT_GT(static_cast<double>(beside) / static_cast<double>(rays->returns), 0.9);
  }
}

}  // namespace
}  // namespace terracut::encode
