// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Recorded scans through a capture and the packet decoder, return by return.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "tests/firmware_io/scan/recorded_sequences.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/encode/recorded_spin.hpp"
#include "tools/lab/encode/scan_encoder.hpp"
#include "tools/lab/encode/scan_reader.hpp"

namespace terracut::encode {
namespace {

constexpr double kSensorHeight_m = 1.73;

/// A drive and, for every frame, the points in the order in which their returns arrive.
struct Drive {
  std::filesystem::path pcap;
  hdl64e::Hdl64eCalibration calibration;
  std::vector<std::vector<scan::ScanPoint>> arriving;
  std::vector<std::vector<std::uint32_t>> labels;
  RecordedSpin spin;
  EncodeSummary summary;
};

void encode(const std::filesystem::path& sequence, Drive& drive) {
  auto reader = ScanReader::open(sequence);
  ASSERT_TRUE(reader);
  const auto fitted = reader->fit_rings();
  ASSERT_TRUE(fitted);
  drive.calibration = scan::hdl64e_calibration(fitted->table);
  auto writer = drive::Hdl64eDriveWriter::create(drive.pcap, drive.calibration);
  ASSERT_TRUE(writer) << writer.error().message;
  std::vector<scan::KittiScan> scans(reader->size());
  drive.arriving.resize(scans.size());
  drive.labels.resize(scans.size());
  scan::RingRecovery rings;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    ASSERT_TRUE(reader->read(i, scans[i], rings));
    drive.spin.add(rings.ring_of_point);
  }
  const ScanEncoder::Config config{std::ssize(scans), drive.spin.spin_hz(), 0};
  ScanEncoder encoder(drive.calibration, config, [&](const EncodedFiring& firing) -> Status {
    for (const auto& source : firing.sources) {
      if (source.frame < 0) continue;
      const auto frame = static_cast<std::size_t>(source.frame);
      drive.arriving[frame].push_back(scans[frame].points[source.point]);
      drive.labels[frame].push_back(scans[frame].labels[source.point]);
    }
    return writer->add_column(firing.column.stamp_ns, firing.column.unwrapped_azimuth_cdeg,
                              firing.column.by_laser);
  });
  for (std::size_t i = 0; i < scans.size(); ++i) {
    ASSERT_TRUE(reader->read(i, scans[i], rings));
    ASSERT_TRUE(encoder.add_frame(scans[i].points, rings.ring_of_point, scans[i].labels));
  }
  const auto summary = encoder.finish();
  ASSERT_TRUE(summary);
  drive.summary = *summary;
  const auto written = writer->finish();
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(written->frames, scans.size());
  EXPECT_EQ(written->returns, summary->encoded);
}

/// Compares one decoded frame with the points it was made of.
void compare(const Drive& drive, const frame::FrameInfo& info, const frame::RangeImage& image) {
  ASSERT_LT(info.number, drive.arriving.size()) << "more frames than scans";
  const auto& points = drive.arriving[info.number];
  const EncodedFrame& frame = drive.summary.frames[info.number];
  EXPECT_TRUE(info.complete);
  EXPECT_EQ(info.returns, frame.encoded);
  ASSERT_EQ(image.returns(), points.size());
  const double azimuth_bound_rad =
      beams::deg_to_rad(ScanEncoder::kFarthest_steps * 360 / drive.spin.firings() + 0.01);
  std::size_t far_off = 0;
  frame::for_each_return(image, [&](const frame::PlacedReturn& r) {
    const scan::ScanPoint& p = points[r.return_index];
    const double z = double{r.point.z_m} - kSensorHeight_m;
    const double decoded =
        std::sqrt(double{r.point.x_m} * r.point.x_m + double{r.point.y_m} * r.point.y_m + z * z);
    const double recorded =
        std::sqrt(double{p.x_m} * p.x_m + double{p.y_m} * p.y_m + double{p.z_m} * p.z_m);
    const double rotated = std::remainder(
        scan::azimuth_rad(r.point.x_m, r.point.y_m) - scan::azimuth_rad(p.x_m, p.y_m),
        2 * std::numbers::pi);
    far_off += std::abs(decoded - recorded) > 0.003 ? 1U : 0U;
    far_off += std::abs(rotated) > azimuth_bound_rad ? 1U : 0U;
  });
  EXPECT_EQ(far_off, 0U) << "frame " << info.number;
}

TEST(ScanPackets, BringBackEveryEncodedReturnInItsFrameAtItsPlace) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    SCOPED_TRACE(sequence);
    const test::ScratchFolder folder;
    Drive drive;
    drive.pcap = folder.path() / "drive.pcap";
    ASSERT_NO_FATAL_FAILURE(encode(sequence, drive));

    memory::FixedMemory memory;
    decode::Decoder::Config config;
    config.columns = drive.spin.firings();
    decode::Decoder decoder(drive.calibration, {kSensorHeight_m, 0, 0}, config, memory);
    auto source = capture::CaptureSource::open(drive.pcap);
    ASSERT_TRUE(source);
    std::uint32_t frames = 0;
    std::size_t returns = 0, overflow = 0;
    const auto on_frame = [&](const frame::FrameInfo& info,
                              const frame::RangeImage& image) noexcept {
      EXPECT_EQ(info.number, frames++);
      returns += image.returns();
      overflow += image.overflow().size();
      compare(drive, info, image);
    };
    for (;;) {
      const auto datagram = source->next();
      ASSERT_TRUE(datagram);
      if (!*datagram) break;
      EXPECT_FALSE(test::decode(decoder, **datagram, on_frame).has_value());
    }
    test::end_stream(decoder, on_frame);
    EXPECT_EQ(frames, drive.arriving.size());
    // One firing a column, but where azimuths in whole hundredths of a degree straddle a border.
    EXPECT_LT(static_cast<double>(overflow), 0.02 * static_cast<double>(returns));
    const frame::LossCounters losses = decoder.losses();
    EXPECT_EQ(losses.rejected_total(), 0U);
    EXPECT_EQ(losses.azimuth_hole_columns, 0U);
    EXPECT_EQ(losses.network_gap_packets, 0U);
    EXPECT_EQ(losses.overflow_full_returns, 0U);
    EXPECT_EQ(losses.clock_jumps, 0U);

    std::vector<std::uint32_t> truth;
    for (std::size_t frame = 0; frame < drive.labels.size(); ++frame) {
      const std::string digits = std::to_string(1000000 + frame).substr(1);
      ASSERT_TRUE(scan::read_label_file(drive::truth_folder_of(drive.pcap) / (digits + ".label"), 0,
                                        truth));
      EXPECT_EQ(truth, drive.labels[frame]);
    }
  }
}

}  // namespace
}  // namespace terracut::encode
