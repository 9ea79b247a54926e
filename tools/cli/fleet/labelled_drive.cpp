// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "labelled_drive.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "content_hash.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/files/whole_file.hpp"
#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Files of a folder but for what seal() writes: how many, how long together.
std::pair<std::uint64_t, std::uint64_t> extent_of(const fs::path& folder) {
  std::pair<std::uint64_t, std::uint64_t> extent{0, 0};
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name == kDriveFacts || name == kDriveSums) continue;
    std::error_code vanished;
    ++extent.first;
    extent.second += entry->file_size(vanished);
  }
  return extent;
}

Expected<std::string> sums_of(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  std::ranges::sort(names);
  std::string sums;
  for (const std::string& name : names) {
    const auto sum = sha256_of_file(folder / name);
    if (!sum) return sum;
    sums += fmt::format("{}  {}\n", *sum, name);
  }
  return sums;
}

std::size_t lines_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>(), '\n'));
}

Status write_failed(const fs::path& path, int error_number) {
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{}: {}", path.string(), std::generic_category().message(error_number)));
}

bool rename_folder(const fs::path& from, const fs::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0;
}

}  // namespace

Json facts_of_whole(const fs::path& folder) {
  std::ifstream file(folder / kDriveFacts, std::ios::binary);
  Json facts = Json::parse(file, nullptr, false);
  if (!facts.is_object() || !facts.contains("files") || !facts.contains("bytes")) return nullptr;
  const auto [files, bytes] = extent_of(folder);
  const bool whole = facts["files"] == files && facts["bytes"] == bytes &&
                     lines_of(folder / kDriveSums) == files + 1;
  return whole ? facts : Json(nullptr);
}

Status seal(const fs::path& folder, Json facts) {
  const auto [files, bytes] = extent_of(folder);
  facts["files"] = files;
  facts["bytes"] = bytes;
  if (Status written = write_json(folder / kDriveFacts, facts); !written) return written;
  const auto sums = sums_of(folder);
  if (!sums) return tl::unexpected(sums.error());
  if (Status written = files::write_whole_file(folder / kDriveSums, *sums); !written) {
    return written;
  }
  // One call for all of its files: a rename may reach the disk before what it renames.
  const files::OwnedDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened || ::syncfs(opened.get()) != 0) return write_failed(folder, errno);
  return {};
}

Status put_in_place(const fs::path& folder, const fs::path& place) {
  std::error_code error;
  fs::create_directories(place.parent_path(), error);
  if (error) return write_failed(place.parent_path(), error.value());
  constexpr int kTries = 100;  // others may put theirs in place at the same time
  for (int i = 0; i < kTries; ++i) {
    if (rename_folder(folder, place)) return {};
    if (errno != ENOTEMPTY && errno != EEXIST) return write_failed(place, errno);
    if (!facts_of_whole(place).is_null()) return {};
    (void)rename_folder(place, folder.parent_path() / fmt::format("broken{}", i));
  }
  return write_failed(place, EEXIST);
}

}  // namespace terracut::cli
