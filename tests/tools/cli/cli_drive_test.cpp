// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/beams/angle.hpp"
#include "cli_fixture.hpp"
#include "tests/support/places.hpp"
#include "tests/support/rewritten_capture.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

TEST_F(Cli, SimulateWritesCaptureTableAndOneTruthFileAFrame) {
  EXPECT_TRUE(fs::is_regular_file(kDrive));
  EXPECT_TRUE(fs::is_regular_file(kDriveCalibration));
  EXPECT_EQ(files_in(kDriveTruth, ".label"), kDriveFrames);
}

TEST_F(Cli, SimulateIsTheSameForTheSameSeedOnly) {
  expect_done("simulate --scene flat --seed 3 --duration 0.1 -o a.pcap");
  expect_done("simulate --scene flat --seed 3 --duration 0.1 -o b.pcap");
  expect_done("simulate --scene flat --seed 4 --duration 0.1 -o c.pcap");
  EXPECT_EQ(content_of(folder_ / "a.pcap"), content_of(folder_ / "b.pcap"));
  EXPECT_NE(content_of(folder_ / "a.pcap"), content_of(folder_ / "c.pcap"));
}

TEST_F(Cli, SimulateTakesNoTableWhereTheSensorsIsBuiltIn) {
  const Outcome refused = run("simulate --sensor hdl32e --duration 0.1 -o d.pcap --calibration " +
                              quoted(kDriveCalibration));
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.err, HasSubstr("the table of a Velodyne HDL-32E is built in"));
}

TEST_F(Cli, SimulateWritesTheVehiclesMotionBesideTheDriveWhenAsked) {
  expect_done(
      "simulate --scene flat --duration 0.1 --speed 20 --yaw-rate 28.65 --can-log -o a.pcap");
  const std::string log = content_of(folder_ / "a.can.log");
  // 72.00 km/h and 28.65 deg/s, every 10 ms of the 0.2 s with run-up and run-out.
  EXPECT_THAT(log, HasSubstr(") can0 1A0#1C200B3100000003\n"));
  EXPECT_THAT(content_of(folder_ / "a.can.dbc"), HasSubstr("BO_ 416 VEHICLE_MOTION"));
  expect_done("simulate --scene flat --duration 0.1 -o b.pcap");
  EXPECT_FALSE(fs::exists(folder_ / "b.can.log"));
  EXPECT_EQ(run("simulate --duration 0.1 --can-log").exit_code, 2);
  EXPECT_EQ(run("encode scans -o x.pcap --can-log --keep-compensation").exit_code, 2);
}

TEST_F(Cli, InfoNamesTheSensorItsRateAndTheTableInTheStream) {
  const Outcome outcome = run("info --json info.json " + quoted(kDrive));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("HDL-64E"));
  EXPECT_THAT(outcome.out, HasSubstr("600.0 rpm"));
  EXPECT_THAT(outcome.out, HasSubstr("single return"));
  EXPECT_THAT(outcome.out, HasSubstr("complete, fingerprint"));
  const auto info = json("info.json");
  ASSERT_EQ(info["streams"].size(), 1U);
  EXPECT_EQ(info["streams"][0]["hdl64e"]["packets_lost"], 0);
  EXPECT_TRUE(info["streams"][0]["hdl64e"]["blind"].is_null());
}

