// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut eval`: what its report says is what somebody else finds in its predictions, and what
// the scripts that read it make of it.
#include <optional>

#include "cli_fixture.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/research/eval/made_up_dataset.hpp"
#include "tests/tools/research/eval/made_up_koblenz.hpp"
#include "tools/cli/exit_codes.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const fs::path kSourceDir = test::source_folder();
const std::string kAllMethods =
    "terracut,terracut_road,paper,ring_map_adjacent,ring_map,pfaff,bogoslavskyi,zhang";

const char* const kNoPackages =
    "no Python packages for pages here (tools/setup --report installs them)";

class CliEval : public Cli {
 protected:
  /// Runs `./tools/NAME ARGUMENTS` over the program; none where its Python packages are missing.
  [[nodiscard]] std::optional<Outcome> script(const std::string& name,
                                              const std::string& arguments) const {
    const std::string imports = "import jinja2, matplotlib, scipy";
    if (std::system(("/usr/bin/python3 -c '" + imports + "' 2>/dev/null").c_str()) != 0) return {};
    const std::string command =
        "cd " + quoted(folder_) + " && TERRACUT=" + quoted(test::program()) + " " +
        quoted(kSourceDir / "tools" / name) + " " + arguments + " >script_out.txt 2>script_err.txt";
    const int status = std::system(command.c_str());
    return Outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                   content_of(folder_ / "script_out.txt"), content_of(folder_ / "script_err.txt")};
  }
  /// By the checker, of `page` in this test's folder.
  void expect_page_shows_its_numbers() const {
    const std::string command =
        "python3 " + quoted(kSourceDir / "tests/tools/research/page/check_page.py") + " " +
        quoted(folder_ / "page/index.html") + " " + quoted(folder_ / "page/evaluation.json") +
        " >" + quoted(folder_ / "faults.txt");
    EXPECT_EQ(std::system(command.c_str()), 0) << content_of(folder_ / "faults.txt");
  }
  /// Runs the scorer in Python over what `eval` wrote into this test's folder.
  void expect_same_scores(const fs::path& root) const {
    if (std::system("python3 --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3 here";
    const std::string command =
        "python3 " + quoted(kSourceDir / "tests/tools/research/eval/score_predictions.py") + " " +
        quoted(root) + " " + quoted(folder_ / "predictions") + " " + quoted(folder_ / "eval.json") +
        " >" + quoted(folder_ / "scores.txt") + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << content_of(folder_ / "scores.txt");
  }
  [[nodiscard]] static std::string dataset(const fs::path& root) {
    return "eval semantickitti " + quoted(root) + " --predictions predictions --json eval.json ";
  }
};

TEST_F(CliEval, ReportsWhatAScorerInAnotherLanguageFinds) {
  const eval::MadeUpDataset made_up;
  expect_done(dataset(made_up.root()) + "--method terracut,terracut_road,ring_map,paper");
  EXPECT_EQ(json("eval.json").at("methods").size(), 4U);
  expect_same_scores(made_up.root());
}

TEST_F(CliEval, ReportsOfRecordedScansWhatAScorerInAnotherLanguageFinds) {
  const fs::path root = test::shared_data("semantickitti");
  if (!fs::is_directory(root)) GTEST_SKIP() << "no recorded scans at " << root;
  const std::string eval = dataset(root) + "--sequences 00,03 --frames 0 --method " + kAllMethods;
  expect_done(eval);
  expect_same_scores(root);
  fs::remove(folder_ / "eval.json.journal");
  expect_done(eval + " --through packets");
  expect_same_scores(root);
}

TEST_F(CliEval, WritesWhatAPageIsDrawnFrom) {
  const eval::MadeUpDataset made_up;
  const std::string eval = dataset(made_up.root()) + "--method terracut,ring_map --report ";
  const Outcome outcome = run(eval + "report/today");
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("./tools/report report/today draws the page"));
  EXPECT_EQ(json("report/today/evaluation.json").at("methods"), json("eval.json").at("methods"));
  write("taken", "a file where a folder is wanted");
  const Outcome refused = run(eval + "taken");
  EXPECT_EQ(refused.exit_code, kOutputFailed) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("taken"));
}

