// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/simulator/drive.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <set>
#include <vector>

#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "tests/support/no_threads.hpp"
#include "tools/lab/scenes/scene.hpp"

namespace terracut::simulator {
namespace {

std::vector<Hdl64eSimulatedColumn> drive(const Hdl64eSimulation& config) {
  std::vector<Hdl64eSimulatedColumn> columns;
  const auto summary = simulate_drive(config, [&](const Hdl64eSimulatedColumn& column) -> Status {
    columns.push_back(column);
    return {};
  });
  EXPECT_TRUE(summary) << summary.error().message;
  return columns;
}

Hdl64eSimulation one_frame(const std::string& scene) {
  Hdl64eSimulation config;
  config.scene = scene;
  config.duration_s = 0.1;
  config.threads = 2;
  return config;
}

/// Calls visit(column, laser, wire, exact point) for each return.
template <class Visit>
void for_each_return(const std::vector<Hdl64eSimulatedColumn>& columns, Visit&& visit) {
  for (const Hdl64eSimulatedColumn& column : columns) {
    for (int laser = 0; laser < hdl64e::kHdl64eLasers; ++laser) {
      const auto i = static_cast<std::size_t>(laser);
      if (column.wire.by_laser[i].raw != 0)
        visit(column, laser, column.wire.by_laser[i], column.exact[i]);
    }
  }
}

std::uint64_t digest(const std::vector<Hdl64eSimulatedColumn>& columns) {
  std::uint64_t sum = 0;
  for_each_return(columns, [&](const Hdl64eSimulatedColumn& column, int laser,
                               const packets::LabelledReturn& wire, const beams::Point&) {
    sum = sum * 0x9E3779B97F4A7C15U +
          static_cast<std::uint64_t>(column.wire.unwrapped_azimuth_cdeg) +
          static_cast<std::uint64_t>(laser) * 77 + wire.raw * 3U + wire.intensity * 5U + wire.truth;
  });
  return sum;
}

TEST(DriveOnThreads, SameSeedGivesTheSameReturnsOnAnyNumberOfThreads) {
  Hdl64eSimulation config = one_frame("street");
  config.threads = 1;
  const std::uint64_t alone = digest(drive(config));
  config.threads = 3;
  EXPECT_EQ(digest(drive(config)), alone);
  {
    const test::NoThreads refused;
    EXPECT_EQ(digest(drive(config)), alone);
  }
  config.seed = 2;
  EXPECT_NE(digest(drive(config)), alone);
}

TEST(LongDrive, LongerDriveStartsLikeAShorterOne) {
  Hdl64eSimulation config = one_frame("street");
  auto brief = drive(config);
  config.duration_s = 0.2;
  auto longer = drive(config);
  const std::size_t first_frame = 2000;  // Columns before the run-out of the shorter one.
  ASSERT_GT(brief.size(), first_frame);
  brief.resize(first_frame);
  longer.resize(first_frame);
  EXPECT_EQ(digest(brief), digest(longer));
}

TEST(Drive, GroundOfTheFlatSceneIsExactlyTheMountingHeightBelow) {
  Hdl64eSimulation config = one_frame("flat");
  config.effects = SensorEffects::none();
  config.mount.height_m = 2.1;
  std::size_t ground = 0;
  for_each_return(drive(config),
                  [&](const Hdl64eSimulatedColumn&, int, const packets::LabelledReturn& wire,
                      const beams::Point& exact) {
                    if (wire.truth != static_cast<std::uint32_t>(world::Truth::kRoad)) return;
                    ++ground;
                    EXPECT_NEAR(exact.z_m, -2.1, 1e-6);
                  });
  EXPECT_GT(ground, 90000U);
}

TEST(Drive, GroundIsLevelInTheVehicleFrameOfATiltedMount) {
  Hdl64eSimulation config = one_frame("flat");
  config.effects = SensorEffects::none();
  config.mount = {.height_m = 1.8, .roll_rad = 0.03, .pitch_rad = 0.06};
  const mount::RigidTransform T = mount::T_vehicle_lidar(config.mount);
  for_each_return(drive(config),
                  [&](const Hdl64eSimulatedColumn&, int, const packets::LabelledReturn& wire,
                      const beams::Point& exact) {
                    if (wire.truth != static_cast<std::uint32_t>(world::Truth::kRoad)) return;
                    EXPECT_NEAR(mount::apply(T, exact.x_m, exact.y_m, exact.z_m)[2], 0, 1e-6);
                  });
}

TEST(Drive, RangeNoiseOnTheGroundIsThatOfTheConfiguration) {
  Hdl64eSimulation config = one_frame("flat");
  config.effects = SensorEffects::none();
  config.effects.range_noise_m = 0.02;
  double squares = 0;
  double count = 0;
  for_each_return(
      drive(config), [&](const Hdl64eSimulatedColumn&, int, const packets::LabelledReturn& wire,
                         const beams::Point& exact) {
        if (wire.truth != static_cast<std::uint32_t>(world::Truth::kRoad)) return;
        const double range_m = std::hypot(exact.x_m, exact.y_m, exact.z_m);
        const double error_m = (exact.z_m + config.mount.height_m) * range_m / exact.z_m;
        squares += error_m * error_m;
        ++count;
      });
  // Beams start up to 0.2 m above the origin, so their slope is a little different.
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.003);
}

TEST(Drive, WireValuesDecodeToTheExactPointsWithinTheirRounding) {
  Hdl64eSimulation config = one_frame("street");
  const hdl64e::Hdl64eGeometry geometry(config.calibration);
  const auto columns = drive(config);
  double worst_m = 0;
  for (std::size_t first = 0; first < columns.size(); first += 6) {
    // As a decoder does: from the six wire azimuths of a packet.
    const auto wrapped = [&](std::size_t i) {
      return beams::wrap_cdeg(columns[first + i].wire.unwrapped_azimuth_cdeg);
    };
    const std::int32_t step_ticks = hdl64e::column_step_ticks(wrapped(0), wrapped(5));
    for (std::size_t i = 0; i < 6; ++i) {
      for (int laser = 0; laser < hdl64e::kHdl64eLasers; ++laser) {
        const auto l = static_cast<std::size_t>(laser);
        const packets::LabelledReturn& wire = columns[first + i].wire.by_laser[l];
        if (wire.raw == 0) continue;
        const double azimuth_rad =
            packet::firing_azimuth_rad(wrapped(i), hdl64e::firing_advance_ticks(step_ticks, laser));
        const beams::Point decoded = geometry.point(laser, azimuth_rad, wire.raw);
        const beams::Point& exact = columns[first + i].exact[l];
        worst_m = std::max(worst_m, std::hypot(decoded.x_m - exact.x_m, decoded.y_m - exact.y_m,
                                               decoded.z_m - exact.z_m));
      }
    }
  }
  EXPECT_LE(worst_m, 0.0011);  // Half a count of 2 mm, a little more where the beam is bent.
  EXPECT_GT(worst_m, 0.0005);
}

TEST(Drive, BoxesOfTheFlatSceneAreSeenWithTheirClassAndNowhereElse) {
  Hdl64eSimulation config = one_frame("flat");
  config.effects = SensorEffects::none();
  config.speed_mps = 0;
  for (const scenes::FlatSceneBox& known : scenes::flat_scene_boxes()) {
    const auto truth = static_cast<std::uint32_t>(known.truth);
    double low_m = 1e9, high_m = -1e9;
    std::size_t seen = 0;
    for_each_return(drive(config), [&](const Hdl64eSimulatedColumn&, int,
                                       const packets::LabelledReturn& wire,
                                       const beams::Point& exact) {
      const double dx = std::abs(exact.x_m - known.x_m) - known.length_m / 2;
      const double dy = std::abs(exact.y_m - known.y_m) - known.width_m / 2;
      const double z_m = exact.z_m + config.mount.height_m;
      if (scan::semantic_class(wire.truth) == truth) {
        ++seen;
        EXPECT_LT(std::max(dx, dy), 0.1) << "truth " << truth;
        low_m = std::min(low_m, z_m);
        high_m = std::max(high_m, z_m);
      } else {
        EXPECT_FALSE(dx < -0.1 && dy < -0.1) << "truth " << wire.truth << " inside of " << truth;
      }
    });
    EXPECT_GT(seen, 20U) << "truth " << truth;
    EXPECT_GT(low_m, -0.02);
    EXPECT_LT(high_m, known.height_m + 0.02);
    EXPECT_GT(high_m, std::min(known.height_m, 1.7) - 0.3);
  }
}

TEST(Drive, EveryLaserSeesWholeFramesAndNothingOutsideOfThem) {
  Hdl64eSimulation config = one_frame("flat");
  config.duration_s = 0.2;
  config.effects = SensorEffects::none();
  const hdl64e::BeamOffsets offsets(config.calibration);
  const auto columns = drive(config);
  ASSERT_EQ(columns.size() % 6, 0U);
  EXPECT_LT(columns.front().wire.unwrapped_azimuth_cdeg, -1000);
  EXPECT_GT(columns.back().wire.unwrapped_azimuth_cdeg, 2 * beams::kRevolution_cdeg + 1000);
  std::array<std::array<int, hdl64e::kHdl64eLasers>, 2> returns{};
  for_each_return(columns, [&](const Hdl64eSimulatedColumn& column, int laser,
                               const packets::LabelledReturn&, const beams::Point&) {
    const auto at = static_cast<std::size_t>(&column - columns.data());
    const std::size_t first = at - at % 6;
    const std::int32_t step_ticks =
        hdl64e::column_step_ticks(beams::wrap_cdeg(columns[first].wire.unwrapped_azimuth_cdeg),
                                  beams::wrap_cdeg(columns[first + 5].wire.unwrapped_azimuth_cdeg));
    const auto beam = packet::beam_azimuth(column.wire.unwrapped_azimuth_cdeg,
                                           offsets.offset_ticks(step_ticks, laser));
    ASSERT_GE(beam.frame, 0);
    ASSERT_LT(beam.frame, 2);
    ++returns[static_cast<std::size_t>(beam.frame)][static_cast<std::size_t>(laser)];
  });
  // The lowest lasers always meet the ground.
  const auto& lasers = config.calibration.lasers;
  for (std::size_t laser = 0; laser < lasers.size(); ++laser) {
    if (lasers[laser].vert_correction_rad > -0.15) continue;
    EXPECT_NEAR(returns[0][laser], 2083, 1.5) << "laser " << laser;
    EXPECT_NEAR(returns[1][laser], 2083, 1.5) << "laser " << laser;
  }
}

TEST(Drive, AzimuthsAndStampsAdvanceLikeARotatingHead) {
  for (const double spin_hz : {5.0, 10.0, 20.0}) {
    Hdl64eSimulation config = one_frame("flat");
    config.spin_hz = spin_hz;
    const auto columns = drive(config);
    const double step_cdeg = 360e2 * spin_hz * 48e-6;
    for (std::size_t i = 1; i < columns.size(); ++i) {
      const auto step = static_cast<double>(columns[i].wire.unwrapped_azimuth_cdeg -
                                            columns[i - 1].wire.unwrapped_azimuth_cdeg);
      EXPECT_NEAR(step, step_cdeg, 1.0);
      EXPECT_EQ(columns[i].wire.stamp_ns - columns[i - 1].wire.stamp_ns, 48000);
    }
  }
}

TEST(LongDrive, WorldComesNearerAsTheVehicleMoves) {
  Hdl64eSimulation config = one_frame("flat");
  config.effects = SensorEffects::none();
  config.duration_s = 0.3;
  config.speed_mps = 10;
  const auto truck_face_m = [&](const std::vector<Hdl64eSimulatedColumn>& columns,
                                std::int64_t frame) {
    double nearest_m = 1e9;
    for_each_return(columns, [&](const Hdl64eSimulatedColumn& column, int,
                                 const packets::LabelledReturn& wire, const beams::Point& exact) {
      const std::int64_t revolution = column.wire.unwrapped_azimuth_cdeg / beams::kRevolution_cdeg;
      const bool is_truck =
          scan::semantic_class(wire.truth) == static_cast<std::uint32_t>(world::Truth::kTruck);
      if (revolution != frame || !is_truck) return;
      nearest_m = std::min(nearest_m, exact.x_m);
    });
    return nearest_m;
  };
  const auto moving = drive(config);
  // The rear stands at x = 19; straight ahead is seen at the start of each frame.
  EXPECT_NEAR(truck_face_m(moving, 0), 19.0, 0.15);
  EXPECT_NEAR(truck_face_m(moving, 2), 17.0, 0.15);

  config.motion_within_frame = false;
  const auto stepping = drive(config);
  // What is left is the bend of the beams that pass just beside the edge.
  EXPECT_NEAR(truck_face_m(stepping, 0), 19.0, 0.03);
  EXPECT_NEAR(truck_face_m(stepping, 1), 18.0, 0.03);
}

TEST(Drive, FramesAreOnePictureWhenTheWorldStandsStillDuringThem) {
  Hdl64eSimulation config = one_frame("flat");
  config.effects = SensorEffects::none();
  config.speed_mps = 20;
  const auto spread_m = [&] {
    double least_m = 1e9, most_m = -1e9;
    for_each_return(
        drive(config), [&](const Hdl64eSimulatedColumn&, int, const packets::LabelledReturn& wire,
                           const beams::Point& exact) {
          // The wall of the building that faces the road, and its front end behind the vehicle.
          if (wire.truth != static_cast<std::uint32_t>(world::Truth::kBuilding) || exact.y_m < 9.2)
            return;
          least_m = std::min(least_m, exact.x_m);
          most_m = std::max(most_m, exact.x_m);
        });
    return most_m - least_m;
  };
  config.motion_within_frame = false;
  const double still_m = spread_m();
  EXPECT_LT(still_m, 0.01);
  config.motion_within_frame = true;
  EXPECT_GT(spread_m(), still_m + 0.01);
}

class EveryScene : public ::testing::TestWithParam<std::string_view> {};

TEST_P(EveryScene, HasOnlyKnownLabelsAndRangesWithinTheLimits) {
  Hdl64eSimulation config = one_frame(std::string(GetParam()));
  const std::set<std::uint32_t> known = {10, 18, 30, 31, 40, 44, 48, 49, 50, 51, 70, 71, 72, 80};
  const hdl64e::Hdl64eGeometry geometry(config.calibration);
  const auto begin = std::chrono::steady_clock::now();
  const auto columns = drive(config);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::size_t returns = 0;
  std::size_t ground = 0;
  for_each_return(columns, [&](const Hdl64eSimulatedColumn&, int,
                               const packets::LabelledReturn& wire, const beams::Point& exact) {
    ++returns;
    EXPECT_TRUE(known.contains(scan::semantic_class(wire.truth))) << wire.truth;
    const double range_m = std::hypot(exact.x_m, exact.y_m, exact.z_m);
    EXPECT_GE(range_m, 0.9);
    EXPECT_LE(range_m, 120.0);
    ground += wire.truth == 40 || wire.truth == 44 || wire.truth == 48 || wire.truth == 49 ||
              wire.truth == 72;
  });
  const double ground_share = static_cast<double>(ground) / static_cast<double>(returns);
  EXPECT_GT(returns, 90000U);
  EXPECT_GT(ground_share, 0.35);
  EXPECT_LT(ground_share, 0.97);
  std::cout << fmt::format("{}: {} returns, {:.0f} % ground, {:.2f} s a frame on {} threads\n",
                           GetParam(), returns, 100 * ground_share, took.count(), config.threads);
}

INSTANTIATE_TEST_SUITE_P(Drive, EveryScene,
                         ::testing::ValuesIn(scenes::scene_names().begin(),
                                             scenes::scene_names().end()),
                         [](const auto& each) { return std::string(each.param); });

TEST(Drive, DropOutsAreTheAskedShareOfReturns) {
  Hdl64eSimulation config = one_frame("flat");
  config.effects = SensorEffects::none();
  double all = 0, kept = 0;
  const auto count = [&](double& sum) {
    for_each_return(drive(config), [&](const auto&...) { ++sum; });
  };
  count(all);
  config.effects.random_drop_share = 0.25;
  count(kept);
  EXPECT_NEAR(kept / all, 0.75, 0.01);
}

TEST(Drive, ErrorOfTheSinkEndsTheDrive) {
  int taken = 0;
  const auto summary =
      simulate_drive(one_frame("flat"), [&](const Hdl64eSimulatedColumn&) -> Status {
        return ++taken < 10 ? Status{} : fail(ErrorCode::kWriteFailed, "disk full");
      });
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().message, "disk full");
  EXPECT_EQ(taken, 10);
}

TEST(Drive, SettingsOutOfRangeAreRefusedByName) {
  const auto message = [](auto&& change) {
    Hdl64eSimulation config = one_frame("flat");
    change(config);
    const auto summary =
        simulate_drive(config, [](const Hdl64eSimulatedColumn&) -> Status { return {}; });
    return summary ? std::string("accepted") : summary.error().message;
  };
  EXPECT_NE(message([](auto& c) { c.spin_hz = 50; }).find("spin_hz"), std::string::npos);
  EXPECT_NE(message([](auto& c) { c.duration_s = std::nan(""); }).find("duration_s"),
            std::string::npos);
  EXPECT_NE(message([](auto& c) { c.mount.height_m = 0; }).find("height_m"), std::string::npos);
  EXPECT_NE(message([](auto& c) { c.effects.random_drop_share = 1.5; }).find("random_drop_share"),
            std::string::npos);
  EXPECT_NE(message([](auto& c) { c.threads = 0; }).find("threads"), std::string::npos);
  EXPECT_NE(message([](auto& c) { c.scene = "moon"; }).find("street"), std::string::npos);
}

}  // namespace
}  // namespace terracut::simulator
