// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace terracut::test {

/// Runs `check` in a process of its own, which may give up rights, lock its memory or die without
/// harm to the test. `check` returns what went wrong, "" if nothing did; so does this function,
/// which also reports a child that was killed. At most 64 KiB are passed on.
template <class Check>
[[nodiscard]] std::string in_child_process(const Check& check) {
  int pipe_ends[2];
  if (::pipe(pipe_ends) != 0) return "pipe failed";
  const ::pid_t child = ::fork();
  if (child < 0) return "fork failed";
  if (child == 0) {
    ::close(pipe_ends[0]);
    const std::string complaint = check();
    const bool sent = ::write(pipe_ends[1], complaint.data(), complaint.size()) ==
                      static_cast<::ssize_t>(complaint.size());
    ::_exit(sent ? 0 : 1);  // without the parent's exit handlers and buffered output
  }
  ::close(pipe_ends[1]);
  std::string complaint;
  char buffer[1024];
  for (::ssize_t got = 0; (got = ::read(pipe_ends[0], buffer, sizeof buffer)) > 0;) {
    complaint.append(buffer, static_cast<std::size_t>(got));
  }
  ::close(pipe_ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) complaint += " killed by signal " + std::to_string(WTERMSIG(status));
  if (WIFEXITED(status) && WEXITSTATUS(status) != 0) complaint += " could not report";
  return complaint;
}

/// In a child process: becomes the user nobody, who has no rights beyond the limits set before.
/// True when it did; an ordinary user has no such rights to begin with.
inline bool give_up_rights() {
  constexpr ::uid_t kNobody = 65534;
  return ::getuid() != 0 || (::setresgid(kNobody, kNobody, kNobody) == 0 &&
                             ::setresuid(kNobody, kNobody, kNobody) == 0);
}

}  // namespace terracut::test
