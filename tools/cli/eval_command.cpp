// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "commands.hpp"
#include "console.hpp"
#include "json_text.hpp"
#include "pipeline/parameter_table.hpp"
#include "program_identity.hpp"
#include "rt/whole_file.hpp"
#include "setup_choice.hpp"
#include "stop_signal.hpp"
#include "tools/eval/class_table.hpp"
#include "tools/eval/datasets/koblenz.hpp"
#include "tools/eval/evaluation.hpp"
#include "tools/eval/evaluation_json.hpp"
#include "tools/eval/journal.hpp"
#include "tools/eval/report/report.hpp"
#include "tools/eval/simulated_evaluation.hpp"

namespace terracut::cli {
namespace {

using evaluation::EvaluationConfig;
using evaluation::FrameRange;

/// "7", "0-99", "0-99:10"; empty for all.
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

bool is_simulated(const EvalOptions& options) {
  return options.dataset == "simulated";
}

/// That no option was given which this kind of dataset would not heed.
Status check_fit(const EvalOptions& options) {
  const auto refuse = [&](std::string_view what) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("`eval {}` does not know {}", options.dataset, what));
  };
  if (is_simulated(options)) {
    if (!options.sequences.empty()) return refuse("--sequences: it takes scenes, like street,hill");
    if (options.through == "image") return refuse("--through image: a drive is made of packets");
    if (options.jobs > 0) return refuse("--jobs: drives are evaluated on one core, one by one");
    return {};
  }
  if (options.sensor) return refuse("--sensor, only `eval simulated` does");
  if (options.returns) return refuse("--returns, only `eval simulated` does");
  if (options.duration_s) return refuse("--duration, only `eval simulated` does");
  if (options.seed) return refuse("--seed, only `eval simulated` does");
  return {};
}

/// One name for one folder, wherever it is named from; what has none keeps the one it was given.
std::filesystem::path canonical_path(const std::filesystem::path& path) {
  std::error_code error;
  // Absolute first: of what does not exist, it leaves the relative name as it is.
  const auto absolute = std::filesystem::absolute(path, error);
  auto canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? path : std::move(canonical);
}

/// Of any dataset; of simulated drives `root` is their scenes.
Expected<EvaluationConfig> config_of(const EvalOptions& options) {
  if (const Status fits = check_fit(options); !fits) return tl::unexpected(fits.error());
  EvaluationConfig config;
  if (options.dataset == "koblenz") config.layout = evaluation::DatasetLayout::kKoblenz;
  config.root = is_simulated(options) ? options.root : canonical_path(options.root);
  config.sequences = options.sequences;
  config.through_packets = options.through == "packets" || is_simulated(options);
  config.jobs = options.jobs;
  if (!options.predictions.empty()) config.predictions = canonical_path(options.predictions);
  const auto frames = frame_range_of(options.frames);
  if (!frames) return tl::unexpected(frames.error());
  config.frames = *frames;
  const auto mount = mount_of(options.mount);
  if (!mount) return tl::unexpected(mount.error());
  config.mount = *mount;
  for (const std::string& name : options.methods) {
    auto method = evaluation::method_named(name);
    if (!method) return tl::unexpected(method.error());
    for (const std::string& setting : options.settings) {
      if (const Status set = pipeline::apply_setting(method->config, setting); !set) {
        return tl::unexpected(set.error());
      }
    }
    config.methods.push_back(*std::move(method));
  }
  for (const std::string& text : options.variants) {
    auto variant = evaluation::method_variant(text, options.settings);
    if (!variant) return tl::unexpected(variant.error());
    if (std::ranges::find(config.methods, variant->name, &evaluation::MethodChoice::name) !=
        config.methods.end()) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("variant '{}': another one has its name", text));
    }
    config.methods.push_back(*std::move(variant));
  }
  return config;
}

/// The drives that `eval simulated` was asked for.
evaluation::SimulatedDrives drives_of(const EvalOptions& options) {
  evaluation::SimulatedDrives drives;
  const std::string scenes = options.root.string();
  for (std::size_t begin = 0; begin <= scenes.size();) {
    const std::size_t end = std::min(scenes.find(',', begin), scenes.size());
    drives.scenes.push_back(scenes.substr(begin, end - begin));
    begin = end + 1;
  }
  if (options.sensor) drives.sensor = *options.sensor;
  drives.dual_return = options.returns == "dual";
  if (options.duration_s) drives.duration_s = *options.duration_s;
  if (options.seed) drives.seed = *options.seed;
  return drives;
}

Expected<evaluation::ClassTable> classes_of(const EvalOptions& options) {
  if (!options.classes.empty()) return evaluation::ClassTable::read(options.classes);
  const char* const table = options.dataset == "koblenz" ? evaluation::kKoblenzClasses
                                                         : evaluation::kSemanticKittiClasses;
  return evaluation::ClassTable::parse(table, "built-in class table");
}

