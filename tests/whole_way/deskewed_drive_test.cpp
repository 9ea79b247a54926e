// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A vehicle that drives and frames while its sensor's head does: from the simulated world through
// packets and the decoder, with the vehicle's motion beside them, to places and labels.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/drive/truth_frames.hpp"
#include "tools/lab/quality/quality.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::whole_way {
namespace {

namespace fs = std::filesystem;

using Point = std::array<double, 3>;

/// T^-1 p
Point back(const mount::RigidTransform& T, const Point& p) {
  const std::array<double, 3> d{p[0] - T[3], p[1] - T[7], p[2] - T[11]};
  Point q{};
  for (std::size_t i = 0; i < 3; ++i) q[i] = T[i] * d[0] + T[4 + i] * d[1] + T[8 + i] * d[2];
  return q;
}

/// Distances, for their 95th percentile and greatest.
struct Distances {
  std::vector<double> all_m;
  [[nodiscard]] double p95_m() {
    const auto at = all_m.begin() + static_cast<std::ptrdiff_t>(all_m.size() * 95 / 100);
    std::nth_element(all_m.begin(), at, all_m.end());
    return *at;
  }
  [[nodiscard]] double most_m() const { return *std::max_element(all_m.begin(), all_m.end()); }
};

void print(const std::string& drive, Distances& as_seen, Distances& deskewed) {
  std::cout << fmt::format("{}: p95 {:.3f} m as seen, {:.4f} m deskewed, at most {:.3f} m\n", drive,
                           as_seen.p95_m(), deskewed.p95_m(), deskewed.most_m());
}

template <class EncoderTraits>
simulator::SimulationConfig<EncoderTraits> fast_bend(const std::string& scene, int frames) {
  simulator::SimulationConfig<EncoderTraits> config;
  config.scene = scene;
  config.duration_s = 0.1 * frames;
  config.speed_mps = 20;
  config.yaw_rate_radps = 0.5;
  config.threads = 2;
  return config;
}

class DeskewedDrive : public test::InScratchFolder {
 protected:
  [[nodiscard]] fs::path pcap() const { return folder_ / "drive.pcap"; }

  template <class EncoderTraits>
  void write(const simulator::SimulationConfig<EncoderTraits>& config) {
    in_world_.clear();
    const auto poses = simulator::simulated_poses(config);
    ASSERT_TRUE(poses) << poses.error().message;
    const mount::RigidTransform T_vehicle_lidar = mount::T_vehicle_lidar(config.mount);
    auto writer =
        drive::DriveWriter<EncoderTraits>::create(pcap(), config.calibration, config.sensor);
    ASSERT_TRUE(writer) << writer.error().message;
    // Returns are sorted into frames as their truth is; here each is told by its number.
    drive::TruthFrames<EncoderTraits> frames(EncoderTraits::offsets(config.calibration),
                                             config.sensor.returns);
    const auto group_size =
        static_cast<std::size_t>(EncoderTraits::firings_per_group(config.sensor.returns) *
                                 packets::returns_per_firing(config.sensor.returns));
    std::vector<typename EncoderTraits::Column> group;
    std::vector<std::uint32_t> numbers;
    std::vector<Point> in_world;
    const auto take = [&] {
      std::vector<Point>& frame = in_world_.emplace_back();
      for (const std::uint32_t number : numbers) frame.push_back(in_world[number]);
    };
    const auto done = simulator::simulate_drive(
        config, [&](const simulator::SimulatedColumn<EncoderTraits>& column) -> Status {
          const mount::RigidTransform T_world_vehicle = (*poses)(column.wire.stamp_ns);
          group.push_back(column.wire);
          for (std::size_t i = 0; i < column.exact.size(); ++i) {
            if (column.wire.by_laser[i].raw == 0) continue;
            const beams::Point& exact = column.exact[i];
            const Point p = mount::apply(T_vehicle_lidar, exact.x_m, exact.y_m, exact.z_m);
            group.back().by_laser[i].truth = static_cast<std::uint32_t>(in_world.size());
            in_world.push_back(mount::apply(T_world_vehicle, p[0], p[1], p[2]));
          }
          if (group.size() == group_size) {
            frames.add(group);
            group.clear();
            while (frames.take_finished(numbers)) take();
          }
          return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                    column.wire.by_laser);
        });
    while (frames.take_any(numbers)) take();
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_TRUE(writer->finish());
  }

