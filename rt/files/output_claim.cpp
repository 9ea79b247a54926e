// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/files/output_claim.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

namespace terracut::files {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> not_writable(const fs::path& path, const std::string& reason) {
  return fail(ErrorCode::kWriteFailed, "cannot write " + path.string() + ": " + reason +
                                           ". Check the folder, its rights and the free space");
}
tl::unexpected<Error> not_writable(const fs::path& path, int error_number) {
  return not_writable(path, std::generic_category().message(error_number));
}

bool is_at(const OwnedDescriptor& file, const fs::path& path) {
  struct stat of_file{};
  struct stat at_path{};
  return ::fstat(file.get(), &of_file) == 0 && ::lstat(path.c_str(), &at_path) == 0 &&
         of_file.st_dev == at_path.st_dev && of_file.st_ino == at_path.st_ino;
}

Status lock(const OwnedDescriptor& file, int operation, const fs::path& path) {
  if (::flock(file.get(), operation | LOCK_NB) == 0 || errno != EWOULDBLOCK) return {};
  return fail(ErrorCode::kInvalidArgument,
              path.string() + ": another run is writing it; wait for its end or name another");
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

OutputClaim::~OutputClaim() {
  if (!lock_file_.empty() && lock_ && is_at(lock_, lock_file_)) ::unlink(lock_file_.c_str());
  std::for_each(made_.rbegin(), made_.rend(),
                [](const fs::path& folder) { ::rmdir(folder.c_str()); });
}

Status OutputClaim::make_folders(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, error); at = at.parent_path()) {
    if (at.has_filename()) missing.push_back(at);
  }
  std::reverse(missing.begin(), missing.end());
  for (const fs::path& at : missing) {
    if (::mkdir(at.c_str(), 0777) == 0) {
      made_.push_back(at);
    } else if (errno != EEXIST) {
      return not_writable(at, errno);
    }
  }
  if (fs::is_directory(folder, error)) return {};
  return not_writable(folder, "it is a file, a folder is needed");
}

Expected<OutputClaim> OutputClaim::of_file(const fs::path& path) {
  OutputClaim claim;
  const fs::path folder = folder_of(path);
  if (Status made = claim.make_folders(folder); !made) return tl::unexpected(made.error());
  const fs::path lock_file = folder / ("." + path.filename().string() + ".terracut-lock");
  do {
    claim.lock_ = OwnedDescriptor(
        ::open(lock_file.c_str(), O_RDONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644));
    if (!claim.lock_) return not_writable(path, errno);
    if (Status locked = lock(claim.lock_, LOCK_EX, path); !locked)
      return tl::unexpected(locked.error());
    // Try again if the last holder removed the lock file after it was opened here.
  } while (!is_at(claim.lock_, lock_file));
  claim.lock_file_ = lock_file;
  return claim;
}

Expected<OutputClaim> OutputClaim::of_folder(const fs::path& path, Use use) {
  OutputClaim claim;
  if (Status made = claim.make_folders(path); !made) return tl::unexpected(made.error());
  claim.lock_ = OwnedDescriptor(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!claim.lock_) return not_writable(path, errno);
  if (::access(path.c_str(), W_OK) != 0) return not_writable(path, errno);
  const int operation = use == Use::kAlone ? LOCK_EX : LOCK_SH;
  if (Status locked = lock(claim.lock_, operation, path); !locked) {
    return tl::unexpected(locked.error());
  }
  return claim;
}

}  // namespace terracut::files