TEST_F(Cli, InfoAndReplayNameABlindSectorAndDoNotTakeItForLoss) {
  test::rewrite_capture(kDrive, folder_ / "narrow.pcap",
                        [](const auto& datagram, auto, auto& write) {
                          const int rotor_cdeg = datagram.payload[2] + 256 * datagram.payload[3];
                          if (rotor_cdeg < 10'000 || rotor_cdeg >= 20'000) write(datagram);
                        });
  const Outcome outcome = run("info --json info.json narrow.pcap");
  EXPECT_THAT(outcome.out, HasSubstr("  blind        from 10"));
  EXPECT_THAT(outcome.out, HasSubstr("  lost         0 packets"));
  const auto facts = json("info.json")["streams"][0]["hdl64e"];
  EXPECT_EQ(facts["packets_lost"], 0);
  EXPECT_NEAR(facts["blind"]["from_deg"], 100, 1.1) << "a packet";
  EXPECT_NEAR(facts["blind"]["to_deg"], 200, 1.1);

  const Outcome replayed =
      run("replay --calibration " + quoted(kDriveCalibration) + " --json r.json narrow.pcap");
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_THAT(replayed.out, HasSubstr("blind     from 10"));
  const auto summary = json("r.json")["summary"];
  EXPECT_EQ(summary["losses"]["network_gap_packets"], 0);
  EXPECT_NEAR(summary["blind"]["from_deg"], 100, 1.1);
  EXPECT_NEAR(summary["blind"]["to_deg"], 200, 1.1);
}

TEST_F(Cli, ReplayLabelsEveryReturnOfEveryFrameInTheOrderOfTheTruth) {
  expect_done("replay " + quoted(kDrive) + " --labels labels --json report.json");
  const auto report = json("report.json");
  ASSERT_EQ(report["frames"].size(), kDriveFrames);
  for (const auto& frame : report["frames"]) {
    const std::size_t number = frame["frame"];
    char name[32];
    std::snprintf(name, sizeof(name), "%06zu.label", number);
    const auto labels = ids_of(folder_ / "labels" / name);
    const auto truth = ids_of(kDriveTruth / name);
    EXPECT_GT(labels.size(), 10'000U);
    EXPECT_EQ(labels.size(), truth.size());
    EXPECT_EQ(frame["returns_in"], truth.size());
    EXPECT_EQ(frame["returns_labelled"], truth.size());
    EXPECT_EQ(frame["complete"], true);
    EXPECT_THAT(labels, Each(AnyOf(40U, 49U, 99U)));
  }
}

TEST_F(Cli, ReportHoldsWhatTheExchangePromises) {
  expect_done("replay " + quoted(kDrive) + " --truth " + quoted(kDriveTruth) +
              " --json report.json");
  const auto report = json("report.json");
  const auto& frame = report["frames"][0];
  EXPECT_TRUE(frame["losses"].contains("network_gap_packets"));
  EXPECT_TRUE(frame["losses"].contains("rejected_wrong_model"));
  EXPECT_LT(frame["ms"]["after_frame"], frame["ms"]["total"]);
  for (const char* stage : {"decode", "elevation_map", "adjacent_points", "seeds", "min_cut",
                            "labels", "total", "after_frame"}) {
    EXPECT_TRUE(frame["ms"].contains(stage)) << stage;
    const auto& summed = report["summary"]["ms"][stage];
    EXPECT_LE(summed["p50"], summed["p99"]) << stage;
    EXPECT_LE(summed["p99"], summed["max"]) << stage;
    EXPECT_GT(summed["max"], 0.0) << stage;
  }
  EXPECT_EQ(report["summary"]["frames"], kDriveFrames);
  EXPECT_EQ(report["summary"]["unscored_frames"], 0);
  EXPECT_GT(report["summary"]["iou_g"], 0.8);
  EXPECT_GT(report["summary"]["recall_o"], 0.9);
  EXPECT_LE(report["summary"]["iou_g"], 1.0);
}

TEST_F(Cli, ReplayGivesTheSameLabelsEveryTimeAndFromEitherCopyOfTheTable) {
  expect_done("replay " + quoted(kDrive) + " --labels a --duration 0.5");
  expect_done("replay " + quoted(kDrive) + " --labels b --duration 0.5");
  expect_done("replay " + quoted(kDrive) + " --labels c --duration 0.5 --calibration " +
              quoted(kDriveCalibration));
  for (const char* name : {"000000.label", "000003.label"}) {
    EXPECT_EQ(content_of(folder_ / "a" / name), content_of(folder_ / "b" / name));
    EXPECT_EQ(content_of(folder_ / "a" / name), content_of(folder_ / "c" / name));
  }
}

TEST_F(Cli, ReplayGivesTheSameLabelsHoweverLongFramesWaitForLatePackets) {
  expect_done("replay " + quoted(kDrive) + " --labels waited --duration 0.5");
  expect_done("replay " + quoted(kDrive) + " --labels hasty --duration 0.5 --reorder-packets 0");
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "waited")) {
    EXPECT_EQ(content_of(entry.path()), content_of(folder_ / "hasty" / entry.path().filename()));
    ++files;
  }
  EXPECT_GT(files, 3);
  EXPECT_EQ(run("replay " + quoted(kDrive) + " --reorder-packets 17").exit_code, kUsage);
}

