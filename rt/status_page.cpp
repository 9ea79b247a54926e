// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/status_page.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <system_error>

namespace terracut::rt {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "terracut.";
constexpr std::string_view kSuffix = ".status";
constexpr std::size_t kLongestName = 64;
constexpr int kAttempts = 8;  // to make a page while others make or remove one of the same name

bool is_name(std::string_view name) {
  constexpr std::string_view kAllowed =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  return !name.empty() && name.size() <= kLongestName &&
         name.find_first_not_of(kAllowed) == std::string_view::npos;
}

fs::path path_of(const fs::path& folder, std::string_view name) {
  return folder / (std::string(kPrefix) + std::string(name) + std::string(kSuffix));
}

std::string system_reason(int error) {
  return std::system_category().message(error);
}

struct flock whole_file(short type) {
  struct flock lock{};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

bool try_lock(int file) {
  struct flock lock = whole_file(F_WRLCK);
  return ::fcntl(file, F_OFD_SETLK, &lock) == 0;
}

/// Whether somebody else holds the writer's lock. Asks only, takes nothing.
bool is_locked(int file) {
  struct flock lock = whole_file(F_RDLCK);
  return ::fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

/// Whether `file` is what `path` names now.
bool is_at(int file, const fs::path& path) {
  struct stat opened{}, named{};
  return ::fstat(file, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::optional<StatusPageHeader> header_of(int file) {
  StatusPageHeader header{};
  if (::pread(file, &header, sizeof(header), 0) != static_cast<ssize_t>(sizeof(header)) ||
      header.magic != StatusPageHeader::kMagic) {
    return std::nullopt;
  }
  return header;
}

int open_to_read(const fs::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
}

/// Removes the page at `path` if nobody holds it. An error if somebody does.
Status remove_stale(const fs::path& path, std::string_view name) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0) {
    if (errno == ENOENT) return {};  // gone meanwhile
    return fail(ErrorCode::kWriteFailed,
                "cannot replace the status page " + path.string() + ": " + system_reason(errno));
  }
  Status removed;
  if (try_lock(file)) {
    if (is_at(file, path) && ::unlink(path.c_str()) != 0) {
      removed = fail(ErrorCode::kWriteFailed, "cannot remove the stale status page " +
                                                  path.string() + ": " + system_reason(errno));
    }
  } else {
    const auto header = header_of(file);
    removed = fail(ErrorCode::kInvalidArgument,
                   "the status page '" + std::string(name) + "' is in use by process " +
                       (header ? std::to_string(header->pid) : std::string("that just starts")) +
                       "; stop it, or give this one another name");
  }
  ::close(file);
  return removed;
}

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

fs::path status_folder() {
  const char* folder = std::getenv("TERRACUT_STATUS_DIR");
  return folder != nullptr && *folder != '\0' ? folder : "/dev/shm";
}

Expected<StatusPageFile> StatusPageFile::create(const fs::path& folder, std::string_view name,
                                                std::uint32_t layout, std::size_t value_bytes) {
  if (!is_name(name)) {
    return fail(ErrorCode::kInvalidArgument,
                "'" + std::string(name) +
                    "' is no name for a status page: expected 1 to 64 letters, digits, '-', '_'");
  }
  StatusPageFile page;
  page.path_ = path_of(folder, name);
  for (int attempt = 0; attempt < kAttempts && !page.own_; ++attempt) {
    page.file_ =
        ::open(page.path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (page.file_ >= 0) {
      // Between making and locking, another process may take the file for a stale one.
      page.own_ = try_lock(page.file_) && is_at(page.file_, page.path_);
      if (!page.own_) ::close(std::exchange(page.file_, -1));
    } else if (errno == EEXIST) {
      if (const Status removed = remove_stale(page.path_, name); !removed) {
        return tl::unexpected(removed.error());
      }
    } else {
      return fail(ErrorCode::kWriteFailed, "cannot make the status page " + page.path_.string() +
                                               ": " + system_reason(errno));
    }
  }
  if (!page.own_) {
    return fail(ErrorCode::kInvalidArgument,
                "other processes keep taking the status page '" + std::string(name) + "'");
  }
  ::fchmod(page.file_, 0644);  // readable for all, whatever the umask
  // Reserved now: a write into a full tmpfs would be a SIGBUS later.
  const auto bytes = static_cast<off_t>(kStatusValueOffset + value_bytes);
  if (const int error = ::posix_fallocate(page.file_, 0, bytes); error != 0) {
    return fail(ErrorCode::kWriteFailed,
                "cannot make the status page " + page.path_.string() + ": " + system_reason(error));
  }
  if (const Status mapped = page.map(value_bytes, true); !mapped) {
    return tl::unexpected(mapped.error());
  }
  StatusPageHeader& header = page.header();
  header.layout = layout;
  header.pid = static_cast<std::uint32_t>(::getpid());
  header.value_bytes = value_bytes;
  header.started_ns = now_ns();
  std::atomic_ref(header.magic).store(StatusPageHeader::kMagic, std::memory_order_release);
  return page;
}

Expected<StatusPageFile> StatusPageFile::open(const fs::path& folder, std::string_view name,
                                              std::uint32_t layout, std::size_t value_bytes) {
  StatusPageFile page;
  page.path_ = path_of(folder, name);
  const std::string what = "the status page " + page.path_.string();
  page.file_ = is_name(name) ? open_to_read(page.path_) : -1;
  if (page.file_ < 0) {
    if (!is_name(name) || errno == ENOENT) {
      return fail(ErrorCode::kNotFound,
                  "there is no status page '" + std::string(name) + "' in " + folder.string());
    }
    return fail(ErrorCode::kUnreadable, "cannot open " + what + ": " + system_reason(errno));
  }
  const auto header = header_of(page.file_);
  if (!header) return fail(ErrorCode::kMalformed, what + " is not a status page, or not yet one");
  if (header->layout != layout || header->value_bytes != value_bytes) {
    return fail(ErrorCode::kUnsupported,
                what + " is of another version of terracut: layout " +
                    std::to_string(header->layout) + " with " +
                    std::to_string(header->value_bytes) + " bytes, where this one reads layout " +
                    std::to_string(layout) + " with " + std::to_string(value_bytes));
  }
  struct stat facts{};
  if (::fstat(page.file_, &facts) != 0 ||
      static_cast<std::size_t>(facts.st_size) < kStatusValueOffset + value_bytes) {
    return fail(ErrorCode::kMalformed, what + " is shorter than it says");
  }
  if (const Status mapped = page.map(value_bytes, false); !mapped) {
    return tl::unexpected(mapped.error());
  }
  return page;
}

Status StatusPageFile::map(std::size_t value_bytes, bool writable) {
  const std::size_t bytes = kStatusValueOffset + value_bytes;
  void* memory = ::mmap(nullptr, bytes, writable ? PROT_READ | PROT_WRITE : PROT_READ,
                        MAP_SHARED | MAP_POPULATE, file_, 0);
  if (memory == MAP_FAILED) {
    return fail(ErrorCode::kUnreadable,
                "cannot map the status page " + path_.string() + ": " + system_reason(errno));
  }
  memory_ = memory;
  bytes_ = bytes;
  return {};
}

StatusPageFile::~StatusPageFile() {
  if (memory_ != nullptr) ::munmap(memory_, bytes_);
  if (file_ < 0) return;
  if (own_ && is_at(file_, path_)) ::unlink(path_.c_str());
  ::close(file_);  // gives the lock up
}

void StatusPageFile::swap(StatusPageFile& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  std::swap(own_, other.own_);
}

StatusPageHeader& StatusPageFile::header() const noexcept {
  return *static_cast<StatusPageHeader*>(memory_);
}

std::uint64_t* StatusPageFile::value() const noexcept {
  return reinterpret_cast<std::uint64_t*>(static_cast<std::byte*>(memory_) + kStatusValueOffset);
}

bool StatusPageFile::locked_by_writer() const noexcept {
  return is_locked(file_);
}

std::vector<StatusPageEntry> list_status_pages(const fs::path& folder) {
  std::vector<StatusPageEntry> entries;
  std::error_code unreadable;
  for (fs::directory_iterator it(folder, unreadable), end; it != end; it.increment(unreadable)) {
    const std::string file_name = it->path().filename().string();
    if (!file_name.starts_with(kPrefix) || !file_name.ends_with(kSuffix)) continue;
    if (file_name.size() <= kPrefix.size() + kSuffix.size()) continue;
    const int file = open_to_read(it->path());
    if (file < 0) continue;
    if (const auto header = header_of(file)) {
      entries.push_back(
          {file_name.substr(kPrefix.size(), file_name.size() - kPrefix.size() - kSuffix.size()),
           header->pid, is_locked(file)});
    }
    ::close(file);
  }
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return entries;
}

}  // namespace terracut::rt
