// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drive_labelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "drive_inputs.hpp"
#include "labelled_drive.hpp"
#include "program_run.hpp"
#include "rt/files/part_file.hpp"
#include "rt/files/whole_file.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kBrokeOff = "the input breaks off";
constexpr std::string_view kChanged = "an input changed while it was labelled";
constexpr std::string_view kNoPlace = "something else has its place";

std::string cause_of(ExitCode code) {
  switch (code) {
    case kUsage:
      return "the settings do not fit the input";
    case kInputRefused:
      return "an input was refused";
    case kOutputFailed:
      return "the output could not be written";
    case kMountNotFound:
      return "the mount is not found";
    case kNothingCameOut:
      return "no frame came out";
    default:
      return "the program failed";
  }
}

/// A temporary folder of this process, removed with this object.
class LabellingFolder {
 public:
  LabellingFolder(const RelabelJob& job, const FleetDrive& drive)
      : part_(files::make_part_folder(job.parts() / (job.part_prefix(drive) + job.host))) {}
  LabellingFolder(const LabellingFolder&) = delete;
  LabellingFolder& operator=(const LabellingFolder&) = delete;
  ~LabellingFolder() {
    std::error_code gone_or_not;
    if (part_.lock) fs::remove_all(part_.path, gone_or_not);
  }

  [[nodiscard]] bool made() const { return static_cast<bool>(part_.lock); }
  /// Returns the part of this folder that later becomes the drive's folder. It gets the user's
  /// normal rights for new folders.
  [[nodiscard]] fs::path labels() const { return part_.path / "labels"; }
  [[nodiscard]] fs::path settings() const { return labels() / kJobSettings; }
  [[nodiscard]] fs::path report() const { return part_.path / "report.json"; }
  [[nodiscard]] fs::path log() const { return part_.path / "log.txt"; }

 private:
  files::Part part_;
};

/// Returns the options that tell the run where to write.
std::vector<std::string> output_words(const RelabelJob& job, const Json& recipe,
                                      const LabellingFolder& folder) {
  std::vector<std::string> words{"--json", folder.report().string()};
  switch (job.format) {
    case FleetFormat::kLabels:
      words.insert(words.end(), {"--labels", folder.labels().string()});
      return words;
    case FleetFormat::kMcap:
      words.insert(words.end(),
                   {"--mcap", (folder.labels() / "returns.mcap").string(), "--mcap-clouds",
                    "points", "--metadata", "terracut.recipe=" + recipe.dump()});
      return words;
  }
  return words;
}

/// Returns a run's report without its frames, 36,000 in an hour.
Json report_without_frames(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Json::parse(
      file,
      [](int depth, Json::parse_event_t event, const Json& parsed) {
        return depth != 1 || event != Json::parse_event_t::key || parsed != "frames";
      },
      false);
}

/// Returns the last error in the log; if there is none, its last line.
std::string last_words(const fs::path& log) {
  std::ifstream file(log);
  std::string error, last;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("error: ")) error = line.substr(std::string_view("error: ").size());
    if (!line.empty()) last = line;
  }
  return error.empty() ? last : error;
}

ExitCode failed(ExitCode code, std::string_view cause, std::string message, RelabelRecord& record) {
  record.done = false;
  record.cause = cause;
  record.message = std::move(message);
  return code;
}

ExitCode failed(const Error& error, RelabelRecord& record) {
  if (stop_wanted()) return kInterrupted;
  const ExitCode code = exit_code_of(error.code);
  record.ends_shard = code == kOutputFailed;
  return failed(code, cause_of(code), error.message, record);
}

/// Records an error of check_place() or put_in_place().
ExitCode not_placed(const Error& error, RelabelRecord& record) {
  if (error.code == ErrorCode::kWriteFailed) return failed(error, record);
  return failed(kOutputFailed, kNoPlace, error.message, record);
}