TEST_F(CliEval, IsDrawnAsAPageThatShowsItsNumbers) {
  const eval::MadeUpDataset made_up;
  const auto drawn = script("report", "page semantickitti " + quoted(made_up.root()) +
                                          " --method terracut,terracut_road,ring_map");
  if (!drawn) GTEST_SKIP() << kNoPackages;
  EXPECT_EQ(drawn->exit_code, kOk) << drawn->out << drawn->err;
  EXPECT_THAT(drawn->out, AllOf(HasSubstr("ring_map"), HasSubstr("page      page/index.html"),
                                Not(HasSubstr("draws the page"))));
  expect_page_shows_its_numbers();
}

TEST_F(CliEval, OfASimulatedDriveIsDrawnAsAPageWithoutPictures) {
  const auto drawn = script("report", "page simulated flat --duration 0.1 --method terracut,pfaff");
  if (!drawn) GTEST_SKIP() << kNoPackages;
  EXPECT_EQ(drawn->exit_code, kOk) << drawn->out << drawn->err;
  expect_page_shows_its_numbers();
  EXPECT_THAT(content_of(folder_ / "page/index.html"), HasSubstr("The frames were not kept"));
}

TEST_F(CliEval, TakesVariantsOfMethodsAndDrawsWhatTheyChange) {
  const eval::MadeUpDataset made_up;
  const std::string eval = dataset(made_up.root()) + "--variant blind=terracut,";
  expect_done(eval +
              "elevation_map.obstacle_height_m=2 --variant ring=ring_map --changes pictures");
  const auto report = json("eval.json");
  EXPECT_EQ(report.at("methods").at("blind").at("parameters").at("elevation_map.obstacle_height_m"),
            "2");
  EXPECT_LT(report["methods"]["blind"]["mean_over_sequences"]["all"]["recall_o"],
            report["methods"]["terracut"]["mean_over_sequences"]["all"]["recall_o"]);
  expect_same_scores(made_up.root());
  EXPECT_GT(json("pictures/changes.json").at("blind").at("returns"), 0);
  EXPECT_TRUE(fs::exists(folder_ / "pictures/blind.png"));
  EXPECT_FALSE(fs::exists(folder_ / "eval.json.journal"));
  EXPECT_EQ(run(eval + "elevation_map.height=2").exit_code, kUsage);
  EXPECT_EQ(run(eval + "grid.max_band_m=2 --variant blind=paper").exit_code, kUsage);
}

TEST_F(CliEval, DoesNotGoOnWithAVariantOfTheSameNameButAnotherMethod) {
  const eval::MadeUpDataset made_up;
  expect_done(dataset(made_up.root()) + "--variant a=ring_map");
  EXPECT_EQ(run(dataset(made_up.root()) + "--variant a=paper").exit_code, kUsage);
}

TEST_F(CliEval, GoesOnAfterItWasKilled) {
  const eval::MadeUpDataset made_up;
  expect_done(dataset(made_up.root()));
  const auto whole = json("eval.json").at("methods").at("terracut").at("pooled");
  // What a kill leaves behind: some whole lines, and one that was being written.
  const std::string journal = content_of(folder_ / "eval.json.journal");
  fs::remove(folder_ / "eval.json");
  write("eval.json.journal", journal.substr(0, journal.size() / 2));
  expect_done(dataset(made_up.root()));
  EXPECT_EQ(json("eval.json").at("methods").at("terracut").at("pooled"), whole);
}

TEST_F(CliEval, GoesOnWithFewerFramesWithoutThoseItIsNotAskedFor) {
  const eval::MadeUpDataset made_up;
  expect_done(dataset(made_up.root()));
  expect_done(dataset(made_up.root()) + "--sequences 03 --frames 0-1");
  EXPECT_EQ(json("eval.json").at("methods").at("terracut").at("frames").size(), 2U);
  expect_done(dataset(made_up.root()));
  EXPECT_EQ(json("eval.json").at("methods").at("terracut").at("frames").size(), 6U);
}

