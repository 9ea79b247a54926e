// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/arguments/command_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>
#include <variant>

#include "rt/files/file_place.hpp"
#include "tools/cli/settings/eval_subject.hpp"
#include "tools/cli/settings/setting.hpp"
#include "tools/lab/drive/drive_files.hpp"
#include "tools/lab/drive/vehicle_log.hpp"
#include "tools/lab/packets/encoder_traits.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Kind = RunFiles::Kind;

/// Adds the files of a folder of scans. Only some parts of a sequence folder are read, so results
/// may be written into it; a plain folder is read as a whole.
void add_scans(RunFiles& files, const fs::path& scans) {
  constexpr const char* kPoints = "velodyne";
  std::error_code none;
  const bool is_sequence = fs::is_directory(scans / kPoints, none);
  files.read("SCANS_DIR", is_sequence ? scans / kPoints : scans, "the folder of scans");
  // A sequence's other parts are not read, but must not be overwritten either.
  const fs::path place = files::FilePlace(scans).path();
  if (!is_sequence && place.filename() != kPoints) return;
  const fs::path sequence = is_sequence ? scans : place.parent_path();
  files.read("SCANS_DIR", sequence / "labels", "the truth of the scans");
  for (const char* const name : {"poses.txt", "times.txt", "calib.txt"}) {
    files.read("SCANS_DIR", sequence / name, "a part of the sequence");
  }
}

template <class EncoderTraits>
void add_drive_of(RunFiles& files, const Options& options) {
  const fs::path& capture = options.written;
  files.write("--output", capture);
  const fs::path table = drive::calibration_path_of<EncoderTraits>(capture);
  if (!table.empty()) files.write("the table of --output", table);
  files.write("the truth of --output", drive::truth_folder_of(capture), Kind::kReplacedFolder);
  if (!options.can_log) return;
  files.write("--can-log", drive::can_log_path_of(capture));
  files.write("--can-log", drive::can_dbc_path_of(capture));
}

RunFiles drive_of(const Options& options) {
  RunFiles files;
  if (!options.simulate.pattern.empty()) {
    files.write("the scans of --output", options.written / "velodyne", Kind::kFrames, ".bin");
    files.write("the truth of --output", options.written / "labels", Kind::kFrames, ".label");
    return files;
  }
  packets::with_encoder_traits(
      options.capture.sensor.value_or(sensor::SensorModel::kHdl64e),
      [&](auto traits) { add_drive_of<decltype(traits)>(files, options); });
  return files;
}

/// Names the input: the stream of a live run, or a command's arguments; for a capture also the
/// choice among several sensors.
std::string made_of(Command command, const RunFiles& files, const Options& options) {
  const auto with = [](std::string_view word, const std::string& text) {
    return text.empty() ? std::string() : fmt::format(" {} {}", word, text);
  };
  const CaptureOptions& capture = options.capture;
  if (command == Command::kLive) {
    return "packets at " + options.listen.address + with("by", options.listen.interface) +
           with("from", capture.from);
  }
  std::string text;
  std::string_view named;
  for (const RunFiles::Input& input : files.inputs) {
    if (input.option.starts_with('-') || input.option == named) continue;
    named = input.option;
    text += (text.empty() ? "" : " and ") + files::FilePlace(input.path).path().string();
  }
  if (text.empty()) return text;
  return text + with("topic", capture.topic) + with("from", capture.from) +
         with("port", capture.port ? std::to_string(*capture.port) : "") + with("to", capture.to) +
         with("in VLAN", capture.vlan) + with("of", capture.mac);
}

void add_evaluation(RunFiles& files, const Options& options) {
  const EvalSubject subject = subject_of(options.eval);
  for (const fs::path& root : subject.roots) {
    if (subject.dataset == "semantickitti") {
      files.read("ROOT", root / "sequences", "the dataset");
    } else if (subject.dataset != "simulated") {
      files.read("ROOT", root, "the dataset");
    }
  }
  const bool has_journal = options.eval.changes.empty() && subject.extra == EvalExtra::kNone;
  if (!options.output.json.empty() && has_journal) {
    files.write("the journal of --json", options.output.json.string() + ".journal");
  }
}

}  // namespace

RunFiles files_of(Command command, const Options& options) {
  RunFiles files;
  Options copy = options;
  for (const Setting& setting : settings()) {
    if (!setting.commands.contains(command)) continue;
    const SettingField field = setting.field(copy);
    const auto* const path = std::get_if<fs::path*>(&field);
    if (path == nullptr) continue;
    const std::string name(setting.name());
    if (!setting.reads.empty()) files.read(name, **path, std::string(setting.reads));
    if (setting.writes) files.write(name, **path, *setting.writes, std::string(setting.ending));
  }
  if (command == Command::kSegment || command == Command::kEncode) {
    add_scans(files, options.scans);
  }
  const bool makes_drive = command == Command::kSimulate || command == Command::kEncode;
  if (makes_drive && !options.written.empty()) {
    std::ranges::move(drive_of(options).outputs, std::back_inserter(files.outputs));
  }
  if (command == Command::kEval) add_evaluation(files, options);
  files.made_of = made_of(command, files, options);
  files.replaces_others = options.output.overwrite;
  return files;
}

RunFiles files_of(const Arguments& arguments) {
  RunFiles files = files_of(*arguments.command, arguments.options);
  files.read("--config", arguments.configuration, "the configuration");
  return files;
}

std::string wrote_drive(const Options& options) {
  std::string text;
  for (const RunFiles::Output& output : drive_of(options).outputs) {
    text += fmt::format("{:<10}{}{}\n", text.empty() ? "wrote" : "", output.path.string(),
                        output.kind == Kind::kReplacedFolder ? "/" : "");
  }
  return text;
}

}  // namespace terracut::cli