/// Records why the run's labels cannot be used, if they cannot.
ExitCode judge(const ProgramRun& run, const Json& report, const LabellingFolder& folder,
               RelabelRecord& record) {
  if (run.signal != 0) {
    return failed(kInternal, fmt::format("signal {} ended the program", run.signal),
                  last_words(folder.log()), record);
  }
  if (run.exit_code != kOk) {
    const auto code = static_cast<ExitCode>(run.exit_code);
    record.ends_shard = code == kOutputFailed;  // all other drives are written to the same disk
    return failed(code, cause_of(code), last_words(folder.log()), record);
  }
  if (!report.is_object() || !report.contains("summary")) {
    return failed(kInternal, cause_of(kInternal), "it left no report", record);
  }
  if (const std::string fault = report.value("input_warning", ""); !fault.empty()) {
    return failed(kInputRefused, kBrokeOff, fault, record);
  }
  return kOk;
}

}  // namespace

ExitCode label_drive(const RelabelJob& job, const FleetDrive& drive, const Json& recipe,
                     RelabelRecord& record) {
  const fs::path place = job.folder / record.output;
  if (const Status free = check_place(place); !free) return not_placed(free.error(), record);
  const LabellingFolder folder(job, drive);
  if (!folder.made()) {
    const std::error_code error(errno, std::generic_category());
    return failed(
        {ErrorCode::kWriteFailed, fmt::format("{}: {}", job.parts().string(), error.message())},
        record);
  }
  if (Status written = files::write_whole_file(folder.settings(), job.settings); !written) {
    return failed(written.error(), record);
  }
  auto words = words_for(drive, folder.settings());
  if (!words) return failed(words.error(), record);
  std::ranges::move(output_words(job, recipe, folder), std::back_inserter(*words));
  const auto run = run_program(*words, folder.log());
  if (!run) return failed(run.error(), record);
  record.run = *run;
  if (stop_wanted()) return kInterrupted;
  const Json report = report_without_frames(folder.report());
  if (const ExitCode judged = judge(*run, report, folder, record); judged != kOk) return judged;

  const auto stamps = stamps_of(drive);
  if (!stamps || *stamps != record.stamps) {
    return failed(kInputRefused, kChanged,
                  "its labels were thrown away; the same command labels it again once nobody "
                  "writes to it",
                  record);
  }

  const Json& summary = report["summary"];
  Json facts{{"drive", drive.name}, {"recipe", recipe}};
  for (const char* const key : {"frames", "complete_frames", "returns_labelled", "losses"}) {
    if (summary.contains(key)) facts[key] = summary[key];
  }
  std::error_code error;
  // Without this list, a later `--labels` into this folder cannot mistake the files for its own.
  fs::remove(folder.labels() / ".label.terracut", error);
  if (const Status sealed = seal(folder.labels(), facts); !sealed) {
    return failed(sealed.error(), record);
  }
  const auto broken = put_in_place(folder.labels(), place, job.broken() / record.output);
  if (!broken) return not_placed(broken.error(), record);
  if (!broken->empty()) {
    warn(fmt::format("{}: what stood there was not whole, and is kept as {}", place.string(),
                     broken->string()));
  }
  const Json whole = facts_of_whole(place);
  if (whole.is_null()) {
    return failed(kOutputFailed, kNoPlace, place.string() + " did not stay whole", record);
  }
  take_facts(whole, record);
  return kOk;
}

void take_facts(const Json& facts, RelabelRecord& record) {
  record.done = true;
  record.cause.clear();
  record.message.clear();
  record.frames = facts.value("frames", std::uint64_t{0});
  record.returns = facts.value("returns_labelled", std::uint64_t{0});
  record.label_bytes = facts.value("bytes", std::uint64_t{0});
  record.losses = facts.value("losses", Json::object());
}

ExitCode note_failure(const Error& error, RelabelRecord& record) {
  return failed(error, record);
}

}  // namespace terracut::cli
