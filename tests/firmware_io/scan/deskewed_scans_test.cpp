// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Recorded scans as they were measured, from a moving sensor, with the vehicle's motion on a CAN
// log beside their packets: brought back to one instant they are the compensated scans again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "recorded_sequences.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/vehicle_log_reader.hpp"
#include "tools/lab/drive/vehicle_log.hpp"
#include "tools/lab/encode/scan_drive.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::scan {
namespace {

namespace fs = std::filesystem;

struct Drive {
  fs::path pcap;
  hdl64e::Hdl64eCalibration calibration;
};

/// Decodes, moved to each frame's middle where there is a CAN log and `deskew`; visits every frame.
template <class Visit>
void decode(const Drive& drive, bool deskew, Visit&& visit) {
  memory::FixedMemory memory;
  vehicle::EgoMotion motion({}, memory);
  std::vector<vehicle::MotionSample> samples;
  decode::Decoder::Config config;
  if (deskew) {
    config.motion = &motion;
    config.deskew_at = frame::FrameInstant::kMiddle;
    samples = test::samples_of(test::content_of(drive::can_log_path_of(drive.pcap)));
  }
  decode::Decoder decoder(drive.calibration, {}, config, memory);
  auto source = capture::CaptureSource::open(drive.pcap);
  ASSERT_TRUE(source);
  auto next = samples.begin();
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
    EXPECT_EQ(info.deskew.state, deskew ? frame::DeskewState::kDone : frame::DeskewState::kOff);
    visit(info, image);
  };
  for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
    for (; next != samples.end() && next->stamp_ns <= (*datagram)->stamp_ns; ++next) {
      EXPECT_TRUE(motion.add(*next));
    }
    test::decode(decoder, **datagram, on_frame);
  }
  test::end_stream(decoder, on_frame);
}

quality::Quality label(const Drive& drive, bool deskew) {
  quality::Quality quality;
  memory::FixedMemory memory;
  std::unique_ptr<ground::Segmenter> segmenter;
  const auto profile = mount::ring_profile(drive.calibration, {});
  decode(drive, deskew, [&](const frame::FrameInfo& info, const frame::RangeImage& image) {
    if (!segmenter) {
      segmenter = std::make_unique<ground::Segmenter>(
          ground::terracut_profile(), profile, image.shape(), image.return_capacity(), memory);
    }
    std::vector<std::uint32_t> truth;
    const fs::path file =
        drive::truth_folder_of(drive.pcap) / fmt::format("{:06}.label", info.number);
    EXPECT_TRUE(read_label_file(file, image.returns(), truth));
    (void)segmenter->segment(image);
    quality += quality::measure(segmenter->labels(), truth);
  });
  return quality;
}

Drive encode(const fs::path& sequence, const fs::path& pcap, bool twisted) {
  encode::ScanDriveOptions options;
  options.motion = twisted ? encode::PutMotionBack::kWhereKnown : encode::PutMotionBack::kNever;
  options.can_log = twisted;
  const auto report = encode::encode_scan_folder(sequence, pcap, options);
  EXPECT_TRUE(report) << report.error().message;
  return {pcap, report->calibration};
}

