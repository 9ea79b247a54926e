// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "relabel_job.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
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
constexpr std::size_t kShownDigits = 16;  // 64 bits of a hash

std::string short_hash(std::string_view text) {
  return sha256_of(text).substr(0, kShownDigits);
}

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  std::string text(name.data());
  std::ranges::replace_if(
      text, [](char c) { return c == '/' || c == '@'; }, '_');
  return text;
}

/// What a drive's setup leaves aside where it is in a file: "--mount-height 1.9".
std::vector<std::string> mount_words_of(const Options& options) {
  std::vector<std::string> words;
  for (const Setting& setting : settings()) {
    if (!setting.commands.contains(Command::kRelabel) || !setting.key.starts_with("mount.")) {
      continue;
    }
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

Status check_arguments(const FleetDrive& drive) {
  const Command command = drive.capture.empty() ? Command::kSegment : Command::kReplay;
  for (const std::string& word : drive.arguments) {
    if (!word.starts_with("--")) continue;
    const std::string_view name = std::string_view(word).substr(0, word.find('='));
    const Setting* const setting = find_option(command, name);
    Options scratch;
    if (setting != nullptr && !std::holds_alternative<fs::path*>(setting->field(scratch))) continue;
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: its argument {} in the manifest is no option of {} that does "
                            "without a file",
                            drive.name, name, name_of(command)));
  }
  return {};
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
  if (fs::exists(job.state() / kJobFile, error)) return job;
  Status written = files::write_whole_file(job.state() / kJobSettings, job.settings);
  if (written) written = write_json(job.state() / kJobFile, json_of(job, manifest));
  if (!written) return tl::unexpected(written.error());
  return job;
}

Expected<KnownJob> read_job(const fs::path& state) {
  std::ifstream file(state / kJobFile, std::ios::binary);
  Json json = Json::parse(file, nullptr, false);
  if (json.is_object() && json.contains("drives")) return KnownJob{state, std::move(json)};
  return fail(ErrorCode::kMalformed, (state / kJobFile).string() + ": says nothing of a job");
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
  std::ranges::sort(
      jobs, {}, [](const KnownJob& job) { return job.json.value("began_ns", std::int64_t{0}); });
  return jobs;
}

Expected<std::vector<std::string>> words_for(const FleetDrive& drive, const fs::path& settings) {
  if (const Status known = check_arguments(drive); !known) return tl::unexpected(known.error());
  const auto options = read_configuration(settings);
  if (!options) return tl::unexpected(options.error());
  std::vector<std::string> words{"--config", settings.string(),
                                 drive.capture.empty() ? "segment" : "replay",
                                 drive.input().string()};
  const auto add = [&](const char* option, const fs::path& path) {
    if (!path.empty()) words.insert(words.end(), {option, path.string()});
  };
  add("--calibration", drive.calibration);
  add("--setup", drive.setup);
  add("--can", drive.can);
  add("--dbc", drive.dbc);
  const std::vector<std::string> mount = mount_words_of(*options);
  words.insert(words.end(), mount.begin(), mount.end());
  words.insert(words.end(), drive.arguments.begin(), drive.arguments.end());
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