TEST_F(Cli, EveryRowOfTableThreeIsOneOption) {
  std::vector<std::string> labels;
  for (const std::string stages : {"elevation", "adjacent", "mrf"}) {
    expect_done("replay " + quoted(kDrive) + " --duration 0.2 --profile paper --stages " + stages +
                " --labels " + stages);
    labels.push_back(content_of(folder_ / stages / "000000.label"));
  }
  EXPECT_NE(labels[0], labels[1]);
  EXPECT_NE(labels[1], labels[2]);
}

TEST_F(Cli, SimulatesEitherSensorInEitherReturnModeAtAnySpin) {
  struct Drive {
    std::string options;
    std::size_t frames;
    const char* info;
  };
  for (const Drive& drive :
       {Drive{"--sensor ruby128 --duration 0.2", 2, "single return, a packet every 166.6 us"},
        Drive{"--sensor ruby128 --returns dual --timestamp ns --duration 0.1", 1,
              "UTC seconds and nanoseconds (proven)"},
        Drive{"--sensor ruby128 --spin-hz 20 --timestamp calendar --duration 0.1", 2, "1200.0 rpm"},
        Drive{"--sensor hdl64e --returns dual --spin-hz 5 --duration 0.4", 2,
              "dual return, a packet every 172.8 us"}}) {
    SCOPED_TRACE(drive.options);
    const std::string table = drive.options.find("ruby") != std::string::npos ? "csv" : "xml";
    expect_done("simulate --scene flat -o d.pcap " + drive.options);
    EXPECT_EQ(files_in(folder_ / "d.truth", ".label"), drive.frames);
    EXPECT_THAT(run("info d.pcap").out, HasSubstr(drive.info));
    expect_done("replay d.pcap --calibration d.calibration." + table +
                " --truth d.truth --json report.json");
    const auto summary = json("report.json")["summary"];
    EXPECT_EQ(summary["frames"], drive.frames);
    EXPECT_EQ(summary["complete_frames"], drive.frames);
    EXPECT_EQ(summary["returns_in"], summary["returns_labelled"]);
    EXPECT_EQ(summary["unscored_frames"], 0);
    EXPECT_GT(summary["iou_g"], 0.95);
  }
}

TEST_F(Cli, AnOustersDriveIsReplayedWithTheMetadataBesideIt) {
  expect_done("simulate --sensor ouster32 --product os0 --scene flat --duration 0.3 -o o.pcap");
  EXPECT_TRUE(fs::exists(folder_ / "o.calibration.json"));
  const Outcome info = run("info o.pcap");
  EXPECT_THAT(info.out, HasSubstr("32-row Ouster (profile RNG19_RFL8_SIG16_NIR16)"));
  expect_done(
      "replay o.pcap --truth o.truth --json o.json --mount-height 1.73 --mount-roll 0 "
      "--mount-pitch 0");
  EXPECT_GT(json("o.json").at("summary").at("iou_g"), 0.9);
  EXPECT_EQ(run("simulate --sensor ouster32 --spin-hz 9 --duration 0.1 -o p.pcap").exit_code, 2);
  // Another unit's beams and mode, of two returns.
  expect_done(
      "simulate --sensor ouster32 --calibration o.calibration.json --returns dual --scene "
      "flat --duration 0.1 -o p.pcap");
  EXPECT_THAT(run("info p.pcap").out, HasSubstr("profile RNG19_RFL8_SIG16_NIR16_DUAL"));
}

