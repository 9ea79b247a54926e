// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut manifest` and `terracut relabel`.
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "relabel_fixture.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/rewritten_capture.hpp"
#include "tests/tools/cli/background_program.hpp"
#include "tools/cli/fleet/content_hash.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr int kOutputFailedCode = 4, kRefusedCode = 3, kMountNotFoundCode = 10;

/// Of a drive's packets those after the first 0.02 s, for 0.02 s: no ground straight ahead nor
/// behind.
void cut_to_a_fifth_of_a_revolution(const fs::path& capture) {
  const fs::path whole = fs::path(capture).replace_extension("whole");
  fs::rename(capture, whole);
  std::int64_t begin_ns = 0;
  test::rewrite_capture(whole, capture, [&](const auto& datagram, auto n, auto& write) {
    if (n == 0) begin_ns = datagram.stamp_ns;
    const std::int64_t at_ns = datagram.stamp_ns - begin_ns;
    if (at_ns >= 20'000'000 && at_ns <= 40'000'000) write(datagram);
  });
  fs::remove(whole);
}

TEST_F(Relabel, WritesTheLabelsOfReplay) {
  add_drive("day1/a");
  add_drive("b");
  make_manifest();
  expect_done("relabel m.json -o out");
  const auto found = outputs();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_THAT(*found.begin(), StartsWith("b-"));
  EXPECT_THAT(*found.rbegin(), StartsWith("day1/a-"));
  for (const std::string& output : found) expect_labels_of_replay(output);
  expect_outputs_whole();
  EXPECT_TRUE(parts_are_gone());
}

TEST_F(Relabel, ADriveWhoseMountIsNotFoundFailsForThatAndTheOthersGoOn) {
  add_drive("a");
  add_drive("c");
  fs::create_directories(folder_ / "fleet/b");
  expect_done("simulate --scene flat --duration 0.2 --mount-height 2 -o fleet/b/b.pcap");
  cut_to_a_fifth_of_a_revolution(folder_ / "fleet/b/b.pcap");
  make_manifest();
  const Outcome outcome = run("relabel m.json -o out");
  EXPECT_EQ(outcome.exit_code, kMountNotFoundCode) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("labelled  2 drives"));
  EXPECT_THAT(outcome.out, HasSubstr("failed    1 drives: the mount is not found: b/b"));
  EXPECT_THAT(outcome.err, HasSubstr("--mount-guess"));
  EXPECT_EQ(outputs().size(), 2U);
  const Outcome guessed = run("relabel m.json -o out --mount-guess");
  EXPECT_EQ(guessed.exit_code, 0) << guessed.out << guessed.err;
  EXPECT_THAT(guessed.out, HasSubstr("labelled  3 drives"));
}

TEST_F(Relabel, DoesNothingTwice) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  const fs::path label = folder_ / "out" / *outputs().begin() / "000003.label";
  const auto written = fs::last_write_time(label);
  const Outcome again = run("relabel m.json -o out");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.out, HasSubstr("there     1 drives"));
  EXPECT_EQ(fs::last_write_time(label), written);
}

TEST_F(Relabel, BeginsAnewAJobWhoseFileIsNone) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  fs::path job;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/.relabel")) {
    if (fs::exists(entry.path() / "job.json")) job = entry.path() / "job.json";
  }
  fs::remove(job);
  ASSERT_EQ(::mkfifo(job.c_str(), 0600), 0);
  EXPECT_THAT(run("relabel m.json -o out").out, HasSubstr("there     1 drives"));
  EXPECT_THAT(run("relabel --status out").out, HasSubstr("done      1 drives"));
}

TEST_F(Relabel, ARecordThatCannotBeKeptCostsItselfAlone) {
  for (const char* const name : {"a", "b"}) add_drive(name);
  make_manifest();
  expect_done("relabel m.json -o out --shard 1/9");
  fs::path records;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/.relabel")) {
    if (fs::exists(entry.path() / "job.json")) records = entry.path() / "records";
  }
  fs::remove_all(records);
  std::ofstream(records) << "in its place";
  const Outcome outcome = run("relabel m.json -o out");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.out << outcome.err;
  EXPECT_EQ(outputs().size(), 2U);
}

