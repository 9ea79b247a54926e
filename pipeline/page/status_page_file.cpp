// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/page/status_page_file.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include "rt/files/trusted_file.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::page {
namespace {

std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

bool is_sound(std::string_view name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), allowed);
}

tl::unexpected<Error> bad_name(const std::string& name) {
  return fail(ErrorCode::kInvalidArgument,
              "'" + name + "' cannot name a status page: use 1 to 64 of A-Z a-z 0-9 - _ .");
}

tl::unexpected<Error> not_written(const std::filesystem::path& path, const std::string& step,
                                  int error_number) {
  return fail(ErrorCode::kWriteFailed, "could not make the status page " + path.string() + ": " +
                                           step + ": " + reason(error_number));
}

std::filesystem::path path_of(const std::filesystem::path& folder, const std::string& name) {
  return folder / (name + std::string(kStatusPageEnding));
}

std::size_t file_bytes(std::size_t value_bytes) {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  return sizeof(StatusPageHeader) + (value_bytes + kWord - 1) / kWord * kWord;
}

/// Describes a lock that belongs to the open file, not to the process: two objects in one process
/// exclude each other as two processes do.
struct flock whole_file(short type) {
  struct flock lock{};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

/// Returns 0 or errno; EAGAIN if somebody else holds the lock.
int try_lock(int file) {
  struct flock lock = whole_file(F_WRLCK);
  if (::fcntl(file, F_OFD_SETLK, &lock) == 0) return 0;
  return errno == EACCES ? EAGAIN : errno;
}

bool is_file_at(int file, const std::filesystem::path& path) {
  struct stat of_file{};
  struct stat at_path{};
  return ::fstat(file, &of_file) == 0 && ::lstat(path.c_str(), &at_path) == 0 &&
         of_file.st_dev == at_path.st_dev && of_file.st_ino == at_path.st_ino;
}

std::int32_t pid_in(int file) {
  std::int32_t pid = 0;
  (void)::pread(file, &pid, sizeof pid, offsetof(StatusPageHeader, pid));
  return pid;
}

/// Renames the finished page to `path`, where there may be no file, or a dead process's page.
Status put_in_place(const std::filesystem::path& made, const std::filesystem::path& path) {
  for (int tries = 0; tries < 100; ++tries) {
    if (::link(made.c_str(), path.c_str()) == 0) {
      ::unlink(made.c_str());
      return {};
    }
    if (errno != EEXIST) return not_written(path, "naming it", errno);
    // Only the process that locks the existing file may replace it: its publisher holds the lock
    // while it lives, and two processes cannot hold it at once.
    const files::OwnedDescriptor old(
        ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!old && errno == ENOENT) continue;
    if (!old) {
      const int error_number = errno;
      struct stat there{};
      const bool known = ::lstat(path.c_str(), &there) == 0;
      return not_written(path,
                         known ? "there is one of user " + std::to_string(there.st_uid) + " already"
                               : std::string("opening the one that is there"),
                         error_number);
    }
    const int error_number = try_lock(old.get());
    if (error_number == EAGAIN) {
      return fail(ErrorCode::kInvalidArgument,
                  "the status page " + path.string() + " is in use by process " +
                      std::to_string(pid_in(old.get())) + "; choose another name");
    }
    if (error_number != 0) return not_written(path, "locking the one that is there", error_number);
    if (!is_file_at(old.get(), path)) continue;  // it was replaced meanwhile: look again
    if (::rename(made.c_str(), path.c_str()) == 0) return {};
    return not_written(path, "replacing the one that is there", errno);
  }
  return not_written(path, "others keep replacing it", EBUSY);
}

}  // namespace

std::filesystem::path status_page_folder() {
  const char* chosen = std::getenv("TERRACUT_STATUS_FOLDER");
  return chosen != nullptr && *chosen != '\0' ? chosen : "/dev/shm";
}

StatusPageFile::StatusPageFile(StatusPageFile&& other) noexcept {
  *this = std::move(other);
}

StatusPageFile& StatusPageFile::operator=(StatusPageFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  std::swap(publishes_, other.publishes_);
  std::swap(mapped_bytes_, other.mapped_bytes_);
  std::swap(header_, other.header_);
  std::swap(words_, other.words_);
  return *this;
}

StatusPageFile::~StatusPageFile() {
  if (publishes_ && is_file_at(file_.get(), path_)) ::unlink(path_.c_str());
  if (header_ != nullptr) ::munmap(header_, mapped_bytes_);
}