TEST_F(Cli, ARuby128sDriveCarriesItsTable) {
  expect_done("simulate --sensor ruby128 --scene flat --duration 0.1 -o d.pcap");
  const Outcome outcome = run("replay d.pcap");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("DIFOP"));
}

TEST_F(Cli, OptionsOfTheOtherSensorAreSaidToBeWithoutEffect) {
  const Outcome outcome =
      run("replay " + quoted(kDrive) + " --duration 0.2 --nominal-calibration --timestamp ns");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("warning: --nominal-calibration is without effect"),
                                 HasSubstr("warning: --timestamp is without effect")));
}

TEST_F(Cli, ReplayWritesCloudsAndPictures) {
  expect_done("replay " + quoted(kDrive) + " --duration 0.15 --pcd clouds --png pictures --truth " +
              quoted(kDriveTruth));
  EXPECT_GE(files_in(folder_ / "clouds", ".pcd"), 1U);
  for (const char* name : {"000000.birdseye.png", "000000.range.png", "000000.mistakes.png"}) {
    EXPECT_THAT(content_of(folder_ / "pictures" / name), testing::StartsWith("\x89PNG")) << name;
  }
}

TEST_F(Cli, ReplayTakesTheWantedPartOfTheCapture) {
  expect_done("replay " + quoted(kDrive) + " --start 0.4 --duration 0.3 --json report.json");
  const auto summary = json("report.json")["summary"];
  EXPECT_EQ(summary["complete_frames"], 2);  // 0.3 s cover two frames from seam to seam
  EXPECT_EQ(summary["frames"], 4);           // and touch two more
}

TEST_F(Cli, ReplayLoopsOverTheCapture) {
  expect_done("replay " + quoted(kDrive) + " --loop 3 --json report.json");
  const auto summary = json("report.json")["summary"];
  EXPECT_EQ(summary["frames"], 3 * kDriveFrames);
  EXPECT_EQ(summary["complete_frames"], 3 * kDriveFrames);
  for (const auto& [cause, count] : summary["losses"].items()) EXPECT_EQ(count, 0) << cause;
  EXPECT_EQ(summary["returns_in"], summary["returns_labelled"]);
}

TEST_F(Cli, ReplayFindsTheMountThatIsNotStated) {
  expect_done(
      "simulate --scene flat --duration 0.5 --mount-height 2.4 --mount-roll -3 --mount-pitch 4 "
      "-o flat.pcap");
  const std::string replay =
      "replay flat.pcap --calibration flat.calibration.xml --truth flat.truth --json report.json ";
  const Outcome found = run(replay + "--labels found");
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_THAT(found.err, HasSubstr("mount: height 2.4"));
  const auto mount = json("report.json")["summary"]["mount"];
  EXPECT_NEAR(mount["height_m"], 2.4, 0.02);
  EXPECT_NEAR(mount["roll_deg"], -3, 0.2);
  EXPECT_NEAR(mount["pitch_deg"], 4, 0.2);
  EXPECT_EQ(mount["found_in_frames"], 5);
  EXPECT_LT(mount["uncertainty"]["height_m"], 0.04);
  EXPECT_GT(json("report.json")["summary"]["iou_g"], 0.98);

  // Stated as it was found it gives the same labels, bit for bit.
  const Outcome stated =
      run(replay + fmt::format("--labels stated --mount-height {} --mount-roll {} --mount-pitch {}",
                               mount["height_m"].get<double>(), mount["roll_deg"].get<double>(),
                               mount["pitch_deg"].get<double>()));
  EXPECT_EQ(stated.exit_code, 0) << stated.err;
  EXPECT_THAT(stated.err, Not(HasSubstr("mount:")));
  EXPECT_EQ(json("report.json")["summary"]["mount"]["found_in_frames"], 0);
  for (const char* name : {"000000.label", "000004.label"}) {
    EXPECT_EQ(content_of(folder_ / "stated" / name), content_of(folder_ / "found" / name)) << name;
  }

  const Outcome in_part = run(replay + "--mount-height 2.5");
  EXPECT_THAT(in_part.err, AllOf(HasSubstr("height 2.500 m (stated)"), HasSubstr("pitch 4.0")));
}