  /// Decodes with or without the vehicle's motion beside the packets.
  template <class EncoderTraits, class OnFrame>
  void decode(const simulator::SimulationConfig<EncoderTraits>& config,
              std::optional<frame::FrameInstant> at, OnFrame&& on_frame) {
    memory::FixedMemory memory;
    vehicle::EgoMotion motion({}, memory);
    const auto samples = simulator::simulated_motion(config);
    ASSERT_TRUE(samples) << samples.error().message;
    decode::Decoder::Config settings;
    if (at) {
      settings.motion = &motion;
      settings.deskew_at = *at;
    }
    decode::Decoder decoder(config.calibration, config.mount, settings, memory);
    auto source = capture::CaptureSource::open(pcap());
    ASSERT_TRUE(source);
    auto next_sample = samples->begin();
    for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
      for (; next_sample != samples->end() && next_sample->stamp_ns <= (*datagram)->stamp_ns;
           ++next_sample) {
        motion.add(*next_sample);
      }
      test::decode(decoder, **datagram, on_frame);
    }
    test::end_stream(decoder, on_frame);
  }

  struct Labelled {
    quality::Quality quality;
    std::vector<std::vector<frame::Label>> frames;
  };
  template <class EncoderTraits>
  Labelled label(const simulator::SimulationConfig<EncoderTraits>& config,
                 std::optional<frame::FrameInstant> at) {
    Labelled labelled;
    memory::FixedMemory memory;
    const decode::Decoder of_sensor(config.calibration, config.mount, {}, memory);
    ground::Segmenter segmenter(ground::terracut_profile(),
                                ring_profile(config.calibration, config.mount), of_sensor.shape(),
                                of_sensor.return_capacity(), memory);
    frame::PointImage as_seen = of_sensor.point_image(memory);
    decode(config, at,
           [&](const frame::FrameInfo& info, const frame::MeasuredReturns& returns) noexcept {
             EXPECT_EQ(info.deskew.state,
                       at ? frame::DeskewState::kDone : frame::DeskewState::kOff);
             std::vector<std::uint32_t> truth;
             const fs::path file =
                 drive::truth_folder_of(pcap()) / fmt::format("{:06}.label", info.number);
             EXPECT_TRUE(scan::read_label_file(file, returns.returns(), truth));
             (void)segmenter.segment(as_seen.make(returns));
             const auto labels = segmenter.labels();
             labelled.quality += quality::measure(labels, truth);
             labelled.frames.emplace_back(labels.begin(), labels.end());
           });
    return labelled;
  }

  /// How far decoded returns lie from where they would have been seen at the frames' instants, if
  /// the vehicle had stood there.
  template <class EncoderTraits>
  Distances distances(const simulator::SimulationConfig<EncoderTraits>& config,
                      std::optional<frame::FrameInstant> at, frame::FrameInstant wanted) {
    Distances distances;
    const auto poses = simulator::simulated_poses(config);
    const auto frame_period_ns = static_cast<std::int64_t>(1e9 / config.spin_hz);
    decode(config, at, [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
      EXPECT_EQ(info.deskew.state, at ? frame::DeskewState::kDone : frame::DeskewState::kOff);
      // A drive starts a little before the head passes straight ahead; frame 0 begins there.
      const double share = wanted == frame::FrameInstant::kStart ? 0
                           : wanted == frame::FrameInstant::kEnd ? 1
                                                                 : 0.5;
      const std::int64_t reference_ns =
          seam_ns(config) +
          std::llround((info.number + share) * static_cast<double>(frame_period_ns));
      if (at) {
        EXPECT_NEAR(static_cast<double>(info.deskew.reference_ns - reference_ns), 0, 30'000);
      }
      const mount::RigidTransform T_world_vehicle = (*poses)(reference_ns);
      frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
        const Point truth = back(T_world_vehicle, in_world_[info.number][placed.return_index]);
        distances.all_m.push_back(std::hypot(
            placed.point.x_m - truth[0], placed.point.y_m - truth[1], placed.point.z_m - truth[2]));
      });
    });
    return distances;
  }
  /// When the head first passes straight ahead.
  template <class EncoderTraits>
  static std::int64_t seam_ns(const simulator::SimulationConfig<EncoderTraits>& config) {
    std::int64_t seam_ns = 0;
    const auto sink = [&](const simulator::SimulatedColumn<EncoderTraits>& column) -> Status {
      seam_ns = column.wire.stamp_ns - std::llround(column.time_s * 1e9);
      return fail(ErrorCode::kNothingCameOut, "enough");
    };
    EXPECT_FALSE(simulator::simulate_drive(config, sink));
    return seam_ns;
  }
  std::vector<std::vector<Point>> in_world_;  ///< Of each frame's returns, in order of arrival.
};

