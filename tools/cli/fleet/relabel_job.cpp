// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "relabel_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>
#include <variant>

#include "content_hash.hpp"
#include "drive_inputs.hpp"
#include "rt/files/whole_file.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/configuration_file.hpp"
#include "tools/cli/settings/configuration_text.hpp"
#include "tools/cli/settings/setting.hpp"
#include "tools/cli/settings/setting_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kJobFile = "job.json";
constexpr int kRecipeVersion = 1;

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  std::string text(name.data());
  std::ranges::replace_if(text, [](char c) { return c == '/' || c == '@'; }, '_');
  return text;
}

/// Returns the stated mount as arguments, like "--mount-height 1.9": a drive's setup file would
/// override a mount in the settings file, but does not override arguments.
std::vector<std::string> mount_words_of(const Options& options) {
  std::vector<std::string> words;
  for (const Setting& setting : settings()) {
    const bool is_figure = setting.key.starts_with("mount.") && setting.bare.empty();
    if (!is_figure || !setting.commands.contains(Command::kRelabel)) continue;
    const std::string value = value_text(setting, options);
    if (!value.empty()) words.insert(words.end(), {std::string(setting.name()), value});
  }
  return words;
}

Json json_of(const RelabelJob& job, const Manifest& manifest) {
  Json json{{"manifest", job.manifest.string()},
            {"terracut", TERRACUT_VERSION},
            {"program", job.program},
            {"began_ns", measure::realtime_ns()},
            {"drives", Json::array()}};
  for (const FleetDrive& drive : manifest.drives) {
    json["drives"].push_back(Json{{"name", drive.name}, {"bytes", drive.bytes}});
  }
  return json;
}

Command command_for(const FleetDrive& drive) {
  return drive.capture.empty() ? Command::kSegment : Command::kReplay;
}

/// True if the arguments of a drive in a manifest may contain the setting. It must be about how the
/// drive is read and labelled. Its value alone must decide, because a recipe does not hold the
/// content of files. It must not choose outputs, because others may have written the manifest.
bool is_of_drive(const Setting& setting) {
  constexpr std::array kSections{"sensor.", "input.", "mount.", "motion.", "method."};
  constexpr std::array kWithoutKey{"--set", "--method"};
  Options scratch;
  if (std::holds_alternative<fs::path*>(setting.field(scratch))) return false;
  return std::ranges::any_of(kSections, [&](auto of) { return setting.key.starts_with(of); }) ||
         std::ranges::find(kWithoutKey, setting.name()) != kWithoutKey.end();
}

tl::unexpected<Error> not_of_drive(const FleetDrive& drive, std::string_view found) {
  std::vector<std::string_view> allowed;
  for (const Setting& setting : settings()) {
    if (setting.name().starts_with("--") && setting.commands.contains(command_for(drive)) &&
        is_of_drive(setting)) {
      allowed.push_back(setting.name());
    }
  }
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: its arguments in the manifest have '{}'; expected options that say "
                          "how it is read and labelled, each with its value: {}",
                          drive.name, found, fmt::join(allowed, " ")));
}

/// Returns a drive's own arguments, each option and its value as one word, so that no value can be
/// mistaken for another option.
Expected<std::vector<std::string>> argument_words(const FleetDrive& drive) {
  std::vector<std::string> words;
  for (auto word = drive.arguments.begin(); word != drive.arguments.end(); ++word) {
    const bool has_value = word->find('=') != std::string::npos;
    const Setting* const setting =
        find_option(command_for(drive), word->substr(0, word->find('=')));
    if (!word->starts_with("--") || setting == nullptr || !is_of_drive(*setting)) {
      return not_of_drive(drive, *word);
    }
    Options scratch;
    words.push_back(*word);
    if (has_value || std::holds_alternative<bool*>(setting->field(scratch))) continue;
    if (word + 1 == drive.arguments.end()) return not_of_drive(drive, *word + " without a value");
    words.back() += "=" + *++word;
  }
  return words;
}

}  // namespace

std::string RelabelJob::part_prefix(const FleetDrive& drive) const {
  return short_hash(drive.name) + "@" + id + "@";
}