/// The points of a scan in boxes, to find the nearest.
class Cloud {
 public:
  /// Rotated by 180 degrees, as the sensor of a drive with a CAN log is; in the vehicle frame.
  explicit Cloud(const std::vector<ScanPoint>& points) {
    for (const ScanPoint& p : points) {
      const Point at{-p.x_m, -p.y_m, p.z_m + static_cast<float>(mount::Mount{}.height_m)};
      boxes_[box_of(at, 0, 0, 0)].push_back(at);
    }
  }
  /// To the nearest point; no more than about kBox_m.
  [[nodiscard]] double distance_m(const frame::Return& point) const {
    float nearest_m2 = kBox_m * kBox_m;
    for (int i = 0; i < 27; ++i) {
      const auto box = boxes_.find(
          box_of({point.x_m, point.y_m, point.z_m}, i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
      if (box == boxes_.end()) continue;
      for (const Point& p : box->second) {
        const float x_m = p[0] - point.x_m, y_m = p[1] - point.y_m, z_m = p[2] - point.z_m;
        nearest_m2 = std::min(nearest_m2, x_m * x_m + y_m * y_m + z_m * z_m);
      }
    }
    return std::sqrt(nearest_m2);
  }

 private:
  using Point = std::array<float, 3>;
  static constexpr float kBox_m = 2;
  static std::array<int, 3> box_of(const Point& p, int dx, int dy, int dz) {
    const auto at = [](float m) { return static_cast<int>(std::floor(m / kBox_m)); };
    return {at(p[0]) + dx, at(p[1]) + dy, at(p[2]) + dz};
  }
  std::map<std::array<int, 3>, std::vector<Point>> boxes_;
};

/// How far the returns of a drive lie from the points of their scans, 95th percentile.
double distance_p95_m(const Drive& drive, const fs::path& sequence, bool deskew) {
  const auto folder = list_scan_folder(sequence);
  EXPECT_TRUE(folder);
  std::vector<double> distances_m;
  decode(drive, deskew, [&](const frame::FrameInfo& info, const frame::RangeImage& image) {
    if (info.number % 5 != 1) return;
    KittiScan scan;
    EXPECT_TRUE(read_kitti_scan(folder->scans[info.number].points, scan));
    const Cloud cloud(scan.points);
    frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
      // Poles, walls and bumpers near by: there the nearest point is as good as the same.
      const frame::Return& point = placed.point;
      if (placed.return_index % 20 != 0 || point.ground_range_m > 20 || point.z_m < 0.5F) return;
      distances_m.push_back(cloud.distance_m(point));
    });
  });
  const auto p95 = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() * 95 / 100);
  std::nth_element(distances_m.begin(), p95, distances_m.end());
  return *p95;
}

TEST(DeskewedScans, ReturnsLieWhereTheCompensatedScansHaveThem) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    const test::ScratchFolder folder;
    const Drive twisted = encode(sequence, folder.path() / "twisted.pcap", true);
    const double as_seen_m = distance_p95_m(twisted, sequence, false);
    const double deskewed_m = distance_p95_m(twisted, sequence, true);
    std::cout << fmt::format("{}: p95 {:.3f} m as seen, {:.3f} m deskewed\n",
                             sequence.filename().string(), as_seen_m, deskewed_m);
    EXPECT_LT(deskewed_m, 0.5 * as_seen_m);
  }
}

TEST(DeskewedScans, TwistedPacketsAndTheCanLogGiveTheLabelsOfTheCompensatedScans) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  double compensated_iou = 0, compensated_recall = 0, deskewed_iou = 0, deskewed_recall = 0;
  const auto share = 1 / static_cast<double>(sequences.size());
  for (const auto& sequence : sequences) {
    const test::ScratchFolder folder;
    const Drive recorded = encode(sequence, folder.path() / "recorded.pcap", false);
    const Drive twisted = encode(sequence, folder.path() / "twisted.pcap", true);
    const quality::Quality compensated = label(recorded, false);
    const quality::Quality as_seen = label(twisted, false);
    const quality::Quality deskewed = label(twisted, true);
    for (const auto& [name, quality] :
         {std::pair{"compensated", compensated}, std::pair{"as seen", as_seen},
          std::pair{"deskewed", deskewed}}) {
      std::cout << fmt::format("{}, {}: IoU_g {:.2f}, Recall_o {:.2f}\n",
                               sequence.filename().string(), name, 100 * quality.iou_ground(),
                               100 * quality.recall_key_obstacles());
    }
    compensated_iou += share * compensated.iou_ground();
    compensated_recall += share * compensated.recall_key_obstacles();
    deskewed_iou += share * deskewed.iou_ground();
    deskewed_recall += share * deskewed.recall_key_obstacles();
  }
  std::cout << fmt::format(
      "mean of the sequences: IoU_g {:.2f} compensated, {:.2f} deskewed; Recall_o {:.2f}, {:.2f}\n",
      100 * compensated_iou, 100 * deskewed_iou, 100 * compensated_recall, 100 * deskewed_recall);
  EXPECT_GT(deskewed_iou, compensated_iou - 0.005);
  EXPECT_GT(deskewed_recall, compensated_recall - 0.005);
}

}  // namespace
}  // namespace terracut::scan