TEST_F(CliEval, WritesPredictionsThatGotLostAnew) {
  const eval::MadeUpDataset made_up;
  expect_done(dataset(made_up.root()));
  const fs::path lost = folder_ / "predictions/terracut/sequences/03/predictions/000001.label";
  const auto labels = ids_of(lost);
  ASSERT_TRUE(fs::remove(lost));
  expect_done(dataset(made_up.root()));
  EXPECT_EQ(ids_of(lost), labels);
  expect_same_scores(made_up.root());
}

TEST_F(CliEval, DoesNotGoOnWithWhatAnotherBuildBegan) {
  const eval::MadeUpDataset made_up;
  expect_done(dataset(made_up.root()));
  // Another build, as far as anybody can tell by its file.
  fs::copy_file(test::program(), folder_ / "other_build");
  std::ofstream(folder_ / "other_build", std::ios::binary | std::ios::app) << '\n';
  const std::string command = "cd " + quoted(folder_) + " && ./other_build " +
                              dataset(made_up.root()) + " >/dev/null 2>said.txt";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), kUsage);
  const std::string said = content_of(folder_ / "said.txt");
  EXPECT_THAT(said, HasSubstr("was begun with other settings"));
  EXPECT_THAT(said, HasSubstr("build="));
}

TEST_F(CliEval, MeasuresTheProfileItIsToldOrTheConfigurationNames) {
  const eval::MadeUpDataset made_up;
  const std::string eval = "eval semantickitti " + quoted(made_up.root()) + " --frames 0 --json ";
  expect_done(eval + "both.json --method paper,terracut");
  EXPECT_EQ(json("both.json").at("methods").size(), 2U);
  write("paper.yaml", "method: {profile: paper}\n");
  expect_done("--config paper.yaml " + eval + "file.json");
  EXPECT_TRUE(json("file.json").at("methods").contains("paper"));
}

TEST_F(CliEval, SaysWhichFilesItCouldNotEvaluateAndEvaluatesTheRest) {
  const eval::MadeUpDataset made_up;
  fs::remove(made_up.labels("03", 1));
  const Outcome outcome = run(dataset(made_up.root()));
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("000001.bin"));
  EXPECT_THAT(outcome.out, HasSubstr("terracut"));
  const auto report = json("eval.json");
  EXPECT_EQ(report.at("faults").size(), 1U);
  EXPECT_EQ(report.at("methods").at("terracut").at("frames").size(), 5U);
}

TEST_F(CliEval, WarnsOfClassesTheTableDoesNotKnow) {
  const eval::MadeUpDataset made_up;
  write("classes.yaml",
        "classes:\n  - {id: 40, name: road, all: ground, road: ground}\n"
        "  - {id: 10, name: car, all: key, road: key}\n");
  const Outcome outcome = run(dataset(made_up.root()) + "--classes classes.yaml");
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("00/000000: class 50 is not in the class table"));
  EXPECT_THAT(outcome.err, HasSubstr("class 72"));
}

TEST_F(CliEval, IsComparedMethodByMethod) {
  const eval::MadeUpDataset made_up;
  expect_done(dataset(made_up.root()) + "--method terracut,ring_map");
  const auto same = script("compare", "eval.json eval.json --json same.json");
  if (!same) GTEST_SKIP() << kNoPackages;
  EXPECT_EQ(same->exit_code, kOk) << same->err;
  EXPECT_EQ(json("same.json").at("measures").at("iou_g").at("frames").at("p"), 1.0);
  const auto worse = script("compare", "eval.json eval.json --method-after ring_map");
  EXPECT_EQ(worse->exit_code, 8) << worse->out;
  EXPECT_THAT(worse->out, HasSubstr("ring_map of eval.json"));
}

TEST_F(CliEval, RefusesWhatItCannotDoAndSaysWhatIsExpected) {
  const eval::MadeUpDataset made_up;
  const auto expect_refusal = [&](const std::string& options, int exit_code,
                                  const std::string& message) {
    const Outcome outcome = run(dataset(made_up.root()) + options);
    EXPECT_EQ(outcome.exit_code, exit_code) << options << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << options;
  };
  expect_refusal("--method nonsense", kUsage, "there is no method 'nonsense'");
  expect_refusal("--frames 9-3", kUsage, "--frames");
  expect_refusal("--frames 1-3:0", kUsage, "--frames");
  expect_refusal("--set region.nonsense=1", kUsage, "region.nonsense");
  expect_refusal("--classes none.yaml", kInputRefused, "none.yaml");
  expect_refusal("--sequences 17", kNothingCameOut, "17");
  expect_refusal("--frames 50-60", kNothingCameOut, "no frame was evaluated");
  expect_done(dataset(made_up.root()));
  expect_refusal("--method paper", kUsage, "was begun with other settings");
  EXPECT_EQ(run("eval semantickitti nowhere").exit_code, kInputRefused);
}