TEST_F(Relabel, FindsLabelsByContentWhereItsRecordsAreLost) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  fs::remove_all(folder_ / "out" / ".relabel");
  EXPECT_THAT(run("relabel m.json -o out").out, HasSubstr("there     1 drives"));
  EXPECT_EQ(outputs().size(), 1U);
}

TEST_F(Relabel, DoesAgainWhatIsNoLongerWhole) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  const std::string output = *outputs().begin();
  fs::resize_file(folder_ / "out" / output / "000003.label", 100);
  write("out/" + output + "/notes.txt", "mine");
  const Outcome again = run("relabel m.json -o out");
  EXPECT_THAT(again.out, HasSubstr("labelled  1 drives"));
  EXPECT_THAT(again.err, HasSubstr("is kept as out/.relabel/broken/" + output + ".1"));
  EXPECT_TRUE(fs::exists(folder_ / "out/.relabel/broken" / (output + ".1") / "notes.txt"));
  expect_labels_of_replay(output);
  expect_outputs_whole();
}

TEST_F(Relabel, LeavesWhatOthersPutBesideLabels) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  for (const char* const name : {"/notes.txt", "/.DS_Store", "/Thumbs.db", "/corrected.label"}) {
    write("out/" + *outputs().begin() + name, "mine");
  }
  for (const char* const records : {"kept", "lost"}) {
    EXPECT_THAT(run("relabel m.json -o out").out, HasSubstr("there     1 drives")) << records;
    EXPECT_EQ(content_of(folder_ / "out" / *outputs().begin() / "notes.txt"), "mine");
    fs::remove_all(folder_ / "out/.relabel");
  }
}

/// What was read decides, not what was there before and after.
TEST_F(Relabel, GivesNoNameToLabelsOfAnInputThatWasReplacedMeanwhile) {
  copy_drive("a");
  make_manifest();
  fs::copy_file(folder_ / "fleet/a.pcap", folder_ / "a_before.pcap");
  fs::copy_file(folder_ / "fleet/a.pcap", folder_ / "a_other.pcap");
  const auto written = fs::last_write_time(folder_ / "fleet/a.pcap");
  fs::last_write_time(folder_ / "a_before.pcap", written);
  fs::last_write_time(folder_ / "a_other.pcap", written);
  BackgroundProgram program(folder_, "run", "relabel m.json -o out");
  const auto is_labelling = [&] {  // it has hashed its inputs when it has a part
    std::error_code none;
    fs::directory_iterator part(folder_ / "out/.relabel/parts", none);
    return !none && part != fs::directory_iterator();
  };
  while (!is_labelling() && !program.has_ended()) std::this_thread::yield();
  program.interrupt(SIGSTOP);
  fs::rename(folder_ / "a_other.pcap", folder_ / "fleet/a.pcap");
  fs::rename(folder_ / "a_before.pcap", folder_ / "fleet/a.pcap");
  program.interrupt(SIGCONT);
  EXPECT_EQ(program.end().exit_code, kRefusedCode);
  EXPECT_TRUE(outputs().empty());
  EXPECT_TRUE(parts_are_gone());
  EXPECT_THAT(run("relabel --status out").out,
              HasSubstr("an input changed while it was labelled: 1"));
  expect_done("relabel m.json -o out");
  expect_labels_of_replay(*outputs().begin());
}

TEST_F(Relabel, ReadsAgainWhatWasReplacedByAFileOfTheSameLengthAndTime) {
  copy_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  const fs::path capture = folder_ / "fleet/a.pcap";
  const auto written = fs::last_write_time(capture);
  std::string bytes = content_of(capture);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(capture, std::ios::binary) << bytes;
  fs::last_write_time(capture, written);
  EXPECT_THAT(run("relabel m.json -o out").out, HasSubstr("labelled  1 drives"));
  EXPECT_EQ(outputs().size(), 2U);
}

