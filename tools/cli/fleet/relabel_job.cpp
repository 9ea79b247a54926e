// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "relabel_job.hpp"

#include <fmt/format.h>
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
#include "tools/cli/settings/configuration_text.hpp"
#include "tools/cli/settings/setting.hpp"
#include "tools/cli/settings/setting_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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
                 .mount_words = mount_words_of(options),
                 .format = options.fleet.format,
                 .host = host_name()};
  job.id = short_hash(*listed + *program + job.settings);
  std::error_code error;
  fs::create_directories(job.parts(), error);
  if (error) {
    return fail(ErrorCode::kWriteFailed,
                fmt::format("{}: {}", job.parts().string(), error.message()));
  }
  if (fs::exists(job.state() / "job.json", error)) return job;
  Status written = files::write_whole_file(job.state() / "terracut.yaml", job.settings);
  if (written) written = write_json(job.state() / "job.json", json_of(job, manifest));
  if (!written) return tl::unexpected(written.error());
  return job;
}

Expected<Json> recipe_of(const RelabelJob& job, const FleetDrive& drive) {
  if (const Status known = check_arguments(drive); !known) return tl::unexpected(known.error());
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
