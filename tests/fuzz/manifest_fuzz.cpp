// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Manifests and settings of a fleet that others wrote, from the file to the plan of every drive's
// run: refused by a message that names the file, or read with drives whose labels come to lie below
// the job's folder, each in one shard, and whose runs neither write, serve nor show anything, nor
// go on for good.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

#include "input.hpp"
#include "tools/cli/arguments/arguments.hpp"
#include "tools/cli/arguments/command_files.hpp"
#include "tools/cli/files/temporary_folder.hpp"
#include "tools/cli/fleet/relabel_job.hpp"

namespace {

namespace fs = std::filesystem;
using namespace terracut;
using cli::FleetDrive;
using cli::Manifest;
using terracut::fuzz::require;

fs::path write(const char* name, std::string_view text) {
  static const cli::TemporaryFolder folder;
  std::ofstream(folder.path() / name, std::ios::binary) << text;
  return folder.path() / name;
}

bool lies_below(const fs::path& path, const fs::path& folder) {
  const fs::path below = path.lexically_normal().lexically_relative(folder);
  return !below.empty() && *below.begin() != ".." && *below.begin() != ".";
}

void check_shards(const Manifest& manifest, std::size_t of) {
  std::set<std::string> names;
  for (std::size_t number = 1; number <= std::min<std::size_t>(of, 9); ++number) {
    for (const FleetDrive& drive : cli::drives_of(manifest, {number, of})) {
      require(names.insert(drive.name).second, "a drive is in two shards");
    }
  }
  require(of > 9 || names.size() == manifest.drives.size(), "a drive is in no shard");
}

void check_plan(const FleetDrive& drive, const fs::path& settings) {
  const auto words = cli::words_for(drive, settings);
  if (!words) return;
  for (const std::string& word : *words) {
    require(word.find('\0') == std::string::npos, "a word that the system would cut short");
  }
  const auto arguments = cli::parse_arguments(*words);
  if (!arguments) return;
  require(
      arguments->command == cli::Command::kReplay || arguments->command == cli::Command::kSegment,
      "another command");
  const cli::Options& options = arguments->options;
  const fs::path read = drive.capture.empty() ? options.scans : options.capture.file;
  require(read == drive.input(), "another input");
}

/// Nothing of what a drive's own arguments say is written, served or shown.
void check_arguments(const FleetDrive& drive, const fs::path& no_settings) {
  const auto words = cli::words_for(drive, no_settings);
  if (!words) return;
  const auto arguments = cli::parse_arguments(*words);
  if (!arguments) return;
  require(cli::files_of(*arguments).outputs.empty(), "something is written");
  const cli::OutputOptions& output = arguments->options.output;
  require(output.mcap.path.empty() && output.foxglove.empty() && output.view.empty() &&
              !output.dds.publishes && !output.overwrite,
          "something is served");
  const cli::PlayOptions& play = arguments->options.replay;
  require(play.loops == 1 && play.rate == 0, "a run without end");
}

bool are_same(const FleetDrive& a, const FleetDrive& b) {
  return a.name == b.name && a.capture == b.capture && a.scans == b.scans &&
         a.calibration == b.calibration && a.setup == b.setup && a.can == b.can && a.dbc == b.dbc &&
         a.arguments == b.arguments && a.bytes == b.bytes;
}

void check_manifest(const Manifest& manifest, const fs::path& settings, std::size_t shards) {
  const fs::path folder = "/labelled";
  const fs::path no_settings = write("none.yaml", "");
  for (const FleetDrive& drive : manifest.drives) {
    require(lies_below(folder / cli::output_name_of(drive, {}), folder), "labels lie elsewhere");
    check_plan(drive, settings);
    check_arguments(drive, no_settings);
  }
  check_shards(manifest, shards);
  const fs::path again = write("again.json", "");
  require(cli::write_manifest(again, manifest).has_value(), "it cannot be written");
  const auto read = cli::read_manifest(again);
  require(read.has_value() && std::ranges::equal(read->drives, manifest.drives, are_same),
          "what is written is not what is read");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  const auto shards = static_cast<std::size_t>(input.next(1)) + 1;
  // Up to a zero byte the manifest, then the settings.
  const std::string_view texts(reinterpret_cast<const char*>(data + (size > 0)), size - (size > 0));
  const std::size_t end = std::min(texts.find('\0'), texts.size());
  const fs::path path = write("fleet.json", texts.substr(0, end));
  const fs::path settings =
      write("settings.yaml", end == texts.size() ? "" : texts.substr(end + 1));
  (void)cli::parse_shard(texts.substr(0, 40));
  const auto manifest = cli::read_manifest(path);
  if (!manifest) {
    require(manifest.error().message.starts_with(path.string()), "the file is not named");
    return 0;
  }
  check_manifest(*manifest, settings, shards);
  return 0;
}