TEST_F(Relabel, LosesOneDriveWhereItsPlaceIsBad) {
  for (const char* const name : {"archived", "file", "good", "long"}) add_drive(name);
  make_manifest();
  expect_done("relabel m.json -o out");
  for (const std::string& output : outputs()) {
    const fs::path place = folder_ / "out" / output;
    fs::remove_all(place);
    if (output.starts_with("archived")) fs::create_symlink("moved/away", place);
    if (output.starts_with("file")) std::ofstream(place) << "mine";
  }
  auto manifest = json("m.json");
  for (auto& drive : manifest["drives"]) {  // with its hash it is longer than a name can be
    if (drive["name"] == "long") drive["name"] = std::string(240, 'n');
  }
  write("m.json", manifest.dump());
  const Outcome outcome = run("relabel m.json -o out");
  EXPECT_EQ(outcome.exit_code, kOutputFailedCode);
  EXPECT_THAT(outcome.out, HasSubstr("labelled  1 drives"));
  EXPECT_THAT(outcome.out, HasSubstr("something else has its place: archived, file"));
  EXPECT_THAT(outcome.err, HasSubstr("a link has the name of the drive's labels; take it away"));
  EXPECT_THAT(outcome.err, HasSubstr("File name too long"));
  const Outcome status = run("relabel --status out");
  EXPECT_THAT(status.out, HasSubstr("done      1 drives"));
  EXPECT_THAT(status.out, HasSubstr("failed    3 drives"));
}

TEST_F(Relabel, KeepsRecordsOfDrivesApartWhateverTheyAreCalled) {
  add_drive("x");
  add_drive("x.json/y");
  make_manifest();
  expect_done("relabel m.json -o out");
  EXPECT_THAT(run("relabel --status out").out, HasSubstr("done      2 drives"));
  EXPECT_THAT(run("relabel m.json -o out").out, HasSubstr("there     2 drives"));
}

/// Others can write to the folder of a fleet.
TEST_F(Relabel, IsNotLedAstrayByWhatOthersWroteOfIt) {
  add_drive("a");
  add_drive("b");
  make_manifest();
  expect_done("relabel m.json -o out");
  const fs::path facts = folder_ / "out" / *outputs().begin() / "terracut.json";
  std::string text = content_of(facts);
  const std::string frames = "\"frames\": 13";
  ASSERT_NE(text.find(frames), std::string::npos);
  text.replace(text.find(frames), frames.size(), "\"frames\": \"13\"");
  write(facts.lexically_relative(folder_).string(), text);
  const fs::path pipe = folder_ / "out" / *outputs().rbegin() / "terracut.json";
  fs::remove(pipe);
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::size_t job = 0;
  for (const char* const bad :
       {"[3]", R"({"drives": [3]})", R"({"drives": [{"name": "a", "bytes": "y"}]})",
        R"({"manifest": "m", "terracut": "v", "began_ns": "x", "drives": []})"}) {
    const std::string state = "out/.relabel/bad" + std::to_string(job++);
    fs::create_directories(folder_ / state);
    write(state + "/job.json", bad);
  }
  fs::create_directories(folder_ / "out/.relabel/pipe");
  ASSERT_EQ(::mkfifo((folder_ / "out/.relabel/pipe/job.json").c_str(), 0600), 0);
  EXPECT_EQ(run("relabel --status out").exit_code, 0);
  EXPECT_THAT(run("relabel m.json -o out").out, HasSubstr("labelled  2 drives"));
  EXPECT_EQ(run("compare out out").exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out/.relabel")) {
    if (entry.path().parent_path().filename() != "records") continue;
    auto record = nlohmann::json::parse(content_of(entry.path()));
    record["output"] = "../elsewhere";
    write(entry.path().lexically_relative(folder_).string(), record.dump());
  }
  EXPECT_EQ(run("compare out out").exit_code, kRefusedCode) << "no label of its job is there";
}