Expected<StatusPageFile> StatusPageFile::create(const std::filesystem::path& folder,
                                                const std::string& name, std::uint32_t layout,
                                                std::size_t value_bytes) {
  if (!is_sound(name)) return bad_name(name);
  const std::filesystem::path path = path_of(folder, name);
  struct statfs system{};
  if (::statfs(folder.c_str(), &system) != 0) return not_written(path, "its folder", errno);
  if (system.f_type != TMPFS_MAGIC && system.f_type != RAMFS_MAGIC) {
    return fail(ErrorCode::kUnsupported,
                "the folder " + folder.string() +
                    " of the status page is not in memory (tmpfs), so publishing could wait for a "
                    "disk; choose one that is, such as /dev/shm");
  }

  // The page is made under another name first, so that readers never find half a page.
  const std::filesystem::path made = folder / ("." + name + ".part-" + std::to_string(::getpid()) +
                                               "-" + std::to_string(measure::realtime_ns()));
  files::OwnedDescriptor file(
      ::open(made.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
  if (!file) return not_written(path, "creating it", errno);
  const auto remove = [](const std::filesystem::path* part) { ::unlink(part->c_str()); };
  const std::unique_ptr<const std::filesystem::path, decltype(remove)> tidy(&made, remove);

  const std::size_t bytes = file_bytes(value_bytes);
  // Reserves the space now: if the folder were full later, publishing would kill the process.
  if (const int error = ::posix_fallocate(file.get(), 0, static_cast<::off_t>(bytes))) {
    return not_written(path, "taking its memory", error);
  }
  if (const int error = try_lock(file.get())) return not_written(path, "locking it", error);
  void* base =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file.get(), 0);
  if (base == MAP_FAILED) return not_written(path, "mapping it", errno);

  StatusPageFile page;
  page.mapped_bytes_ = bytes;
  page.header_ = ::new (base) StatusPageHeader{};
  page.header_->layout = layout;
  page.header_->value_bytes = value_bytes;
  page.header_->started_ns = measure::realtime_ns();
  page.header_->pid = ::getpid();
  page.words_ = reinterpret_cast<std::atomic<std::uint64_t>*>(page.header_ + 1);  // zeros so far
  page.path_ = path;
  page.file_ = std::move(file);
  page.publishes_ = true;
  if (Status status = put_in_place(made, path); !status) return tl::unexpected(status.error());
  return page;
}

Expected<StatusPageFile> StatusPageFile::open(const std::filesystem::path& folder,
                                              const std::string& name, std::uint32_t layout,
                                              std::size_t value_bytes) {
  if (!is_sound(name)) return bad_name(name);
  const std::filesystem::path path = path_of(folder, name);
  const auto unreadable = [&](int error_number) {
    return fail(error_number == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
                "could not read the status page " + path.string() + ": " + reason(error_number) +
                    (error_number == ENOENT ? "; nobody publishes under this name" : ""));
  };
  // O_NONBLOCK keeps open() from waiting if the path is a named pipe.
  files::OwnedDescriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file) return unreadable(errno);
  struct stat status{};
  if (::fstat(file.get(), &status) != 0) return unreadable(errno);

  struct Fields {  // the members of StatusPageHeader before its atomic
    std::uint64_t magic;
    std::uint32_t header_bytes;
    std::uint32_t layout;
    std::uint64_t value_bytes;
  } found{};
  static_assert(offsetof(StatusPageHeader, value_bytes) == offsetof(Fields, value_bytes));
  const bool has_header = S_ISREG(status.st_mode) && ::pread(file.get(), &found, sizeof found, 0) ==
                                                         static_cast<::ssize_t>(sizeof found);
  if (!has_header || found.magic != StatusPageHeader::kMagic) {
    return fail(ErrorCode::kMalformed, path.string() + " is not a status page of terracut");
  }
  if (Status trusted = files::check_trusted(status, path); !trusted) {
    return tl::unexpected(std::move(trusted.error()));
  }
  if (found.header_bytes != sizeof(StatusPageHeader) || found.layout != layout ||
      found.value_bytes != value_bytes) {
    return fail(ErrorCode::kUnsupported,
                "the status page " + path.string() + " has layout " + std::to_string(found.layout) +
                    " of " + std::to_string(found.value_bytes) + " bytes, this program reads " +
                    std::to_string(layout) + " of " + std::to_string(value_bytes) +
                    ": use the same version of terracut on both sides");
  }
  const std::size_t bytes = file_bytes(value_bytes);
  if (static_cast<std::size_t>(status.st_size) < bytes) {
    return fail(ErrorCode::kMalformed, "the status page " + path.string() + " is cut off");
  }
  void* base = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED | MAP_POPULATE, file.get(), 0);
  if (base == MAP_FAILED) return unreadable(errno);

  StatusPageFile page;
  page.mapped_bytes_ = bytes;
  page.header_ = static_cast<StatusPageHeader*>(base);
  page.words_ = reinterpret_cast<std::atomic<std::uint64_t>*>(page.header_ + 1);
  page.path_ = path;
  page.file_ = std::move(file);
  return page;
}

bool has_publisher(int file) noexcept {
  struct flock lock = whole_file(F_RDLCK);
  return ::fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

}  // namespace terracut::page