/// Everything the counts of a frame depend on: a journal of other settings is not gone on with.
std::string settings_line(const EvalOptions& options, const EvaluationConfig& config) {
  std::string line = fmt::format(
      "{} build={} dataset={} root={} through_packets={} mount={},{},{}", TERRACUT_VERSION,
      program_identity(), options.dataset, config.root.string(), config.through_packets,
      config.mount.height_m, config.mount.roll_rad, config.mount.pitch_rad);
  if (!config.predictions.empty()) line += " predictions=" + config.predictions.string();
  if (is_simulated(options)) {
    const auto drives = drives_of(options);
    line += fmt::format(" sensor={} dual_return={} duration_s={} seed={}", drives.sensor,
                        drives.dual_return, drives.duration_s, drives.seed);
  }
  for (const evaluation::MethodChoice& method : config.methods) {
    line += fmt::format(" {}={}{{", method.name, method.base);
    for (const auto part : {pipeline::parameters(), pipeline::rival_parameters()}) {
      for (const pipeline::Parameter& parameter : part) {
        line +=
            fmt::format("{}={} ", parameter.key, pipeline::value_text(parameter, method.config));
      }
    }
    line.back() = '}';
  }
  return line;
}

std::filesystem::path journal_path(const EvalOptions& options) {
  return options.json.string() + ".journal";
}

void say_outcome(const evaluation::EvaluationOutcome& outcome, const nlohmann::ordered_json& json) {
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

Status draw_report(const std::filesystem::path& folder, const evaluation::ReportInput& input) {
  std::optional<Progress> progress;
  return evaluation::write_report(folder, input, [&](std::size_t done, std::size_t of) {
    if (!progress) progress.emplace("drawing the report", "frames", static_cast<double>(of));
    progress->update(static_cast<double>(done));
  });
}

Expected<evaluation::EvaluationOutcome> evaluate_scans(
    const EvaluationConfig& config, std::optional<evaluation::Journal>& journal) {
  std::optional<Progress> progress;
  return evaluation::evaluate(
      config, journal ? &*journal : nullptr,
      [&](std::size_t done, std::size_t of) {
        if (!progress) progress.emplace("evaluating", "frames", static_cast<double>(of));
        progress->update(static_cast<double>(done));
      },
      stop_wanted);
}

Expected<evaluation::EvaluationOutcome> evaluate_drives(
    const EvalOptions& options, const EvaluationConfig& config,
    std::optional<evaluation::Journal>& journal) {
  std::optional<Progress> simulating, evaluating;
  const evaluation::SimulatedProgress progress{
      [&](double done_s, double of_s) {
        evaluating.reset();
        if (!simulating) simulating.emplace("simulating", "seconds", of_s);
        simulating->update(done_s);
      },
      [&](std::size_t done, std::size_t of) {
        simulating.reset();
        if (!evaluating) evaluating.emplace("evaluating", "frames", static_cast<double>(of));
        evaluating->update(static_cast<double>(done));
      }};
  return evaluation::evaluate_simulated({drives_of(options), config.frames, config.methods,
                                         config.mount, config.predictions, config.changed_frames},
                                        journal ? &*journal : nullptr, progress, stop_wanted);
}

/// What a report's reader has to know of this dataset besides.
void add_facts_of_dataset(const EvalOptions& options, nlohmann::ordered_json& json) {
  if (options.dataset == "koblenz") {
    json["warnings"].push_back({{"where", "koblenz"}, {"what", evaluation::kKoblenzFormatNote}});
  }
  if (!is_simulated(options)) return;
  const auto drives = drives_of(options);
  json["simulated"] = {{"sensor", drives.sensor},
                       {"returns", drives.dual_return ? "dual" : "single"},
                       {"duration_s", drives.duration_s},
                       {"seed", drives.seed}};
}

}  // namespace

ExitCode run(const EvalOptions& options) {
  auto config = config_of(options);
  if (!config) return refuse(config.error());
  const auto classes = classes_of(options);
  if (!classes) return refuse(classes.error());
  std::optional<evaluation::report::ChangedFrames> changed;
  if (!options.changes.empty()) {
    config->changed_frames = &changed.emplace(config->methods, *classes);
  }
  std::optional<evaluation::Journal> journal;
  // Frames that a journal has are not labelled again, and their labels are not in it.
  if (!options.json.empty() && options.changes.empty()) {
    auto opened = evaluation::Journal::open(journal_path(options), settings_line(options, *config));
    if (!opened) return refuse(opened.error());
    journal.emplace(*std::move(opened));
  }

  catch_stop_signals();
  const auto outcome = is_simulated(options) ? evaluate_drives(options, *config, journal)
                                             : evaluate_scans(*config, journal);
  if (!outcome) return refuse(outcome.error());

  auto json = evaluation::evaluation_json(
      {options.dataset, config->root.string(), config->methods, config->through_packets}, *classes,
      *outcome);
  add_facts_of_dataset(options, json);
  say_outcome(*outcome, json);
  fmt::print("{}", evaluation::evaluation_text(json));
  if (outcome->interrupted) {
    warn(journal ? "interrupted; the same command goes on from here" : "interrupted");
  }
  if (!options.json.empty()) {
    const Status written = rt::write_whole_file(options.json, json_text(json));
    if (!written) return refuse(written.error());
  }
  if (outcome->results.empty() && outcome->interrupted) {
    return refuse(kInterrupted, "interrupted before the first frame was evaluated");
  }
  if (outcome->results.empty()) {
    return refuse(kNothingCameOut,
                  "no frame was evaluated; see the warnings, --sequences, --frames");
  }
  if (!options.report.empty() && !outcome->interrupted) {
    const Status written =
        draw_report(options.report, {json, *config, *classes, !is_simulated(options)});
    if (!written) return refuse(written.error());
  }
  if (changed && !outcome->interrupted) {
    const Status written = changed->write(options.changes);
    if (!written) return refuse(written.error());
  }
  if (outcome->interrupted) return kInterrupted;
  return outcome->faults.empty() ? kOk : kInputRefused;
}

}  // namespace terracut::cli
