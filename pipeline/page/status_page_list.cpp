// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/page/status_page_list.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>
#include <system_error>

#include "rt/files/trusted_file.hpp"

namespace terracut::page {
namespace {

/// Returns the process number in a page's header, without mapping the page; nothing if `file` is no
/// page.
std::optional<std::int32_t> publisher_of(int file) {
  std::byte header[sizeof(StatusPageHeader)];
  std::uint64_t magic = 0;
  if (::pread(file, header, sizeof header, 0) != static_cast<::ssize_t>(sizeof header)) return {};
  std::memcpy(&magic, header + offsetof(StatusPageHeader, magic), sizeof magic);
  if (magic != StatusPageHeader::kMagic) return {};
  std::int32_t pid = 0;
  std::memcpy(&pid, header + offsetof(StatusPageHeader, pid), sizeof pid);
  return pid;
}

}  // namespace

std::vector<StatusPageEntry> list_status_pages(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<StatusPageEntry> entries;
  std::error_code unreadable;
  for (fs::directory_iterator it(folder, unreadable), end; it != end; it.increment(unreadable)) {
    std::string name = it->path().filename().string();
    // A name that begins with a dot is a page being made.
    if (name.starts_with('.') || !name.ends_with(kStatusPageEnding)) continue;
    const files::OwnedDescriptor file(
        ::open(it->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!file) continue;
    struct stat status{};
    const bool trusted =
        ::fstat(file.get(), &status) == 0 && files::check_trusted(status, it->path());
    if (const auto pid = trusted ? publisher_of(file.get()) : std::nullopt) {
      name.resize(name.size() - kStatusPageEnding.size());
      entries.push_back({std::move(name), *pid, status.st_uid, has_publisher(file.get())});
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return entries;
}

}  // namespace terracut::page
