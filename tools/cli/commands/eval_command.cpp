// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calib/beams/angle.hpp"
#include "pipeline/ground/parameter_table.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/eval_subject.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/settings/words.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/research/baselines/parameter_table.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/eval/changed_frames.hpp"
#include "tools/research/eval/evaluation.hpp"
#include "tools/research/eval/evaluation_json.hpp"
#include "tools/research/eval/journal.hpp"
#include "tools/research/eval/simulated_evaluation.hpp"
#include "tools/research/free_measures/free_report.hpp"
#include "tools/research/free_measures/free_trials.hpp"
#include "tools/research/hazards/hazard_report.hpp"
#include "tools/research/hazards/hazard_trials.hpp"
#include "tools/research/object_measures/object_report.hpp"
#include "tools/research/object_measures/object_trials.hpp"
#include "tools/research/report/evaluation_report.hpp"
#include "tools/research/sight_measures/sight_report.hpp"
#include "tools/research/sight_measures/sight_trials.hpp"

namespace terracut::cli {
namespace {

using eval::EvaluationConfig;
using eval::FrameRange;

/// Parses "7", "0-99" or "0-99:10" (every 10th frame); an empty text means all frames.
Expected<FrameRange> frame_range_of(const std::string& text) {
  FrameRange range;
  if (text.empty()) return range;
  const auto refuse = [&] {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("--frames: expected FIRST, FIRST-LAST or FIRST-LAST:STEP, like 0-99:10, "
                    "found '{}'",
                    text));
  };
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  const auto number = [&](std::size_t& value) {
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{}) return false;
    at = next;
    return true;
  };
  if (!number(range.first)) return refuse();
  range.last = range.first;
  if (at != end && *at == '-') {
    ++at;
    if (!number(range.last) || range.last < range.first) return refuse();
  }
  if (at != end && *at == ':') {
    ++at;
    if (!number(range.step) || range.step == 0) return refuse();
  }
  if (at != end) return refuse();
  return range;
}

bool is_simulated(const Options& options) {
  return options.eval.dataset == "simulated";
}

bool is_any_given(const Options& options, std::initializer_list<const char*> names) {
  return std::ranges::any_of(names, [&](const char* name) {
    return std::ranges::find(options.given, name) != options.given.end();
  });
}

/// Refuses options that are not used with what is measured beside labels.
Status check_fit_of_extra(const Options& options, const EvalExtra extra,
                          const std::string& dataset) {
  std::vector<const char*> unused;
  if (extra != EvalExtra::kHazards) unused = {"--kinds", "--write"};
  if (extra != EvalExtra::kHazards && extra != EvalExtra::kFree) unused.push_back("--trials");
  if (extra == EvalExtra::kNone) unused.push_back("MORE");
  if (extra != EvalExtra::kNone) {
    unused.insert(unused.end(), {"--report", "--changes", "--predictions"});
  }
  for (const char* const name : unused) {
    if (!is_any_given(options, {name})) continue;
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("`eval {}` does not know {}", dataset, name));
  }
  return {};
}

/// Refuses options that this kind of dataset does not use.
Status check_fit(const Options& options, const EvalSubject& subject, const std::string& dataset) {
  if (const Status fits = check_fit_of_extra(options, subject.extra, dataset); !fits) return fits;
  const auto refuse = [&](std::string_view what) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("`eval {}` does not know {}", options.eval.dataset, what));
  };
  if (options.eval.dataset == "own" && options.eval.classes.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "`eval own` needs --classes FILE, which says how your clouds lie on disk");
  }
  if (options.eval.find_mount && !options.eval.report.empty()) {
    return refuse("--find-mount with --report, whose pictures have one mount");
  }
  if (is_simulated(options)) {
    if (!options.eval.sequences.empty())
      return refuse("--sequences: it takes scenes, like street,hill");
    if (options.eval.through_packets == false)
      return refuse("--through image: a drive is made of packets");
    if (options.eval.jobs > 0)
      return refuse("--jobs: drives are evaluated on one core, one by one");
    return {};
  }
  if (options.eval.find_mount &&
      is_any_given(options, {"--setup", "--mount-height", "--mount-roll", "--mount-pitch"})) {
    return refuse("--find-mount with a mount that is stated");
  }
  for (const char* const option : {"--sensor", "--returns", "--duration", "--seed"}) {
    const bool is_random =
        subject.extra != EvalExtra::kNone && subject.extra != EvalExtra::kObjects;
    if (is_random && option == std::string_view("--seed")) continue;
    if (is_any_given(options, {option})) {
      return refuse(fmt::format("{}, only `eval simulated` does", option));
    }
  }
  return {};
}