TEST_F(Relabel, PrintsNoControlCharactersOfNamesAndNoCommandOfAnother) {
  fs::create_directories(folder_ / "fleet");
  write("fleet/\x1b]0;title\n the rest  rm\a.pcap", "none");
  const std::string manifest = "m'; touch owned; '.json";
  expect_done("manifest fleet -o \"" + manifest + "\"");
  const Outcome outcome = run("relabel \"" + manifest + "\" -o out");
  EXPECT_EQ(outcome.exit_code, kRefusedCode);
  const Outcome status = run("relabel --status out");
  for (const std::string& text : {outcome.out, outcome.err, status.out}) {
    EXPECT_THAT(text, HasSubstr("?]0;title? the rest  rm?"));
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_EQ(text.find('\a'), std::string::npos);
  }
  const std::string before = "the rest  terracut ";
  const std::size_t begin = status.out.find(before) + before.size();
  const Outcome rest = run(status.out.substr(begin, status.out.find('\n', begin) - begin));
  EXPECT_EQ(rest.exit_code, kRefusedCode) << rest.err;
  EXPECT_FALSE(fs::exists(folder_ / "owned"));
}

TEST_F(Relabel, KeepsNamesWhereOnlyATimeHasChanged) {
  copy_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  const auto names = outputs();
  for (const char* const name : {"fleet/a.pcap", "fleet/a.calibration.xml"}) {
    fs::last_write_time(folder_ / name, fs::file_time_type::clock::now() + std::chrono::hours(1));
  }
  EXPECT_THAT(run("relabel m.json -o out").out, HasSubstr("there     1 drives"));
  EXPECT_EQ(outputs(), names);
}

TEST_F(Relabel, GivesNewNamesForAnotherParameterCalibrationOrBuild) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  expect_done("relabel m.json -o out --set surface.step_up_m=0.05");
  EXPECT_EQ(outputs().size(), 2U) << "a parameter";

  std::string table = content_of(folder_ / "fleet/a.calibration.xml");
  write("fleet/a.calibration.xml", table + "\n");
  expect_done("relabel m.json -o out");
  EXPECT_EQ(outputs().size(), 3U) << "the calibration";

  fs::copy_file(test::program(), folder_ / "other_build");
  std::ofstream(folder_ / "other_build", std::ios::binary | std::ios::app) << "x";
  const std::string other =
      "cd " + quoted(folder_) + " && ./other_build relabel m.json -o out >/dev/null 2>&1";
  EXPECT_EQ(std::system(other.c_str()), 0);
  EXPECT_EQ(outputs().size(), 4U) << "the build";
  expect_outputs_whole();
}

TEST_F(Relabel, TakesSettingsAsReplayDoes) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out --profile paper --mount-height 1.8");
  expect_done("replay " + quoted(kDrive) + " --calibration " + quoted(kDriveCalibration) +
              " --profile paper --mount-height 1.8 --labels replayed");
  expect_labels_of_replay(*outputs().begin());
}

TEST_F(Relabel, WritesARecordingThatSaysWhatItsNameIsAHashOf) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out --format mcap");
  expect_done("relabel m.json -o out");
  const auto found = outputs();
  ASSERT_EQ(found.size(), 2U) << "another format has another name";
  const bool first = fs::exists(folder_ / "out" / *found.begin() / "returns.mcap");
  const std::string recording =
      content_of(folder_ / "out" / (first ? *found.begin() : *found.rbegin()) / "returns.mcap");
  EXPECT_THAT(recording, HasSubstr("terracut.recipe"));
  EXPECT_THAT(recording, HasSubstr(sha256_of(content_of(kDrive)))) << "the content of the capture";
  EXPECT_THAT(recording, HasSubstr(sha256_of(content_of(kDriveCalibration))));
  EXPECT_THAT(recording, HasSubstr(sha256_of(content_of(test::program()))));
  expect_outputs_whole();
}