TEST_F(Cli, ReplayFindsAndLabelsASensorThatHangsUpsideDown) {
  expect_done(
      "simulate --sensor ruby128 --scene flat --duration 0.3 --mount-height 1.9 --mount-roll 179 "
      "--mount-pitch 2 -o flat.pcap");
  const Outcome found =
      run("replay flat.pcap --calibration flat.calibration.csv --truth flat.truth --json r.json");
  EXPECT_EQ(found.exit_code, 0) << found.err;
  const auto summary = json("r.json")["summary"];
  EXPECT_NEAR(summary["mount"]["height_m"], 1.9, 0.02);
  EXPECT_NEAR(summary["mount"]["roll_deg"], 179, 0.3);
  EXPECT_NEAR(summary["mount"]["pitch_deg"], 2, 0.3);
  EXPECT_GT(summary["iou_g"], 0.95);
}

TEST_F(Cli, AMountThatIsNotFoundGivesNoLabelsUnlessItIsStatedOrMayBeGuessed) {
  // A fifth of a revolution, and so no ground behind the vehicle nor straight ahead.
  const std::string replay = "replay " + quoted(kDrive) +
                             " --start 0.02 --duration 0.02 --json report.json --calibration " +
                             quoted(kDriveCalibration);
  const Outcome refused = run(replay + " --labels labels");
  EXPECT_EQ(refused.exit_code, kMountNotFound) << refused.err;
  EXPECT_THAT(refused.err, AllOf(HasSubstr("error: the mount is not found: of "),
                                 HasSubstr("--mount-height"), HasSubstr("--mount-guess")));
  EXPECT_FALSE(fs::exists(folder_ / "labels"));
  EXPECT_FALSE(fs::exists(folder_ / "report.json"));

  const Outcome guessed = run(replay + " --labels labels --mount-guess");
  EXPECT_EQ(guessed.exit_code, 0) << guessed.err;
  EXPECT_THAT(guessed.err, HasSubstr("warning: the mount is not found: of "));
  EXPECT_THAT(guessed.err, HasSubstr("a guess, and labels suffer where it is wrong: height 1.730"));
  EXPECT_THAT(guessed.out, HasSubstr("mount     not found and not stated: a guess"));
  EXPECT_EQ(json("report.json")["summary"]["mount"]["guessed"], true);
  EXPECT_GT(files_in(folder_ / "labels", ".label"), 0U);

  const Outcome stated = run(replay + " --mount-height 1.73 --mount-roll 0 --mount-pitch 0");
  EXPECT_EQ(stated.exit_code, 0) << stated.err;
  EXPECT_EQ(json("report.json")["summary"]["mount"]["guessed"], false);
}

TEST_F(Cli, AMountThatIsTooUncertainIsNotFoundEither) {
  // The street ahead from 11 m on, up to a wall 15 m away, and nothing behind the sensor.
  std::string cloud;
  for (int ring = 0; ring < 16; ++ring) {
    const double elevation_rad = beams::deg_to_rad(-9 + 0.6 * ring);
    for (int step = -300; step <= 300; ++step) {
      const double azimuth_rad = beams::deg_to_rad(0.1 * step);
      const double range_m =
          elevation_rad < -0.12 ? 1.73 / std::tan(-elevation_rad) : 15 / std::cos(azimuth_rad);
      cloud +=
          fmt::format("{:.3f} {:.3f} {:.3f} {}\n", range_m * std::cos(azimuth_rad),
                      range_m * std::sin(azimuth_rad), range_m * std::tan(elevation_rad), ring);
    }
  }
  const int points = 16 * 601;
  write("ahead.pcd", fmt::format("VERSION 0.7\nFIELDS x y z ring\nSIZE 4 4 4 2\nTYPE F F F U\n"
                                 "COUNT 1 1 1 1\nWIDTH {}\nHEIGHT 1\nPOINTS {}\nDATA ascii\n{}",
                                 points, points, cloud));
  const Outcome refused = run("segment ahead.pcd --labels labels");
  EXPECT_EQ(refused.exit_code, kMountNotFound) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("so little of the ground is seen that it is uncertain: "));
  EXPECT_FALSE(fs::exists(folder_ / "labels"));
  const Outcome measured = run("calibrate ahead.pcd -o setup.yaml");
  EXPECT_EQ(measured.exit_code, kMountNotFound) << measured.err;
  EXPECT_FALSE(fs::exists(folder_ / "setup.yaml"));
  EXPECT_EQ(run("segment ahead.pcd --labels labels --mount-guess").exit_code, 0);
  EXPECT_EQ(files_in(folder_ / "labels", ".label"), 1U);
}