/// Returns the same name for a folder by whatever path it is given; for a missing folder the given
/// name.
std::filesystem::path canonical_path(const std::filesystem::path& path) {
  std::error_code error;
  // Makes the path absolute first, because weakly_canonical() would leave a missing path relative.
  const auto absolute = std::filesystem::absolute(path, error);
  auto canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? path : std::move(canonical);
}

/// Returns the methods of --method, or the profile.
std::vector<std::string> methods_of(const Options& options) {
  if (!options.eval.methods.empty()) return options.eval.methods;
  return {std::string(word_of(kProfileWords, options.method.profile))};
}

/// Makes the configuration for any dataset; for simulated drives `root` has the names of the
/// scenes.
Expected<EvaluationConfig> config_of(const Options& options, const datasets::ClassTable& classes) {
  EvaluationConfig config;
  if (classes.layout()) config.layout = *classes.layout();
  config.root = is_simulated(options) ? options.eval.root : canonical_path(options.eval.root);
  config.sequences = options.eval.sequences;
  config.through_packets = options.eval.through_packets == true || is_simulated(options);
  config.jobs = options.eval.jobs;
  if (!options.eval.predictions.empty()) {
    config.predictions = canonical_path(options.eval.predictions);
  }
  const auto frames = frame_range_of(options.eval.frames);
  if (!frames) return tl::unexpected(frames.error());
  config.frames = *frames;
  const auto mount = mount_of(options.mount);
  if (!mount) return tl::unexpected(mount.error());
  config.mount = *mount;
  config.find_mount = options.eval.find_mount;
  for (const std::string& name : methods_of(options)) {
    auto method = eval::method_named(name);
    if (!method) return tl::unexpected(method.error());
    for (const std::string& setting : options.method.settings) {
      if (const Status set = baselines::apply_setting(method->config, setting); !set) {
        return tl::unexpected(set.error());
      }
    }
    config.methods.push_back(*std::move(method));
  }
  for (const std::string& text : options.eval.variants) {
    auto variant = eval::method_variant(text, options.method.settings);
    if (!variant) return tl::unexpected(variant.error());
    if (std::ranges::find(config.methods, variant->name, &eval::MethodChoice::name) !=
        config.methods.end()) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("variant '{}': another one has its name", text));
    }
    config.methods.push_back(*std::move(variant));
  }
  return config;
}

/// Returns the drives for `eval simulated`.
eval::SimulatedDrives drives_of(const Options& options) {
  eval::SimulatedDrives drives;
  const std::string scenes = options.eval.root.string();
  for (std::size_t begin = 0; begin <= scenes.size();) {
    const std::size_t end = std::min(scenes.find(',', begin), scenes.size());
    drives.scenes.push_back(scenes.substr(begin, end - begin));
    begin = end + 1;
  }
  drives.sensor = options.capture.sensor.value_or(drives.sensor);
  drives.dual_return = options.simulate.returns == packets::ReturnMode::kDual;
  drives.duration_s = options.simulate.duration_s;
  drives.seed = options.simulate.seed;
  return drives;
}

Expected<datasets::ClassTable> classes_of(const Options& all) {
  const EvalOptions& options = all.eval;
  if (options.dataset == "own") {
    auto own = datasets::ClassTable::read(options.classes);
    if (!own || own->layout()) return own;
    return fail(ErrorCode::kMalformed, options.classes.string() +
                                           ": `eval own` needs a class table with a `layout:`, as "
                                           "in tools/research/datasets/semantickitti_classes.yaml");
  }
  auto built_in = datasets::built_in_table(is_simulated(all) ? "semantickitti" : options.dataset);
  if (!built_in || options.classes.empty()) return built_in;
  auto own = datasets::ClassTable::read(options.classes);
  if (own) own->take_layout(*built_in);
  return own;
}

/// Returns a number that two builds share only if they are identical byte for byte, so that one
/// does not continue the other's journal; "unknown" if the system does not let a program read its
/// own file.
std::string identity_of_this_build() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  const std::string program(std::istreambuf_iterator<char>(file), {});
  if (program.empty()) return "unknown";
  return fmt::format("{:016x}", std::hash<std::string>()(program));
}

