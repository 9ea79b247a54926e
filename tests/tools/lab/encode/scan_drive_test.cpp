// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/scan_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/hdl64e/hdl64e_xml.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/encode/scan_reader.hpp"

namespace terracut::encode {
namespace {

using testing::HasSubstr;

void write_sequence(const test::ScratchFolder& folder, int scans) {
  for (int i = 0; i < scans; ++i) {
    synthetic::World world;
    world.ground_m = -1.73 + 0.01 * i;
    const auto points = synthetic::scan(synthetic::table(), world);
    const std::string name = "00000" + std::to_string(i);
    folder.write_records("scans/velodyne/" + name + ".bin", points);
    folder.write_records("scans/labels/" + name + ".label",
                         std::vector<std::uint32_t>(points.size(), 40U + static_cast<unsigned>(i)));
  }
}

/// Poses of a drive straight ahead (the camera's z) at `speed_mps`, a frame each 0.1 s.
void write_poses(const test::ScratchFolder& folder, int frames, double speed_mps) {
  std::string poses, times;
  for (int i = 0; i < frames; ++i) {
    poses += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(0.1 * i * speed_mps) + "\n";
    times += std::to_string(0.1 * i) + "\n";
  }
  folder.write("scans/poses.txt", poses);
  folder.write("scans/times.txt", times);
}

TEST(ScanDrive, ACanLogIsRefusedWhereNoMotionIsPutBack) {
  const test::ScratchFolder folder;
  write_sequence(folder, 1);
  ScanDriveOptions options;
  options.can_log = true;
  const auto pcap = folder.path() / "drive.pcap";
  auto refused = encode_scan_folder(folder.path() / "scans", pcap, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(refused.error().message, HasSubstr("poses.txt is missing"));
  write_poses(folder, 2, 15);
  options.motion = PutMotionBack::kNever;
  refused = encode_scan_folder(folder.path() / "scans", pcap, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

TEST(ScanDrive, PutsTheMotionBackWherePosesLieBesideTheScans) {
  const test::ScratchFolder folder;
  write_sequence(folder, 2);
  const auto pcap = folder.path() / "drive.pcap";
  ScanDriveOptions options;
  options.calibration = scan::hdl64e_calibration(synthetic::table());
  const auto height_p95_m = [&](bool put_back) {
    const auto report = encode_scan_folder(folder.path() / "scans", pcap, options);
    EXPECT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->why_as_recorded.empty(), put_back) << report->why_as_recorded;
    return report->encoded.height.p95_m;
  };
  EXPECT_LT(height_p95_m(false), 0.003);
  write_poses(folder, 2, 15);
  EXPECT_GT(height_p95_m(true), 0.05) << "the made scans are not compensated: motion bends them";
  options.motion = PutMotionBack::kNever;
  EXPECT_LT(height_p95_m(false), 0.003);
}

TEST(ScanDrive, WritesCaptureCalibrationAndTruthOfEveryScan) {
  const test::ScratchFolder folder;
  write_sequence(folder, 2);
  std::size_t progress = 0;
  ScanDriveOptions options;
  options.on_scan = [&](std::size_t done, std::size_t of) {
    progress = done;
    EXPECT_EQ(of, 2U);
    return Status{};
  };
  const auto pcap = folder.path() / "drive.pcap";
  const auto report = encode_scan_folder(folder.path() / "scans", pcap, options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(progress, 2U);
  EXPECT_EQ(report->drive.frames, 2U);
  EXPECT_EQ(report->drive.returns, report->encoded.encoded);
  EXPECT_TRUE(report->fitted.has_value());
  EXPECT_GT(std::filesystem::file_size(pcap), report->drive.packets * 1206);

  const auto calibration =
      hdl64e::read_hdl64e_xml(drive::calibration_path_of<packets::Hdl64eEncoderTraits>(pcap));
  ASSERT_TRUE(calibration) << calibration.error().message;
  EXPECT_EQ(fingerprint(*calibration), fingerprint(report->calibration));
  for (std::uint32_t frame = 0; frame < 2; ++frame) {
    std::vector<std::uint32_t> truth;
    const auto path = drive::truth_folder_of(pcap) / ("00000" + std::to_string(frame) + ".label");
    ASSERT_TRUE(scan::read_label_file(path, report->encoded.frames[frame].encoded, truth));
    EXPECT_THAT(truth, testing::Each(40 + frame));
  }
}

TEST(ScanDrive, ThatIsEndedEarlyLeavesNothing) {
  const test::ScratchFolder folder;
  write_sequence(folder, 2);
  ScanDriveOptions options;
  options.on_scan = [](std::size_t done, std::size_t) -> Status {
    if (done < 2) return {};
    return fail(ErrorCode::kNothingCameOut, "enough");
  };
  const auto pcap = folder.path() / "made" / "drive.pcap";
  const auto report = encode_scan_folder(folder.path() / "scans", pcap, options);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message, "enough");
  EXPECT_TRUE(std::filesystem::is_empty(pcap.parent_path()));
}

TEST(ScanDrive, UsesAGivenCalibration) {
  const test::ScratchFolder folder;
  write_sequence(folder, 1);
  ScanDriveOptions options;
  options.calibration = scan::hdl64e_calibration(synthetic::table());
  const auto report =
      encode_scan_folder(folder.path() / "scans", folder.path() / "drive.pcap", options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->fitted.has_value());
  EXPECT_LT(report->encoded.height.p95_m, 0.003);
}

TEST(ScanDrive, LeavesNothingWhenAScanIsRefused) {
  const test::ScratchFolder folder;
  write_sequence(folder, 1);
  folder.write("scans/velodyne/000001.bin", "seven b");
  const auto report = encode_scan_folder(folder.path() / "scans", folder.path() / "drive.pcap", {});
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, HasSubstr("000001.bin"));
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& e : std::filesystem::directory_iterator(folder.path()))
    ++entries;
  EXPECT_EQ(entries, 1U);
}

TEST(ScanReader, UndoesTheCompensationOnlyOfScansNamedByTheirFrame) {
  const test::ScratchFolder folder;
  folder.write_records("velodyne/first.bin", synthetic::scan(synthetic::table()));
  folder.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n");
  folder.write("times.txt", "0\n0.1\n");
  const auto reader = ScanReader::open(folder.path(), PutMotionBack::kWhereKnown);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_THAT(reader->why_as_recorded(), HasSubstr("not named by its frame number"));
}

TEST(ScanReader, TakesScansAsRecordedWhereThePosesEndBeforeThem) {
  const test::ScratchFolder folder;
  write_sequence(folder, 3);
  write_poses(folder, 2, 15);
  const auto reader = ScanReader::open(folder.path() / "scans", PutMotionBack::kWhereKnown);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_THAT(reader->why_as_recorded(), HasSubstr("ends at frame 1, before"));
  EXPECT_THAT(reader->why_as_recorded(), HasSubstr("000002.bin"));
}

TEST(ScanReader, FitsTheTableFromWholeScansAndAlignsTheOthersWithIt) {
  const test::ScratchFolder folder;
  write_sequence(folder, 1);
  auto points = synthetic::scan(synthetic::table());
  synthetic::erase_ring(points, 30);
  folder.write_records("scans/velodyne/000001.bin", points);
  auto reader = ScanReader::open(folder.path() / "scans");
  ASSERT_TRUE(reader);
  scan::KittiScan scan;
  scan::RingRecovery rings;
  EXPECT_FALSE(reader->read(1, scan, rings));  // nothing to align by yet
  ASSERT_TRUE(reader->fit_rings());
  ASSERT_TRUE(reader->read(1, scan, rings));
  EXPECT_EQ(rings.no_ring, 0U);
  EXPECT_EQ(rings.ring_of_point.back(), 63);
}

TEST(ScanReader, TellsRingsWhereNoScanOfTheFolderHasAll) {
  const test::ScratchFolder folder;
  // What a camera sees of the scans: 45 degrees to either side, and the upper rings see nothing.
  constexpr int kMissing = 18, kSeen = scan::kScanRings - kMissing;
  const scan::RingTable truth = synthetic::table();
  for (int scan = 0; scan < 3; ++scan) {
    auto points = synthetic::scan(truth);
    points.erase(points.begin(), points.begin() + std::ptrdiff_t{kMissing} * 2000);
    points = synthetic::cropped(points, [](double deg) { return std::abs(deg) < 45; });
    ASSERT_EQ(points.size() % kSeen, 0U);
    points.push_back({});
    folder.write_records("scans/00000" + std::to_string(scan) + ".bin", points);
  }
  auto reader = ScanReader::open(folder.path() / "scans");
  ASSERT_TRUE(reader);
  const auto fitted = reader->fit_rings();
  ASSERT_TRUE(fitted) << fitted.error().message;
  EXPECT_TRUE(fitted->from_nominal_table);
  scan::KittiScan scan;
  scan::RingRecovery rings;
  ASSERT_TRUE(reader->read(2, scan, rings));
  EXPECT_EQ(rings.no_ring, 1U);
  EXPECT_EQ(rings.ring_of_point.back(), scan::kNoRing);
  const std::size_t per_ring = scan.points.size() / kSeen;
  int last = -1;
  for (int seen = 0; seen < kSeen; ++seen) {
    const std::size_t first = static_cast<std::size_t>(seen) * per_ring;
    const int ring = rings.ring_of_point[first];
    EXPECT_GT(ring, last) << "a row of its own, in order";
    last = ring;
    EXPECT_EQ(rings.ring_of_point[first + per_ring - 1], ring);
    // The nominal unit's lasers sit up to 4 cm off, which is 0.5 degrees where they look nearest.
    EXPECT_NEAR(fitted->table[static_cast<std::size_t>(ring)].elevation_rad,
                truth[static_cast<std::size_t>(kMissing + seen)].elevation_rad,
                beams::deg_to_rad(0.5));
  }
}

}  // namespace
}  // namespace terracut::encode