TEST_F(Cli, CalibrateWritesASetupThatReplayReads) {
  expect_done(
      "simulate --scene flat --duration 0.3 --mount-height 2 --mount-pitch 1.5 -o flat.pcap");
  expect_done("calibrate flat.pcap --calibration flat.calibration.xml -o setup.yaml");
  const Outcome outcome =
      run("calibrate flat.pcap --calibration flat.calibration.xml -o again.yaml");
  EXPECT_THAT(outcome.out, HasSubstr("height 2.0"));
  EXPECT_THAT(outcome.out, HasSubstr("pitch 1.5"));
  expect_done(
      "replay flat.pcap --calibration flat.calibration.xml --setup setup.yaml "
      "--truth flat.truth --json report.json");
  EXPECT_GT(json("report.json")["summary"]["iou_g"], 0.98);
}

TEST_F(Cli, CalibrateWritesNothingWhereNoRingWasMeasured) {
  const Outcome outcome = run("calibrate " + quoted(kDrive) + " --calibration " +
                              quoted(kDriveCalibration) + " --duration 0.01 -o setup.yaml");
  EXPECT_EQ(outcome.exit_code, 5) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no setup was written"));
  EXPECT_FALSE(fs::exists(folder_ / "setup.yaml"));
}

TEST_F(Cli, CalibrateReadsTheMountOffTheVehiclesOwnSideOfACrownedRoad) {
  const Outcome outcome = run("calibrate " + quoted(kDrive) + " --duration 0.5 --calibration " +
                              quoted(kDriveCalibration) + " -o setup.yaml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  double height_m = 0, roll_deg = 0, pitch_deg = 0;
  const std::size_t at = outcome.out.find("height ");
  ASSERT_NE(at, std::string::npos) << outcome.out;
  ASSERT_EQ(std::sscanf(outcome.out.c_str() + at,
                        "height %lf m (+-%*f), roll %lf deg (+-%*f), pitch %lf deg", &height_m,
                        &roll_deg, &pitch_deg),
            3);
  EXPECT_NEAR(height_m, 1.73, 0.03);
  EXPECT_NEAR(roll_deg, 0.0, 0.3);  // the other side of the road lies some 2.5 degrees off
  EXPECT_NEAR(pitch_deg, 0.0, 0.3);
}

TEST_F(Cli, BenchTimesDecodingAndEveryStage) {
  expect_done("bench " + quoted(kDrive) + " --repeat 2 --duration 0.5 --calibration " +
              quoted(kDriveCalibration) + " --json bench.json");
  const auto bench = json("bench.json");
  EXPECT_GT(bench["decode_ns_per_column"]["p50"], 0);
  EXPECT_GT(bench["ms"]["total"]["p50"], 0.0);
  EXPECT_EQ(bench["returns_unlabelled"], 0);
  EXPECT_GE(bench["frames"], 6);
  EXPECT_EQ(bench["frames_ms"].size(), bench["frames"]);
  for (const auto& frame : bench["frames_ms"]) {
    EXPECT_GT(frame["decode"], 0.0);
    EXPECT_GT(frame["segment"], 0.0);
  }
  EXPECT_EQ(bench["profile"], "terracut");
}

TEST_F(Cli, BenchTimesABaselineAndPlanCountsItsMemory) {
  expect_done("bench " + quoted(kDrive) + " --repeat 1 --duration 0.3 --calibration " +
              quoted(kDriveCalibration) + " --method bogoslavskyi --json bench.json");
  const auto bench = json("bench.json");
  EXPECT_EQ(bench["method"], "bogoslavskyi");
  EXPECT_FALSE(bench.contains("profile"));
  EXPECT_EQ(bench["returns_unlabelled"], 0);
  expect_done("plan --json ours.json");
  expect_done("plan --method zhang --json zhang.json");
  EXPECT_NE(json("zhang.json")["total_bytes"], json("ours.json")["total_bytes"]);
}

TEST_F(Cli, PlanAddsUpItsParts) {
  expect_done("plan --json plan.json");
  const auto plan = json("plan.json");
  std::uint64_t sum = 0;
  for (const auto& bytes : plan["parts"]) sum += bytes.get<std::uint64_t>();
  EXPECT_EQ(plan["total_bytes"], sum);
  EXPECT_GT(sum, 1'000'000U);
}

TEST_F(Cli, DetectionFollowsItsOptions) {
  expect_done("detection --sensor vlp16 --mount-height 2 --json level.json --slope 0");
  expect_done("detection --sensor vlp16 --mount-height 2 --json paper.json --profile paper");
  const auto boxes = json("level.json")["boxes"];
  EXPECT_EQ(boxes[0]["sensor"], "Velodyne VLP-16");
  EXPECT_EQ(boxes[0]["mount_height_m"], 2);
  EXPECT_GT(boxes[1]["least_height_m"], 0.15);
  const auto paper = json("paper.json");
  for (const auto& box : paper["boxes"]) EXPECT_TRUE(box["least_height_m"].is_null());
}

TEST_F(Cli, SetChangesWhatTheMethodDoes) {
  const std::string replay = "replay " + quoted(kDrive) + " --duration 0.3 --json ";
  expect_done(replay + "default.json");
  expect_done(replay +
              "set.json --set elevation_map.obstacle_height_m=1.5 --set min_cut.max_unknown=0");
  EXPECT_GT(json("default.json")["frames"][0]["min_cut"]["unknown"], 1000);
  EXPECT_EQ(json("default.json")["frames"][0]["min_cut"]["coarse"], 0);
  EXPECT_GT(json("set.json")["frames"][0]["min_cut"]["coarse"], 0);
}

/// Texts that commands print; they take long.
using CliReference = Cli;

TEST_F(CliReference, PagesOfTheReferenceEndWithWhatTheirCommandsPrint) {
  for (const std::string command : {"parameters", "detection"}) {
    const Outcome printed = run(command);
    EXPECT_EQ(printed.exit_code, 0);
    EXPECT_THAT(content_of(test::source_folder() / "docs/reference" / (command + ".md")),
                testing::EndsWith(printed.out))
        << "print it anew with `terracut " << command << "`";
  }
}

TEST_F(CliReference, ReadmeQuotesWhatIsAlwaysFound) {
  expect_done("detection --mount-height 1.73 --json promises.json");
  const auto promises = json("promises.json");
  const auto quoted_for = [&](std::string_view sensor, double to_m) {
    double least_m = 0;
    for (const auto& box : promises["boxes"]) {
      if (box["sensor"] != sensor || box["width_m"] != 0.5 || box["to_m"] > to_m) continue;
      least_m = std::max(least_m, box["least_height_m"].get<double>());
    }
    return fmt::format("{:.2f} m on, 5 to {} m away", least_m, to_m);
  };
  const std::string readme = content_of(test::source_folder() / "README.md");
  EXPECT_THAT(readme, testing::HasSubstr(quoted_for("Velodyne HDL-64E (S2/S3)", 30)));
  EXPECT_THAT(readme, testing::HasSubstr(quoted_for("Velodyne VLP-16", 20)));
}

}  // namespace
}  // namespace terracut::cli