/// Returns everything that a frame's counts depend on, because a journal with other settings must
/// not be continued.
std::string settings_line(const Options& options, const EvaluationConfig& config) {
  std::string line =
      fmt::format("{} build={} dataset={} layout={} root={} through_packets={} mount={},{},{}",
                  TERRACUT_VERSION, identity_of_this_build(), options.eval.dataset,
                  datasets::to_string(config.layout), config.root.string(), config.through_packets,
                  config.mount.height_m, config.mount.roll_rad, config.mount.pitch_rad);
  if (options.eval.dataset == "own") {
    for (const datasets::ClassEntry& entry : config.classes->entries()) {
      line += fmt::format(" class={}:{}:{}", entry.id, entry.name,
                          static_cast<int>(entry.role(datasets::GroundDefinition::kAll)));
    }
  }
  if (config.find_mount) line += " find_mount";
  if (!config.predictions.empty()) line += " predictions=" + config.predictions.string();
  if (is_simulated(options)) {
    const auto drives = drives_of(options);
    line += fmt::format(" sensor={} dual_return={} duration_s={} seed={}",
                        sensor::row_of(drives.sensor).word, drives.dual_return, drives.duration_s,
                        drives.seed);
  }
  for (const eval::MethodChoice& method : config.methods) {
    line += fmt::format(" {}={}{{", method.name, method.base);
    const auto add = [&](const auto& parameters, const auto& values) {
      for (const auto& parameter : parameters) {
        line += fmt::format("{}={} ", parameter.key, parameter.text(values));
      }
    };
    add(ground::parameters(), method.config.segmenter);
    add(baselines::parameters(), method.config);
    line.back() = '}';
  }
  return line;
}

std::filesystem::path journal_path(const Options& options) {
  return options.output.json.string() + ".journal";
}

void say_outcome(const eval::EvaluationOutcome& outcome, const nlohmann::ordered_json& json) {
  constexpr std::size_t kShown = 20;
  for (std::size_t i = 0; i < outcome.faults.size() && i < kShown; ++i) {
    warn("not evaluated: " + outcome.faults[i].what);
  }
  if (outcome.faults.size() > kShown) {
    warn(fmt::format("and {} more, see `faults` in the report", outcome.faults.size() - kShown));
  }
  for (const auto& warning : json.at("warnings")) {
    warn(warning.at("where").get<std::string>() + ": " + warning.at("what").get<std::string>());
  }
}

Status write_report(const std::filesystem::path& folder, const report::ReportInput& input) {
  std::optional<Progress> progress;
  const Status written = report::write_report(folder, input, [&](std::size_t done, std::size_t of) {
    if (!progress) progress.emplace("drawing frames", "frames", static_cast<double>(of));
    progress->update(static_cast<double>(done));
  });
  progress.reset();
  if (written) print_out("report    ./tools/report {} draws the page\n", folder.string());
  return written;
}

Expected<eval::EvaluationOutcome> evaluate_scans(const EvaluationConfig& config,
                                                 std::optional<eval::Journal>& journal) {
  std::optional<Progress> progress;
  return eval::evaluate(
      config, journal ? &*journal : nullptr,
      [&](std::size_t done, std::size_t of) {
        if (!progress) progress.emplace("evaluating", "frames", static_cast<double>(of));
        progress->update(static_cast<double>(done));
      },
      stop_wanted);
}

/// Evaluates one root after the other. If several frames have the same sequence and name, the first
/// counts.
Expected<eval::EvaluationOutcome> evaluate_datasets(EvaluationConfig config,
                                                    const EvalSubject& subject,
                                                    std::optional<eval::Journal>& journal) {
  eval::EvaluationOutcome all;
  for (const std::filesystem::path& root : subject.roots) {
    config.root = canonical_path(root);
    auto outcome = evaluate_scans(config, journal);
    if (!outcome) return outcome;
    all.results.merge(outcome->results);
    all.found_mounts.merge(outcome->found_mounts);
    std::ranges::move(outcome->faults, std::back_inserter(all.faults));
    all.interrupted = outcome->interrupted;
    if (all.interrupted) break;
  }
  return all;
}

Expected<eval::EvaluationOutcome> evaluate_drives(const Options& options,
                                                  const EvaluationConfig& config,
                                                  std::optional<eval::Journal>& journal) {
  std::optional<Progress> simulating, evaluating;
  const eval::SimulatedProgress progress{[&](double done_s, double of_s) {
                                           evaluating.reset();
                                           if (!simulating)
                                             simulating.emplace("simulating", "s", of_s);
                                           simulating->update(done_s);
                                         },
                                         [&](std::size_t done, std::size_t of) {
                                           simulating.reset();
                                           if (!evaluating)
                                             evaluating.emplace("evaluating", "frames",
                                                                static_cast<double>(of));
                                           evaluating->update(static_cast<double>(done));
                                         }};
  return eval::evaluate_simulated({drives_of(options), config.frames, config.methods, config.mount,
                                   config.find_mount, config.predictions, config.on_labelled},
                                  journal ? &*journal : nullptr, progress, stop_wanted);
}