/// Of the biggest frames there may be, so these take somewhat less.
TEST_F(Relabel, TakesNoMoreMemoryThanPlanSays) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "the sanitizer brings its own allocator";
  add_drive("a");
  make_manifest();
  for (const std::string format : {"labels", "mcap"}) {
    expect_done("relabel m.json --format " + format + " -o " + format);
    expect_done("plan --sensor hdl64e --format " + format + " --json plan.json");
    const auto planned = json("plan.json")["process_bytes"].get<std::uint64_t>();
    std::uint64_t peak_bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / format / ".relabel")) {
      if (entry.path().parent_path().filename() != "records") continue;
      peak_bytes = json(entry.path())["peak_memory_bytes"].get<std::uint64_t>();
    }
    EXPECT_LE(peak_bytes, planned) << format;
    EXPECT_GT(peak_bytes, planned / (format == "mcap" ? 4 : 2)) << format;
  }
}

TEST_F(Relabel, NamesBadInputsAndLabelsTheOthers) {
  add_drive("good");
  add_drive("missing");
  add_drive("notes");
  fs::create_directories(folder_ / "fleet/cut");
  fs::copy_file(kDrive, folder_ / "fleet/cut/short.pcap");
  fs::copy_file(kDriveCalibration, folder_ / "fleet/cut/short.calibration.xml");
  make_manifest();
  fs::remove(folder_ / "fleet/missing.pcap");
  fs::remove(folder_ / "fleet/notes.pcap");
  write("fleet/notes.pcap", "no capture at all");
  fs::resize_file(folder_ / "fleet/cut/short.pcap", 3'000'001);

  const Outcome outcome = run("relabel m.json -o out");
  EXPECT_EQ(outcome.exit_code, kRefusedCode);
  EXPECT_THAT(outcome.out, HasSubstr("labelled  1 drives"));
  EXPECT_THAT(outcome.out, HasSubstr("the input breaks off: cut/short"));
  EXPECT_THAT(outcome.err, HasSubstr("missing.pcap: No such file"));
  ASSERT_EQ(outputs().size(), 1U);
  expect_labels_of_replay(*outputs().begin());

  const Outcome status = run("relabel --status out");
  EXPECT_EQ(status.exit_code, 0);
  EXPECT_THAT(status.out, HasSubstr("done      1 drives, 13 frames"));
  EXPECT_THAT(status.out, HasSubstr("missing   0 drives"));
  EXPECT_THAT(status.out, HasSubstr("failed    3 drives"));
  EXPECT_THAT(status.out, HasSubstr("the input breaks off: 1"));
  EXPECT_THAT(status.out, HasSubstr("notes: "));
}

TEST_F(Relabel, DoesTheRestByTheCommandThatStatusPrints) {
  add_drive("a");
  add_drive("b");
  make_manifest();
  fs::rename(folder_ / "fleet/b.pcap", folder_ / "b.pcap");
  EXPECT_EQ(run("relabel m.json -o out --set surface.step_up_m=0.05").exit_code, kRefusedCode);
  fs::rename(folder_ / "b.pcap", folder_ / "fleet/b.pcap");
  const std::string status = run("relabel --status out").out;
  const std::string before = "the rest  terracut ";
  const std::size_t begin = status.find(before) + before.size();
  const Outcome rest = run(status.substr(begin, status.find('\n', begin) - begin));
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("there     1 drives"));
  EXPECT_THAT(rest.out, HasSubstr("labelled  1 drives"));
  EXPECT_THAT(run("relabel --status out").out, HasSubstr("done      2 drives"));
}

TEST_F(Relabel, TakesMoreArgumentsForADriveThatNeedsThem) {
  add_drive("a");
  make_manifest();
  auto manifest = json("m.json");
  manifest["drives"][0]["arguments"] = {"--port", "1"};
  write("m.json", manifest.dump());
  EXPECT_THAT(run("relabel m.json -o out").err, HasSubstr("another port than --port"));
  manifest["drives"][0]["arguments"] = {
      "--mount-height=1.8",     "--mount-roll",         "-0.5", "--set",
      "surface.step_up_m=0.05", "--nominal-calibration"};
  write("m.json", manifest.dump());
  expect_done("relabel m.json -o out");
}

