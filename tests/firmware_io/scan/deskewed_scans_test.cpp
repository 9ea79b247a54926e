// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Recorded scans as they were measured, from a moving sensor, with the vehicle's motion on a CAN
// log beside their packets: brought back to one instant they are the compensated scans again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/ring_profile.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/hdl64e/hdl64e_decoder.hpp"
#include "firmware_io/motion/ego_motion.hpp"
#include "firmware_io/motion/vehicle_log.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "firmware_io/scan/scan_drive.hpp"
#include "firmware_io/sinks/each_return.hpp"
#include "pipeline/profile.hpp"
#include "pipeline/quality.hpp"
#include "pipeline/segmenter.hpp"
#include "tests/firmware_io/scan/recorded_sequences.hpp"
#include "tests/firmware_io/scan/scratch_folder.hpp"
#include "tests/support/vehicle_log_reader.hpp"

namespace terracut::firmware_io {
namespace {

namespace fs = std::filesystem;

struct Drive {
  fs::path pcap;
  calib::Hdl64eCalibration calibration;
};

/// Decodes, moved to each turn's middle where there is a CAN log and `deskew`; visits every turn.
template <class Visit>
void decode(const Drive& drive, bool deskew, Visit&& visit) {
  rt::FixedMemory memory;
  EgoMotion motion({}, memory);
  std::vector<MotionSample> samples;
  Hdl64eDecoder::Config config;
  if (deskew) {
    config.motion = &motion;
    config.deskew_at = TurnInstant::kMiddle;
    std::ifstream log(can_log_path_of(drive.pcap));
    samples = test::samples_of({std::istreambuf_iterator<char>(log), {}});
  }
  Hdl64eDecoder decoder(drive.calibration, {}, config, memory);
  auto source = PcapSource::open(drive.pcap);
  ASSERT_TRUE(source);
  auto next = samples.begin();
  const auto on_frame = [&](const FrameInfo& info, const pipeline::RangeImage& image) noexcept {
    EXPECT_EQ(info.deskew.state, deskew ? DeskewState::kDone : DeskewState::kOff);
    visit(info, image);
  };
  for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
    for (; next != samples.end() && next->stamp_ns <= (*datagram)->stamp_ns; ++next) {
      EXPECT_TRUE(motion.add(*next));
    }
    decoder.decode(**datagram, on_frame);
  }
  decoder.flush(on_frame);
}

pipeline::Quality label(const Drive& drive, bool deskew) {
  pipeline::Quality quality;
  rt::FixedMemory memory;
  std::unique_ptr<pipeline::Segmenter> segmenter;
  const auto profile = calib::ring_profile(drive.calibration, {});
  decode(drive, deskew, [&](const FrameInfo& info, const pipeline::RangeImage& image) {
    if (!segmenter) {
      segmenter = std::make_unique<pipeline::Segmenter>(
          pipeline::terracut_profile(), profile, image.shape(), image.return_capacity(), memory);
    }
    std::vector<std::uint32_t> truth;
    const fs::path file = truth_folder_of(drive.pcap) / fmt::format("{:06}.label", info.number);
    EXPECT_TRUE(read_label_file(file, image.returns(), truth));
    (void)segmenter->segment(image);
    quality += pipeline::measure(segmenter->labels(), truth);
  });
  return quality;
}

Drive encode(const fs::path& sequence, const fs::path& pcap, bool twisted) {
  ScanDriveOptions options;
  options.undo_compensation = options.can_log = twisted;
  const auto report = encode_scan_folder(sequence, pcap, options);
  EXPECT_TRUE(report) << report.error().message;
  return {pcap, report->calibration};
}

TEST(DeskewedScans, TwistedPacketsAndTheCanLogGiveTheLabelsOfTheCompensatedScans) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  double compensated_iou = 0, compensated_recall = 0, deskewed_iou = 0, deskewed_recall = 0;
  const auto share = 1 / static_cast<double>(sequences.size());
  for (const auto& sequence : sequences) {
    const ScratchFolder folder;
    const Drive recorded = encode(sequence, folder.path() / "recorded.pcap", false);
    const Drive twisted = encode(sequence, folder.path() / "twisted.pcap", true);
    const pipeline::Quality compensated = label(recorded, false);
    const pipeline::Quality as_seen = label(twisted, false);
    const pipeline::Quality deskewed = label(twisted, true);
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
}  // namespace terracut::firmware_io