/// Adds facts about this dataset for the report's reader.
void add_facts_of_dataset(const Options& options, const datasets::ClassTable& classes,
                          nlohmann::ordered_json& json) {
  if (!classes.note().empty()) {
    json["warnings"].push_back({{"where", options.eval.dataset}, {"what", classes.note()}});
  }
  if (!is_simulated(options)) return;
  const auto drives = drives_of(options);
  json["simulated"] = {{"sensor", sensor::row_of(drives.sensor).word},
                       {"returns", drives.dual_return ? "dual" : "single"},
                       {"duration_s", drives.duration_s},
                       {"seed", drives.seed}};
}

void add_found_mounts(const eval::EvaluationOutcome& outcome, nlohmann::ordered_json& json) {
  for (const auto& [sequence, found] : outcome.found_mounts) {
    const double roll_deg = beams::rad_to_deg(found.mount.roll_rad),
                 pitch_deg = beams::rad_to_deg(found.mount.pitch_rad);
    say(
        fmt::format("{}: mount: height {:.3f} m, roll {:.2f} deg, pitch {:.2f} deg, found in {} "
                    "frames",
                    sequence, found.mount.height_m, roll_deg, pitch_deg, found.frames));
    json["found_mounts"][sequence] = {{"height_m", found.mount.height_m},
                                      {"roll_deg", roll_deg},
                                      {"pitch_deg", pitch_deg},
                                      {"frames", found.frames}};
  }
}

/// Adds the trials of every method to the report and prints them.
void add_hazards(const hazards::HazardTrials& trials, const EvaluationConfig& config,
                 const EvalSubject& subject, nlohmann::ordered_json& json) {
  json["hazards"] = {{"seed", trials.choice().seed}, {"trials", trials.choice().trials}};
  for (const auto& root : subject.roots) json["hazards"]["roots"].push_back(root.string());
  for (std::size_t i = 0; i < config.methods.size(); ++i) {
    const std::string& name = config.methods[i].name;
    json["methods"][name].update(hazards::hazard_json(trials, i));
    print_text(hazards::hazard_text(name, json["methods"][name]) + "\n");
  }
  if (trials.frames_without_ground() > 0) {
    warn(fmt::format("{} frames have no labelled ground 5 to 60 m away; nothing was put into them",
                     trials.frames_without_ground()));
  }
}

/// Adds the objects of every method to the report and prints how well they come apart.
void add_objects(const object_measures::ObjectTrials& objects, const EvaluationConfig& config,
                 nlohmann::ordered_json& json) {
  for (std::size_t i = 0; i < config.methods.size(); ++i) {
    const std::string& name = config.methods[i].name;
    json["methods"][name]["objects"] = object_measures::object_json(objects.counts(i));
    print_text(object_measures::object_text(name, json["methods"][name]["objects"]) + "\n");
  }
}

/// Adds the free way of every method to the report and prints how right it is.
void add_free_way(const free_measures::FreeTrials& trials, const EvaluationConfig& config,
                  nlohmann::ordered_json& json) {
  for (std::size_t i = 0; i < config.methods.size(); ++i) {
    const std::string& name = config.methods[i].name;
    json["methods"][name]["free_way"] = free_measures::free_json(trials.counts(i));
    print_text(free_measures::free_text(name, json["methods"][name]["free_way"]) + "\n");
  }
}

/// Adds what every method's view named to the report and prints it.
void add_sight(const sight_measures::SightTrials& trials, const EvaluationConfig& config,
               nlohmann::ordered_json& json) {
  for (std::size_t i = 0; i < config.methods.size(); ++i) {
    const std::string& name = config.methods[i].name;
    json["methods"][name]["sight"] = sight_measures::sight_json(trials.counts(i));
    print_text(sight_measures::sight_text(name, json["methods"][name]["sight"]) + "\n");
  }
}

}  // namespace