Expected<RelabelJob> begin_job(const Options& options, const Manifest& manifest) {
  const auto program = sha256_of_file("/proc/self/exe");
  if (!program) return tl::unexpected(program.error());
  const auto listed = sha256_of_file(options.fleet.manifest);
  if (!listed) return tl::unexpected(listed.error());
  RelabelJob job{.folder = options.written,
                 .manifest = fs::absolute(options.fleet.manifest),
                 .id = {},
                 .program = *program,
                 .settings = configuration_yaml(options),
                 .format = options.fleet.format,
                 .host = host_name()};
  job.id = short_hash(*listed + *program + job.settings);
  std::error_code error;
  fs::create_directories(job.parts(), error);
  if (error) {
    return fail(ErrorCode::kWriteFailed,
                fmt::format("{}: {}", job.parts().string(), error.message()));
  }
  if (read_job(job.state())) return job;  // an invalid file, perhaps written by others, is replaced
  Status written = files::write_whole_file(job.state() / kJobSettings, job.settings);
  if (written) written = write_json(job.state() / kJobFile, json_of(job, manifest));
  if (!written) return tl::unexpected(written.error());
  return job;
}

Expected<KnownJob> read_job(const fs::path& state) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // enough for a million drives and more
  const auto malformed = [&](std::string_view why) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: says nothing of a job: {}", (state / kJobFile).string(), why));
  };
  const auto json = read_json(state / kJobFile, kMostBytes);
  if (!json) return tl::unexpected(json.error());
  if (!are_counts(*json, {"began_ns"})) return malformed("began_ns is no whole number");
  try {
    KnownJob job{.state = state,
                 .manifest = json->at("manifest").get<std::string>(),
                 .version = json->at("terracut").get<std::string>(),
                 .began_ns = json->at("began_ns").get<std::int64_t>(),
                 .drives = {}};
    for (const Json& drive : json->at("drives")) {
      if (!are_counts(drive, {"bytes"})) return malformed("bytes of a drive are no whole number");
      job.drives.push_back(
          {drive.at("name").get<std::string>(), drive.at("bytes").get<std::uint64_t>()});
    }
    return job;
  } catch (const nlohmann::json::exception& error) {
    return malformed(error.what());
  }
}

Expected<std::vector<KnownJob>> jobs_in(const fs::path& folder) {
  std::vector<KnownJob> jobs;
  std::error_code error;
  fs::directory_iterator entry(folder / ".relabel", error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (auto job = read_job(entry->path())) jobs.push_back(*std::move(job));
  }
  if (jobs.empty()) {
    return fail(ErrorCode::kNotFound,
                folder.string() + ": `terracut relabel` has begun nothing here");
  }
  std::ranges::sort(jobs, {}, &KnownJob::began_ns);
  return jobs;
}

Expected<std::vector<std::string>> words_for(const FleetDrive& drive, const fs::path& settings) {
  const auto arguments = argument_words(drive);
  if (!arguments) return tl::unexpected(arguments.error());
  const auto options = read_configuration(settings);
  if (!options) return tl::unexpected(options.error());
  std::vector<std::string> words{"--config", settings.string(),
                                 std::string(name_of(command_for(drive))), drive.input().string()};
  const auto add = [&](const char* option, const fs::path& path) {
    if (!path.empty()) words.insert(words.end(), {option, path.string()});
  };
  add("--calibration", drive.calibration);
  add("--setup", drive.setup);
  add("--can", drive.can);
  add("--dbc", drive.dbc);
  const std::vector<std::string> mount = mount_words_of(*options);
  words.insert(words.end(), mount.begin(), mount.end());
  words.insert(words.end(), arguments->begin(), arguments->end());
  return words;
}

Expected<Json> recipe_of(const RelabelJob& job, const FleetDrive& drive) {
  Json recipe{{"recipe", kRecipeVersion},     {"terracut", TERRACUT_VERSION},
              {"program", job.program},       {"settings", sha256_of(job.settings)},
              {"arguments", drive.arguments}, {"inputs", Json::object()}};
  for (const DriveInput& input : inputs_of(drive)) {
    const auto content = content_of(input);
    if (!content) return tl::unexpected(content.error());
    recipe["inputs"][std::string(input.role)] = *content;
  }
  return recipe;
}

std::string output_name_of(const FleetDrive& drive, const Json& recipe) {
  return fmt::format("{}-{}", drive.name, short_hash(recipe.dump()));
}

}  // namespace terracut::cli