TEST_F(DeskewedDrive, ReturnsLieWithinCentimetresOfTheUnmovingTruth) {
  for (const frame::FrameInstant at :
       {frame::FrameInstant::kStart, frame::FrameInstant::kMiddle, frame::FrameInstant::kEnd}) {
    const auto config = fast_bend<packets::Hdl64eEncoderTraits>("flat", 2);
    write(config);
    Distances as_seen = distances(config, std::nullopt, at);
    Distances deskewed = distances(config, at, at);
    print("HDL-64E, flat", as_seen, deskewed);
    EXPECT_GT(as_seen.p95_m(), 1.0);
    EXPECT_LT(deskewed.p95_m(), 0.005);
    EXPECT_LT(deskewed.most_m(), 0.02);
  }
  for (const packets::ReturnMode returns :
       {packets::ReturnMode::kSingle, packets::ReturnMode::kDual}) {
    auto config = fast_bend<packets::Ruby128EncoderTraits>("flat", 2);
    config.sensor.returns = returns;
    write(config);
    Distances as_seen = distances(config, std::nullopt, frame::FrameInstant::kEnd);
    Distances deskewed = distances(config, frame::FrameInstant::kEnd, frame::FrameInstant::kEnd);
    print("RS-Ruby128, flat", as_seen, deskewed);
    EXPECT_LT(deskewed.p95_m(), 0.005);
    EXPECT_LT(deskewed.most_m(), 0.02);
  }
}

TEST_F(DeskewedDrive, OnUnevenRoadsWhatIsLeftIsTheRollAndPitchThatSpeedAndYawRateDoNotTell) {
  for (const auto& [scene, allowed_m] : {std::pair{"street", 0.03}, std::pair{"highway", 0.06},
                                         std::pair{"rural", 0.1}, std::pair{"hill", 0.3}}) {
    const auto config = fast_bend<packets::Hdl64eEncoderTraits>(scene, 2);
    write(config);
    Distances as_seen = distances(config, std::nullopt, frame::FrameInstant::kEnd);
    Distances deskewed = distances(config, frame::FrameInstant::kEnd, frame::FrameInstant::kEnd);
    print(fmt::format("HDL-64E, {}", scene), as_seen, deskewed);
    EXPECT_LT(deskewed.p95_m(), allowed_m);
    EXPECT_GT(as_seen.p95_m(), 10 * deskewed.p95_m());
  }
}

TEST_F(DeskewedDrive, LabelsAreThoseOfReturnsAsSeenAndAsGoodAsOfTheSameScenesStandingStill) {
  const auto print_quality = [](std::string_view scene, std::string_view how,
                                const quality::Quality& quality) {
    std::cout << fmt::format("{}, {}: IoU_g {:.2f}, Recall_o {:.2f}\n", scene, how,
                             100 * quality.iou_ground(), 100 * quality.recall_key_obstacles());
  };
  quality::Quality standing, moving;
  const auto add = [&](quality::Quality& sum, std::string_view scene, std::string_view how,
                       const quality::Quality& quality) {
    print_quality(scene, how, quality);
    sum += quality;
  };
  for (const char* scene : {"street", "highway", "rural", "flat", "hill"}) {
    auto config = fast_bend<packets::Hdl64eEncoderTraits>(scene, 2);
    config.motion_within_frame = false;
    write(config);
    add(standing, scene, "standing", label(config, std::nullopt).quality);
    config.motion_within_frame = true;
    write(config);
    const Labelled as_seen = label(config, std::nullopt);
    add(moving, scene, "moving", as_seen.quality);
    EXPECT_TRUE(label(config, frame::FrameInstant::kEnd).frames == as_seen.frames);
  }
  print_quality("all", "standing", standing);
  print_quality("all", "moving", moving);
  EXPECT_GT(moving.iou_ground(), standing.iou_ground() - 0.005);
  EXPECT_GT(moving.recall_key_obstacles(), standing.recall_key_obstacles() - 0.005);
}

TEST_F(DeskewedDrive, WithoutSamplesTheFramesSayNoEgoMotionAndAreAsSeen) {
  const auto config = fast_bend<packets::Hdl64eEncoderTraits>("flat", 1);
  write(config);
  memory::FixedMemory memory;
  vehicle::EgoMotion motion({}, memory);
  decode::Decoder::Config settings;
  settings.motion = &motion;
  decode::Decoder deskewing(config.calibration, config.mount, settings, memory);
  decode::Decoder plain(config.calibration, config.mount, {}, memory);
  std::vector<float> places, plain_places;
  const auto into = [](std::vector<float>& x_m, frame::DeskewState expected) {
    return [&x_m, expected](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
      EXPECT_EQ(info.deskew.state, expected);
      frame::for_each_return(
          image, [&](const frame::PlacedReturn& placed) { x_m.push_back(placed.point.x_m); });
    };
  };
  auto source = capture::CaptureSource::open(pcap());
  ASSERT_TRUE(source);
  const auto on_frame = into(places, frame::DeskewState::kNoEgoMotion);
  const auto on_plain_frame = into(plain_places, frame::DeskewState::kOff);
  for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
    test::decode(deskewing, **datagram, on_frame);
    test::decode(plain, **datagram, on_plain_frame);
  }
  test::end_stream(deskewing, on_frame);
  test::end_stream(plain, on_plain_frame);
  EXPECT_GT(places.size(), 50'000U);
  EXPECT_EQ(places, plain_places);
}

}  // namespace
}  // namespace terracut::whole_way