ExitCode run_eval(const Options& given) {
  const EvalSubject subject = subject_of(given.eval);
  Options options = given;
  options.eval.dataset = subject.dataset;
  options.eval.root = subject.roots.front();
  if (const Status fits = check_fit(options, subject, given.eval.dataset); !fits)
    return refuse(fits.error());
  const auto classes = classes_of(options);
  if (!classes) return refuse(classes.error());
  auto config = config_of(options, *classes);
  if (!config) return refuse(config.error());
  // The built-in table is preferred: a change of which classes are tall or moving needs no other
  // run.
  const auto built_in = datasets::built_in_table(options.eval.dataset);
  config->classes = built_in ? &*built_in : &*classes;
  std::optional<eval::ChangedFrames> changed;
  if (!options.eval.changes.empty()) {
    changed.emplace(config->methods, *classes);
    config->on_labelled = [&](const eval::LabelledByAll& frame) { changed->look(frame); };
  }
  std::optional<hazards::ScanWriter> writer;
  std::optional<hazards::HazardTrials> trials;
  if (subject.extra == EvalExtra::kHazards) {
    hazards::HazardChoice choice;
    choice.trials = options.eval.trials;
    choice.seed = options.simulate.seed;
    const Status chosen = hazards::choose(options.eval.kinds, choice);
    if (!chosen) return refuse(chosen.error());
    if (!options.eval.hazard_scans.empty()) writer.emplace(options.eval.hazard_scans);
    trials.emplace(config->methods, *classes, std::move(choice), writer ? &*writer : nullptr);
    config->on_labelled = [&](const eval::LabelledByAll& frame) { trials->look(frame); };
  }
  std::optional<object_measures::ObjectTrials> objects;
  if (subject.extra == EvalExtra::kObjects) {
    objects.emplace(config->methods.size());
    config->on_labelled = [&](const eval::LabelledByAll& frame) { objects->look(frame); };
  }
  std::optional<free_measures::FreeTrials> free_way;
  if (subject.extra == EvalExtra::kFree) {
    free_way.emplace(config->methods, *classes, options.eval.trials, options.simulate.seed);
    config->on_labelled = [&](const eval::LabelledByAll& frame) { free_way->look(frame); };
  }
  std::optional<sight_measures::SightTrials> sight;
  if (subject.extra == EvalExtra::kSight) {
    sight.emplace(config->methods, *classes, options.simulate.seed);
    config->jobs = 1;  // frames of a sequence follow each other
    config->on_labelled = [&](const eval::LabelledByAll& frame) { sight->look(frame); };
  }
  std::optional<eval::Journal> journal;
  // No journal is kept where labels are needed: frames in a journal are not labelled again, and it
  // does not hold their labels.
  if (!options.output.json.empty() && !config->on_labelled) {
    auto opened = eval::Journal::open(journal_path(options), settings_line(options, *config));
    if (!opened) return refuse(opened.error());
    journal.emplace(*std::move(opened));
  }

  catch_stop_signals();
  const auto outcome = is_simulated(options) ? evaluate_drives(options, *config, journal)
                                             : evaluate_datasets(*config, subject, journal);
  if (!outcome) return refuse(outcome.error());

  auto json = eval::evaluation_json(
      {options.eval.dataset, config->root.string(), config->methods, config->through_packets},
      *classes, *outcome);
  add_facts_of_dataset(options, *classes, json);
  add_found_mounts(*outcome, json);
  say_outcome(*outcome, json);
  if (trials) add_hazards(*trials, *config, subject, json);
  if (objects) add_objects(*objects, *config, json);
  if (free_way) add_free_way(*free_way, *config, json);
  if (sight) add_sight(*sight, *config, json);
  print_text(eval::evaluation_text(json));
  if (outcome->interrupted) {
    warn(journal ? "interrupted; the same command goes on from here" : "interrupted");
  }
  if (const Status saved = write_json(options.output.json, json); !saved) {
    return refuse(saved.error());
  }
  if (outcome->results.empty() && outcome->interrupted) {
    return refuse(kInterrupted, "interrupted before the first frame was evaluated");
  }
  if (outcome->results.empty()) {
    return refuse(kNothingCameOut,
                  "no frame was evaluated; see the warnings, --sequences, --frames");
  }
  if (trials && trials->is_empty() && !outcome->interrupted) {
    return refuse(
        kNothingCameOut,
        "there is no place for any of these hazards: they are put on labelled ground 5 to "
        "60 m away, where nothing else stands and 4 returns show them");
  }
  if (!options.eval.report.empty() && !outcome->interrupted) {
    const Status written =
        write_report(options.eval.report, {json, *config, *classes, !is_simulated(options)});
    if (!written) return refuse(written.error());
  }
  if (writer) {
    if (const Status written = writer->finish(); !written) return refuse(written.error());
  }
  if (changed && !outcome->interrupted) {
    const Status written = changed->write(options.eval.changes);
    if (!written) return refuse(written.error());
  }
  if (outcome->interrupted) return kInterrupted;
  return outcome->faults.empty() ? kOk : kInputRefused;
}

}  // namespace terracut::cli
