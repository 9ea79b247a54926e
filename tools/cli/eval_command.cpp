// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <optional>
#include <string>

#include "commands.hpp"
#include "console.hpp"
#include "json_text.hpp"
#include "live/stop_signal.hpp"
#include "pipeline/parameter_table.hpp"
#include "rt/whole_file.hpp"
#include "setup_choice.hpp"
#include "tools/eval/class_table.hpp"
#include "tools/eval/evaluation.hpp"
#include "tools/eval/evaluation_json.hpp"
#include "tools/eval/journal.hpp"
#include "tools/eval/report/report.hpp"

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

Expected<EvaluationConfig> config_of(const EvalOptions& options) {
  EvaluationConfig config;
  std::error_code error;
  config.root = std::filesystem::weakly_canonical(options.root, error);
  if (error) config.root = options.root;
  config.sequences = options.sequences;
  config.through_packets = options.through == "packets";
  config.jobs = options.jobs;
  config.predictions = options.predictions;
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
      if (const Status set = apply_setting(method->config, setting); !set) {
        return tl::unexpected(set.error());
      }
    }
    config.methods.push_back(*std::move(method));
  }
  return config;
}

Expected<evaluation::ClassTable> classes_of(const EvalOptions& options) {
  if (!options.classes.empty()) return evaluation::ClassTable::read(options.classes);
  return evaluation::ClassTable::parse(evaluation::kSemanticKittiClasses, "built-in class table");
}

/// Everything the counts of a frame depend on: a journal of other settings is not gone on with.
std::string settings_line(const EvaluationConfig& config) {
  std::string line = fmt::format(
      "{} root={} through_packets={} mount={},{},{}", TERRACUT_VERSION, config.root.string(),
      config.through_packets, config.mount.height_m, config.mount.roll_rad, config.mount.pitch_rad);
  for (const evaluation::MethodChoice& method : config.methods) {
    line += " " + method.name + "{";
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

}  // namespace

ExitCode run(const EvalOptions& options) {
  const auto config = config_of(options);
  if (!config) return refuse(config.error());
  const auto classes = classes_of(options);
  if (!classes) return refuse(classes.error());
  std::optional<evaluation::Journal> journal;
  if (!options.json.empty()) {
    auto opened = evaluation::Journal::open(journal_path(options), settings_line(*config));
    if (!opened) return refuse(opened.error());
    journal.emplace(*std::move(opened));
  }

  catch_stop_signals();
  std::optional<Progress> progress;
  const auto outcome = evaluation::evaluate(
      *config, journal ? &*journal : nullptr,
      [&](std::size_t done, std::size_t of) {
        if (!progress) progress.emplace("evaluating", "frames", static_cast<double>(of));
        progress->update(static_cast<double>(done));
      },
      stop_wanted);
  progress.reset();
  if (!outcome) return refuse(outcome.error());

  const auto json = evaluation::evaluation_json(
      {options.dataset, config->root.string(), config->methods, config->through_packets}, *classes,
      *outcome);
  say_outcome(*outcome, json);
  fmt::print("{}", evaluation::evaluation_text(json));
  if (outcome->interrupted) {
    warn(journal ? "interrupted; the same command goes on from here" : "interrupted");
  }
  if (!options.json.empty()) {
    const Status written = rt::write_whole_file(options.json, json_text(json));
    if (!written) return refuse(written.error());
  }
  if (outcome->results.empty()) return kNothingCameOut;
  if (!options.report.empty() && !outcome->interrupted) {
    const Status written = draw_report(options.report, {json, *config, *classes, true});
    if (!written) return refuse(written.error());
  }
  return outcome->interrupted || !outcome->faults.empty() ? kInputRefused : kOk;
}

}  // namespace terracut::cli