TEST_F(CliEval, EvaluatesKoblenzDataUnderTheirClassesAndSaysWhatFormatItTookThemFor) {
  const eval::MadeUpKoblenz made_up;
  const Outcome outcome =
      run("eval koblenz " + quoted(made_up.root()) + " --method terracut,paper --json eval.json");
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("published could not be found; PCD files are read"));
  const auto report = json("eval.json");
  EXPECT_EQ(report.at("dataset"), "koblenz");
  EXPECT_EQ(report.at("warnings").size(), 1U);
  EXPECT_EQ(report.at("classes").at(2).at("name"), "rough");
  for (const auto& [name, method] : report.at("methods").items()) {
    EXPECT_TRUE(method.at("sequences").contains("KoblenzForestMap")) << name;
    EXPECT_GT(method.at("mean_over_sequences").at("all").at("iou_g"), 0.9) << name;
  }
  EXPECT_EQ(run("eval koblenz nowhere").exit_code, kInputRefused);
}

TEST_F(CliEval, EvaluatesSimulatedDrivesAndComparesTheirMethods) {
  const std::string eval =
      "eval simulated flat,hill --duration 0.1 --sensor ruby128 --returns dual --json eval.json ";
  expect_done(eval + "--method terracut,pfaff");
  const auto report = json("eval.json");
  EXPECT_EQ(report.at("dataset"), "simulated");
  EXPECT_EQ(report.at("simulated").at("sensor"), "ruby128");
  EXPECT_EQ(report.at("simulated").at("returns"), "dual");
  const auto& sequences = report.at("methods").at("terracut").at("sequences");
  EXPECT_EQ(sequences.at("flat").at("frames"), 1);
  EXPECT_EQ(sequences.at("hill").at("frames"), 1);
  if (const auto compared = script("compare", "eval.json eval.json")) {
    EXPECT_EQ(compared->exit_code, kOk) << compared->err;
  }
  // What it was of belongs to the journal's settings.
  const Outcome other = run(eval + "--method terracut,pfaff --seed 2");
  EXPECT_EQ(other.exit_code, kUsage);
  EXPECT_THAT(other.err, HasSubstr("was begun with other settings"));
}

TEST_F(CliEval, RefusesOptionsThatADatasetWouldNotUse) {
  const auto expect_refusal = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = run("eval " + arguments);
    EXPECT_EQ(outcome.exit_code, kUsage) << arguments << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << arguments;
  };
  expect_refusal("simulated flat --sequences 00", "--sequences");
  expect_refusal("simulated flat --through image", "--through image");
  expect_refusal("simulated flat --jobs 2", "--jobs");
  expect_refusal("simulated flat,moon", "no scene 'moon'");
  expect_refusal("simulated flat --duration 0", "--duration");
  expect_refusal("koblenz . --seed 3", "--seed");
  expect_refusal("semantickitti . --sensor ruby128", "--sensor");
  expect_refusal("semantickitti . --returns dual", "--returns");
  expect_refusal("semantickitti . --duration 3", "--duration");
  expect_refusal("kitti360 .", "kitti360");
  expect_refusal("own .", "--classes FILE");
}

