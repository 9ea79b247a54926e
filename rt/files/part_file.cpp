// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/part_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

namespace terracut::files {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".part-";

bool is_number(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Returns the final file name of the part named `name`; empty if `name` is not that of a part.
std::string_view place_of(std::string_view name) {
  const std::size_t mark = name.rfind(kMark);
  if (mark == std::string_view::npos) return {};
  const std::string_view numbers = name.substr(mark + kMark.size());
  const std::size_t dash = numbers.find('-');
  if (dash == std::string_view::npos || !is_number(numbers.substr(0, dash)) ||
      !is_number(numbers.substr(dash + 1))) {
    return {};
  }
  return name.substr(0, mark);
}

/// Makes a part at the first free name: `make(path)` returns a descriptor, or -1 with errno.
template <class Make>
Part make_part(const fs::path& place, Make&& make) {
  static std::atomic<unsigned> serial{0};  // unique, as two threads may write to the same folder
  constexpr int kTries = 1000;
  Part part;
  for (int i = 0; i < kTries; ++i) {
    part.path = place;
    part.path += std::string(kMark) + std::to_string(::getpid()) + "-" + std::to_string(serial++);
    part.lock = OwnedDescriptor(make(part.path.c_str()));
    if (!part.lock && errno == EEXIST) continue;  // left by an earlier process of the same number
    if (!part.lock) return part;
    while (::flock(part.lock.get(), LOCK_EX) != 0 && errno == EINTR) {
    }
    // A clean-up may have removed this part as abandoned before it was locked.
    struct stat status{};
    if (::fstat(part.lock.get(), &status) == 0 && status.st_nlink > 0) return part;
  }
  part.lock.close();
  errno = EEXIST;
  return part;
}

bool is_abandoned(const fs::path& path) {
  const OwnedDescriptor part(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status{};
  if (!part || ::fstat(part.get(), &status) != 0 || status.st_uid != ::geteuid()) return false;
  if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return false;
  return ::flock(part.get(), LOCK_EX | LOCK_NB) == 0;
}

/// Lists the parts in `folder` whose final file name `is_wanted` accepts.
std::vector<fs::path> parts_in(const fs::path& folder,
                               const std::function<bool(std::string_view)>& is_wanted) {
  std::error_code error;
  std::vector<fs::path> parts;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const std::string_view place = place_of(name);
    if (!place.empty() && is_wanted(place)) parts.push_back(entry->path());
  }
  return parts;
}

}  // namespace

Part make_part_file(const fs::path& place) {
  return make_part(place, [](const char* path) {
    return ::open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  });
}

Part make_part_folder(const fs::path& place) {
  return make_part(place, [](const char* path) {
    if (::mkdir(path, 0700) != 0) return -1;
    const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    // A clean-up has removed this folder as abandoned: try another number.
    if (folder < 0 && errno == ENOENT) errno = EEXIST;
    return folder;
  });
}

bool has_part(const fs::path& place) {
  const std::string name = place.filename().string();
  return !parts_in(place.has_parent_path() ? place.parent_path() : ".", [&](std::string_view of) {
            return of == name;
          }).empty();
}

void remove_abandoned_parts(const fs::path& folder,
                            const std::function<bool(std::string_view)>& is_wanted) {
  std::error_code error;
  for (const fs::path& part : parts_in(folder, is_wanted)) {
    if (is_abandoned(part)) fs::remove_all(part, error);
  }
}

}  // namespace terracut::files