TEST_F(Relabel, TakesNoArgumentsThatSayMoreThanHowADriveIsReadAndLabelled) {
  add_drive("a");
  make_manifest();
  auto manifest = json("m.json");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--setup", "s.yaml"},
                                             {"--view", "0.0.0.0:8999"},
                                             {"--foxglove=0.0.0.0:8998"},
                                             {"--dds"},
                                             {"--loop", "0"},
                                             {"--rate", "0.000001"},
                                             {"--labels", "elsewhere"},
                                             {"--metadata", "a=b"},
                                             {"-h"},
                                             {"--help"},
                                             {"--config=c.yaml"},
                                             {"other.pcap"},
                                             {"--"},
                                             {"--from", "-h"},
                                             {"--from"}}) {
    manifest["drives"][0]["arguments"] = arguments;
    write("m.json", manifest.dump());
    const Outcome outcome = run("relabel m.json -o out");
    EXPECT_EQ(outcome.exit_code, arguments[0] == "--from" && arguments.size() == 2 ? 2 : 3)
        << arguments[0] << outcome.err;
    EXPECT_EQ(outcome.err.find("left no report"), std::string::npos) << arguments[0];
  }
}

TEST_F(Relabel, RefusesWhatIsNoWholeCommand) {
  EXPECT_EQ(run("relabel").exit_code, 2);
  EXPECT_EQ(run("relabel m.json").exit_code, 2);
  EXPECT_EQ(run("relabel m.json -o out --shard 3/2").exit_code, 2);
  EXPECT_EQ(run("relabel none.json -o out").exit_code, kRefusedCode);
  EXPECT_EQ(run("relabel --status out").exit_code, kRefusedCode);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Relabel, DividesAManifestIntoShards) {
  for (const char* const name : {"a", "b", "c", "d", "e"}) add_drive(name);
  make_manifest();
  expect_done("relabel m.json --shard 1/3 -o out");
  EXPECT_EQ(outputs().size(), 2U);
  expect_done("relabel m.json --shard 3/3 -o out");
  EXPECT_EQ(outputs().size(), 3U);
  expect_done("relabel m.json --shard 2/3 -o out");
  EXPECT_EQ(outputs().size(), 5U);
}

TEST_F(Relabel, GoesOnAfterKillsAtAnyMoment) {
  for (const char* const name : {"a", "b", "c"}) add_drive(name);
  make_manifest();
  const auto entries = [&] {  // in "out", of whatever is under way there
    std::error_code vanished;
    std::size_t count = 0;
    fs::recursive_directory_iterator entry(folder_ / "out", vanished);
    for (; !vanished && entry != fs::recursive_directory_iterator(); entry.increment(vanished)) {
      ++count;
    }
    return count;
  };
  for (const std::size_t more : {1U, 4U, 5U, 9U, 14U, 18U, 20U, 23U}) {
    const std::size_t enough = entries() + more;
    BackgroundProgram program(folder_, "run", "relabel m.json -o out");
    while (entries() < enough && !program.has_ended()) std::this_thread::yield();
    program.interrupt(SIGKILL);
    (void)program.end();
    expect_outputs_whole();
  }
  expect_done("relabel m.json -o out");
  EXPECT_EQ(outputs().size(), 3U);
  for (const std::string& output : outputs()) expect_labels_of_replay(output);
  EXPECT_TRUE(parts_are_gone()) << "what the killed have left";
}