TEST_F(CliEval, PutsHazardsIntoScansAndDrives) {
  const eval::MadeUpDataset made_up;
  const std::string eval = "eval hazards " + quoted(made_up.root()) + " --frames 0 --trials 1 ";
  const Outcome outcome = run(eval + "--kinds child,ghosts_1 --json hazards.json");
  ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("not one return"), HasSubstr("child"), HasSubstr("ghosts_1")));
  const auto report = json("hazards.json");
  EXPECT_EQ(report.at("hazards").at("seed"), 1);
  const auto& method = report.at("methods").at("terracut");
  EXPECT_FALSE(method.at("hazards").empty());
  EXPECT_EQ(method.at("disturbances").size(), 1U);
  EXPECT_EQ(method.at("frames").size(), 2U) << "and what eval measures without them";
  EXPECT_FALSE(fs::exists(folder_ / "hazards.json.journal"));

  expect_done(
      "eval hazards simulated flat --duration 0.1 --kinds box_30cm --trials 1 --json drive.json");
  EXPECT_FALSE(json("drive.json").at("methods").at("terracut").at("hazards").empty());

  expect_done(eval + "--kinds child --write scans");
  expect_done("eval semantickitti scans --json scans.json");
  EXPECT_EQ(json("scans.json").at("methods").at("terracut").at("frames").size(),
            json("scans/hazards.json").at("scans").size());

  const Outcome unknown = run(eval + "--kinds elephant");
  EXPECT_EQ(unknown.exit_code, kUsage);
  EXPECT_THAT(unknown.err, HasSubstr("no hazard 'elephant'"));
  EXPECT_EQ(run(eval + "--report report").exit_code, kUsage);
  EXPECT_EQ(run("eval semantickitti " + quoted(made_up.root()) + " --kinds child").exit_code,
            kUsage);
  write("buildings.yaml",
        "classes:\n  - {id: 40, name: building, all: ordinary, road: ordinary}\n");
  const Outcome no_ground = run(eval + "--classes buildings.yaml");
  EXPECT_EQ(no_ground.exit_code, kNothingCameOut);
  EXPECT_THAT(no_ground.err, HasSubstr("no place for any of these hazards"));
}

TEST_F(CliEval, ComparesObjectsWithTheirTruth) {
  const eval::MadeUpDataset made_up;
  const std::string eval = "eval objects " + quoted(made_up.root()) + " --frames 0 ";
  const Outcome outcome = run(eval + "--json objects.json");
  ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("OSE"), HasSubstr("two-wheelers")));
  const auto report = json("objects.json");
  const auto& objects = report.at("methods").at("terracut").at("objects");
  EXPECT_EQ(
      objects.at("tuned").at("frames").get<int>() + objects.at("unseen").at("frames").get<int>(),
      2);
  EXPECT_EQ(run(eval + "--kinds child").exit_code, kUsage);
  EXPECT_EQ(run(eval + "--report report").exit_code, kUsage);
  expect_done("eval objects simulated flat --duration 0.1");
}

TEST_F(CliEval, MeasuresTheFreeWay) {
  const Outcome outcome =
      run("eval free simulated flat --duration 0.1 --trials 1 --json free.json");
  ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("free way"), HasSubstr("pits")));
  const auto report = json("free.json");
  const auto& free_way = report.at("methods").at("terracut").at("free_way");
  EXPECT_EQ(free_way.at("frames").get<int>(), 1);
  EXPECT_GT(free_way.at("seen_m").get<double>(), 5);
  for (const auto& of_bin : free_way.at("pits")) EXPECT_EQ(of_bin.at("failed").get<int>(), 0);
  EXPECT_EQ(run("eval free simulated flat --kinds child").exit_code, kUsage);
}

TEST_F(CliEval, NamesWhatIsInTheWayOfTheView) {
  const Outcome outcome = run("eval sight simulated street --duration 2.5 --json sight.json");
  ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("fog_30m"), HasSubstr("mud_30")));
  const auto sight = json("sight.json").at("methods").at("terracut").at("sight");
  EXPECT_EQ(sight.at("turns").get<int>(), 25);
  EXPECT_EQ(sight.at("alarms").get<int>(), 0);
  EXPECT_EQ(sight.at("standing_turns").get<int>(), 150);
  EXPECT_EQ(sight.at("standing_alarms").get<int>(), 0);
  for (const auto& effect : sight.at("effects")) {
    EXPECT_EQ(effect.at("named").get<int>(), 1) << effect;
    EXPECT_LE(effect.at("most_turns").get<int>(), 10) << effect;
  }
  EXPECT_EQ(run("eval sight simulated flat --trials 2").exit_code, kUsage);
}

}  // namespace
}  // namespace terracut::cli
