// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/recorder/dump_folder.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "rt/number_of.hpp"

namespace terracut::recorder {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCaptureEnding = ".pcap";
constexpr std::string_view kFrameTimesEnding = ".frames.json";
constexpr std::string_view kEndings[] = {kCaptureEnding, kFrameTimesEnding, ".calibration.xml",
                                         ".calibration.csv"};
constexpr std::string_view kStampShape = "00000000T000000.000Z";  // 0 stands for any digit
constexpr std::uint64_t kBlock = 4096;
constexpr std::uint64_t kMostSerial = 1'000'000'000'000;  // so that there is always a next one

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

/// Formats `2026-11-21 12:34:56.789` UTC as `20261121T123456.789Z`: sorts by time, has no ':'.
std::string stamp_text(std::int64_t now_ns) {
  const auto seconds = static_cast<std::time_t>(now_ns / 1'000'000'000);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  return fmt::format("{:04}{:02}{:02}T{:02}{:02}{:02}.{:03}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec, now_ns / 1'000'000 % 1000);
}

bool begins_with_stamp(std::string_view text) noexcept {
  if (text.size() < kStampShape.size()) return false;
  return std::equal(kStampShape.begin(), kStampShape.end(), text.begin(),
                    [](char shape, char c) { return shape == '0' ? is_digit(c) : shape == c; });
}

/// A file of one of the recorder's dumps, as its name tells.
struct OwnFile {
  std::uint64_t serial = 0;           ///< 0: from a version without serial numbers.
  std::string dump;                   ///< The name without ending, which all its files share.
  std::optional<::pid_t> written_by;  ///< Set for a temporary file: the process that wrote it.
};

std::optional<OwnFile> own_file(std::string_view file, std::string_view name) {
  OwnFile own;
  if (const auto part = file.rfind(".part-"); part != std::string_view::npos) {
    ::pid_t pid = 0;
    const char* end = file.data() + file.size();
    const auto read = std::from_chars(file.data() + part + 6, end, pid);
    if (read.ec != std::errc() || read.ptr == end || *read.ptr != '-' || pid <= 0) return {};
    const std::string_view serial(read.ptr + 1, end);
    if (serial.empty() || !std::all_of(serial.begin(), serial.end(), is_digit)) return {};
    own.written_by = pid;
    file = file.substr(0, part);
  }
  const auto* const ending =
      std::ranges::find_if(kEndings, [&](std::string_view each) { return file.ends_with(each); });
  if (ending == std::end(kEndings)) return {};
  file.remove_suffix(ending->size());
  own.dump = file;
  if (!file.starts_with(name) || !file.substr(name.size()).starts_with('-')) return {};
  file.remove_prefix(name.size() + 1);
  if (!begins_with_stamp(file)) {
    const auto serial = rt::number_of<std::uint64_t>(file.substr(0, file.find('-')));
    if (!serial || *serial == 0 || *serial > kMostSerial) return {};
    own.serial = *serial;
    file.remove_prefix(file.find('-') + 1);
    if (!begins_with_stamp(file)) return {};
  }
  file.remove_prefix(kStampShape.size());
  if (file != fmt::format("-{}", to_string(DumpReason::kMissedDeadline)) &&
      file != fmt::format("-{}", to_string(DumpReason::kAsked))) {
    return {};
  }
  return own;
}

/// True if the process that wrote a temporary file is gone. This process's own number counts as
/// gone, too: it writes no file while it makes room, and in a container a dead predecessor often
/// had the same number.
bool is_abandoned_by(::pid_t pid) noexcept {
  return pid == ::getpid() || (::kill(pid, 0) != 0 && errno == ESRCH);
}

/// The files of one of the recorder's dumps, and their size on the disk.
struct OldDump {
  std::vector<fs::path> files;
  std::uint64_t bytes = 0;

  void add(const fs::directory_entry& entry) {
    std::error_code vanished;
    const std::uint64_t size = entry.file_size(vanished);
    if (vanished) return;
    files.push_back(entry.path());
    bytes += (size + kBlock - 1) / kBlock * kBlock;
  }
};

struct Holdings {
  /// The key is serial number and name, so that the oldest dump is first.
  std::map<std::pair<std::uint64_t, std::string>, OldDump> dumps;
  OldDump leftovers;  ///< Temporary files of processes that are gone.

  [[nodiscard]] std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const auto& [name, dump] : dumps) sum += dump.bytes;
    return sum;
  }
  [[nodiscard]] std::uint64_t newest_serial() const {
    return dumps.empty() ? 0 : dumps.rbegin()->first.first;
  }
};

