// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Disks that are full, without filling one: seen by a child process alone.
#pragma once

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

namespace terracut::test {

/// How a child process ended that has no test framework.
enum class InChild : int { kAsExpected = 0, kOtherwise = 1, kNotPossible = 77 };

/// Runs `body`, which returns an InChild, in a child process.
template <class Body>
[[nodiscard]] InChild in_child(Body&& body) {
  const ::pid_t child = ::fork();
  if (child == 0) ::_exit(static_cast<int>(body()));
  int status = 0;
  if (::waitpid(child, &status, 0) != child || !WIFEXITED(status)) return InChild::kOtherwise;
  return static_cast<InChild>(WEXITSTATUS(status));
}

/// `body` with an empty file system of `kibibytes` at `folder`.
template <class Body>
[[nodiscard]] InChild on_a_disk_of(int kibibytes, const std::filesystem::path& folder,
                                   Body&& body) {
  return in_child([&] {
    const int own_mounts = ::geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWUSER | CLONE_NEWNS;
    const std::string size = "size=" + std::to_string(kibibytes) + "k";
    if (::unshare(own_mounts) != 0 ||
        ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", folder.c_str(), "tmpfs", 0, size.c_str()) != 0) {
      return InChild::kNotPossible;
    }
    return body();
  });
}

/// `body` where no file may grow beyond `bytes`.
template <class Body>
[[nodiscard]] InChild where_files_end_at(::rlim_t bytes, Body&& body) {
  return in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);  // write() then returns EFBIG
    const ::rlimit limit{bytes, bytes};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return InChild::kNotPossible;
    return body();
  });
}

}  // namespace terracut::test