TEST_F(Relabel, StopsInAnOrderlyWayAndGoesOn) {
  for (const char* const name : {"a", "b", "c"}) add_drive(name);
  make_manifest();
  BackgroundProgram program(folder_, "run", "relabel m.json -o out");
  while (outputs().empty() && !program.has_ended()) std::this_thread::yield();
  program.interrupt(SIGTERM);
  EXPECT_EQ(program.end().exit_code, 9);
  EXPECT_TRUE(parts_are_gone());
  expect_outputs_whole();
  EXPECT_THAT(run("relabel --status out").out, HasSubstr("failed    0 drives"));
  expect_done("relabel m.json -o out");
  EXPECT_EQ(outputs().size(), 3U);
}

TEST_F(Relabel, IsDoneByManyProcessesAtOnce) {
  for (const char* const name : {"a", "b", "c", "d"}) add_drive(name);
  make_manifest();
  std::vector<std::jthread> processes;
  for (int i = 0; i < 6; ++i) {
    processes.emplace_back([this, i] {
      expect_done("relabel m.json -o out --shard " + std::to_string(i % 2 + 1) + "/2");
    });
  }
  processes.clear();
  EXPECT_EQ(outputs().size(), 4U);
  expect_outputs_whole();
  for (const std::string& output : outputs()) expect_labels_of_replay(output);
  EXPECT_TRUE(parts_are_gone());
}

TEST_F(Relabel, NeverTouchesAPartOfAnotherHostNorWaitsForIt) {
  add_drive("a");
  make_manifest();
  expect_done("relabel m.json -o out");
  std::string job;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/.relabel")) {
    if (fs::exists(entry.path() / "job.json")) job = entry.path().filename().string();
  }
  const std::string name = sha256_of("a").substr(0, 16) + "@" + job + "@other.part-1-0";
  const fs::path part = folder_ / "out/.relabel/parts" / name;
  fs::create_directories(part / "labels");
  fs::remove_all(folder_ / "out" / *outputs().begin());
  expect_done("relabel m.json -o out");
  EXPECT_EQ(outputs().size(), 1U);
  EXPECT_TRUE(fs::exists(part / "labels"));
}

TEST_F(Relabel, SaysThatItsFolderIsNone) {
  add_drive("a");
  make_manifest();
  write("out", "a file");
  EXPECT_EQ(run("relabel m.json -o out").exit_code, kOutputFailedCode);
}

/// On file systems of its own, where this user may mount some.
TEST_F(Relabel, LeavesNothingOnAFullOrReadOnlyDiskAndDoesItOnceThereIsRoom) {
  add_drive("a");
  make_manifest();
  fs::create_directories(folder_ / "disk");
  const std::string relabel = quoted(test::program()) + " relabel m.json -o disk/out";
  const std::string script =
      "mount -t tmpfs -o size=2m none disk || exit 77\n" + relabel +
      " 2>full.txt; echo $? >full_code\n"
      "find disk/out \\( -name '*.label' -o -name SHA256SUMS -o -name '*.part-*' \\) >left\n"
      "mount -o remount,size=100m disk && " +
      relabel + " && cp -r disk/out out && mount -o remount,ro disk && " + relabel +
      " 2>readonly.txt; echo $? >readonly_code\n";
  write("script", script);
  const std::string command =
      "cd " + quoted(folder_) + " && unshare --map-root-user --mount sh script >script.txt 2>&1";
  const int status = std::system(command.c_str());
  if (!fs::exists(folder_ / "full_code")) GTEST_SKIP() << "no mount: " << status;
  EXPECT_EQ(content_of(folder_ / "full_code"), "4\n") << content_of(folder_ / "full.txt");
  EXPECT_THAT(content_of(folder_ / "full.txt"), HasSubstr("No space left"));
  EXPECT_EQ(content_of(folder_ / "left"), "");
  ASSERT_EQ(outputs().size(), 1U) << content_of(folder_ / "script.txt");
  expect_labels_of_replay(*outputs().begin());
  expect_outputs_whole();
  EXPECT_EQ(content_of(folder_ / "readonly_code"), "4\n") << content_of(folder_ / "readonly.txt");
}

}  // namespace
}  // namespace terracut::cli