Holdings holdings_of(const fs::path& folder, std::string_view name, std::error_code& error) {
  Holdings holdings;
  auto entry = fs::directory_iterator(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code vanished;
    if (entry->symlink_status(vanished).type() != fs::file_type::regular) continue;
    const auto own = own_file(entry->path().filename().string(), name);
    if (!own) continue;
    if (!own->written_by) {
      holdings.dumps[{own->serial, own->dump}].add(*entry);
    } else if (is_abandoned_by(*own->written_by)) {
      holdings.leftovers.add(*entry);
    }
  }
  return holdings;
}

tl::unexpected<RefusedDump> refuse(DumpRefusal refusal, std::string message) {
  return tl::unexpected(RefusedDump{refusal, std::move(message)});
}
tl::unexpected<RefusedDump> unusable(const fs::path& folder, const std::error_code& error) {
  return refuse(DumpRefusal::kFolderUnusable,
                fmt::format("{}: {}; name a folder for dumps that this process may write to",
                            folder.string(), error.message()));
}

}  // namespace

bool is_dump_name(std::string_view name) noexcept {
  constexpr std::size_t kLongest = 64;
  return !name.empty() && name.size() <= kLongest &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
                  c == '-' || c == '.';
         });
}

std::filesystem::path frame_times_path(const std::filesystem::path& capture) {
  auto path = capture;
  return path.replace_extension(kFrameTimesEnding);
}

std::filesystem::path dump_calibration_path(const std::filesystem::path& capture,
                                            std::string_view suffix) {
  auto path = capture;
  return path.replace_extension(suffix);
}

DumpFolder::DumpFolder(DumpFolderLimits limits) : limits_(std::move(limits)) {
  if (!is_dump_name(limits_.name)) {
    throw std::invalid_argument(fmt::format(
        "dump name '{}': expected 1 to 64 letters, digits, '_', '-' or '.'", limits_.name));
  }
  if (limits_.folder.empty()) throw std::invalid_argument("no folder for dumps");
  if (limits_.most_dumps < 1 || limits_.most_bytes < 1) {
    throw std::invalid_argument("dumps kept and their bytes: expected at least 1");
  }
}

tl::expected<void, RefusedDump> DumpFolder::check() const {
  std::error_code error;
  fs::create_directories(limits_.folder, error);
  if (error) return unusable(limits_.folder, error);
  if (::access(limits_.folder.c_str(), R_OK | W_OK | X_OK) != 0) {
    return unusable(limits_.folder, {errno, std::generic_category()});
  }
  return {};
}

tl::expected<std::filesystem::path, RefusedDump> DumpFolder::make_room(std::uint64_t bytes,
                                                                       DumpReason reason,
                                                                       std::int64_t now_ns) {
  const fs::path& folder = limits_.folder;
  if (bytes > limits_.most_bytes) {
    return refuse(DumpRefusal::kOverQuota,
                  fmt::format("a dump of {} bytes is larger than all dumps together may be, {}",
                              bytes, limits_.most_bytes));
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return unusable(folder, error);
  const Holdings held = holdings_of(folder, limits_.name, error);
  if (error) return unusable(folder, error);
  struct statvfs space{};
  if (::statvfs(folder.c_str(), &space) != 0) {
    return unusable(folder, {errno, std::generic_category()});
  }

  std::vector<const OldDump*> to_delete;
  std::size_t kept = held.dumps.size();
  std::uint64_t kept_bytes = held.bytes();
  for (const auto& [name, dump] : held.dumps) {
    if (kept < limits_.most_dumps && kept_bytes + bytes <= limits_.most_bytes) break;
    to_delete.push_back(&dump);
    --kept;
    kept_bytes -= dump.bytes;
  }
  const std::uint64_t freed = held.bytes() - kept_bytes + held.leftovers.bytes;
  const std::uint64_t free = std::uint64_t{space.f_bavail} * space.f_frsize + freed;
  if (free < bytes || free - bytes < limits_.least_free_bytes) {
    return refuse(DumpRefusal::kDiskLow,
                  fmt::format("{}: {} bytes free; a dump of {} would leave less than the {} that "
                              "must stay free",
                              folder.string(), free, bytes, limits_.least_free_bytes));
  }

  for (const fs::path& file : held.leftovers.files) fs::remove(file, error);
  for (const OldDump* dump : to_delete) {
    for (const fs::path& file : dump->files) {
      if (fs::remove(file, error); error) return unusable(file, error);
    }
    ++deleted_;
  }
  // A serial number is never used again, even if its dump was deleted.
  newest_serial_ = std::max(newest_serial_, held.newest_serial());
  while (true) {
    fs::path capture = folder / fmt::format("{}-{:06}-{}-{}{}", limits_.name, ++newest_serial_,
                                            stamp_text(now_ns), to_string(reason), kCaptureEnding);
    if (!fs::exists(fs::symlink_status(capture, error))) return capture;
  }
}

}  // namespace terracut::recorder
