// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "labelled_drive.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "content_hash.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/files/plain_file.hpp"
#include "rt/files/whole_file.hpp"
#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Returns the number and total size of a folder's files, except those that seal() writes.
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

/// Returns a line as sha256sum writes it: a line break in the name is escaped, and a backslash at
/// the line's beginning shows this.
std::string sum_line(const std::string& sum, const std::string& name) {
  if (name.find('\n') == std::string::npos) return fmt::format("{}  {}\n", sum, name);
  std::string escaped;
  for (const char c : name) escaped += c == '\n' ? "\\n" : c == '\\' ? "\\\\" : std::string(1, c);
  return fmt::format("\\{}  {}\n", sum, escaped);
}

/// Returns the name that sum_line() has escaped.
std::string unescaped(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_escape = text[i] == '\\' && i + 1 < text.size();
    if (is_escape) ++i;
    name += is_escape && text[i] == 'n' ? '\n' : text[i];
  }
  return name;
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
    sums += sum_line(*sum, name);
  }
  return sums;
}

/// True for errors that would also affect every other file on the disk.
bool is_of_the_disk(int error_number) {
  return error_number == ENOSPC || error_number == EDQUOT || error_number == EROFS ||
         error_number == EIO;
}

tl::unexpected<Error> write_failed(const fs::path& path, int error_number) {
  return fail(is_of_the_disk(error_number) ? ErrorCode::kWriteFailed : ErrorCode::kInvalidArgument,
              fmt::format("{}: {}", path.string(), std::generic_category().message(error_number)));
}

/// True if all present members have the right types.
bool are_facts(const Json& facts) {
  if (!are_counts(facts, {"frames", "complete_frames", "returns_labelled", "files", "bytes"})) {
    return false;
  }
  const Json losses = facts.value("losses", Json::object());
  return losses.is_object() &&
         std::ranges::all_of(losses, [](const Json& count) { return count.is_number_unsigned(); });
}

bool rename_folder(const fs::path& from, const fs::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0;
}

}  // namespace

std::map<std::string, std::string> listed_sums(const fs::path& folder) {
  constexpr std::size_t kSumDigits = 64, kGap = 2, kMostBytes = std::size_t{1} << 28;
  std::map<std::string, std::string> sums;
  const auto text = files::read_plain_file(folder / kDriveSums, kMostBytes);
  if (!text || !text->ends_with('\n')) return sums;
  for (std::size_t begin = 0; begin < text->size();) {
    const std::size_t end = text->find('\n', begin);
    std::string line = text->substr(begin, end - begin);
    begin = end + 1;
    const bool is_escaped = line.starts_with('\\');
    if (is_escaped) line.erase(0, 1);
    if (line.size() <= kSumDigits + kGap || line.find('/') != std::string::npos) return {};
    std::string name = line.substr(kSumDigits + kGap);
    sums.emplace(is_escaped ? unescaped(name) : std::move(name), line.substr(0, kSumDigits));
  }
  return sums;
}

Json facts_of_whole(const fs::path& folder) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 20;
  const auto facts = read_json(folder / kDriveFacts, kMostBytes);
  if (!facts || !are_facts(*facts)) return nullptr;
  std::uint64_t files = 0, bytes = 0;
  for (const auto& [name, sum] : listed_sums(folder)) {
    struct stat file{};
    if (::stat((folder / name).c_str(), &file) != 0 || !S_ISREG(file.st_mode)) return nullptr;
    if (name == kDriveFacts) continue;
    ++files;
    bytes += static_cast<std::uint64_t>(file.st_size);
  }
  const bool is_whole =
      facts->value("files", Json()) == files && facts->value("bytes", Json()) == bytes;
  return is_whole ? *facts : Json(nullptr);
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
  // Makes one call for all files, before the rename: otherwise the rename may reach the disk before
  // the data.
  const files::OwnedDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened || ::syncfs(opened.get()) != 0) return write_failed(folder, errno);
  return {};
}

Status check_place(const fs::path& place) {
  std::error_code error;
  fs::create_directories(place.parent_path(), error);
  if (error) return write_failed(place.parent_path(), error.value());
  struct stat standing{};
  if (::lstat(place.c_str(), &standing) != 0) {
    if (errno != ENOENT) return write_failed(place, errno);
    if (::access(place.parent_path().c_str(), W_OK | X_OK) == 0) return {};
    return write_failed(place.parent_path(), errno);
  }
  if (S_ISDIR(standing.st_mode) || !facts_of_whole(place).is_null()) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: a {} has the name of the drive's labels; take it away",
                          place.string(), S_ISLNK(standing.st_mode) ? "link" : "file"));
}

Expected<fs::path> put_in_place(const fs::path& folder, const fs::path& place,
                                const fs::path& broken) {
  fs::path kept;
  constexpr int kTries = 1000;  // other processes may rename to the same places
  for (int i = 1; i <= kTries; ++i) {
    if (Status free = check_place(place); !free) return tl::unexpected(free.error());
    if (rename_folder(folder, place)) return kept;
    const int why = errno;
    if (!facts_of_whole(place).is_null()) return kept;
    if (why != ENOTEMPTY && why != EEXIST) return write_failed(place, why);
    std::error_code error;
    fs::create_directories(broken.parent_path(), error);
    const fs::path aside = fmt::format("{}.{}", broken.string(), i);
    if (!fs::exists(aside, error) && rename_folder(place, aside)) kept = aside;
  }
  return write_failed(place, EEXIST);
}

}  // namespace terracut::cli
