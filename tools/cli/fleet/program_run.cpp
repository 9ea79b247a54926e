// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "program_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "rt/files/owned_descriptor.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

std::atomic<::pid_t> running = 0;
static_assert(std::atomic<::pid_t>::is_always_lock_free, "a signal handler reads it");

double seconds_of(const ::timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Becomes the program. Runs between fork and exec, so it must not allocate memory or take locks.
[[noreturn]] void become(const std::vector<char*>& words, int log, ::pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // the parent has died already
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::execv("/proc/self/exe", words.data());
  ::_exit(127);
}

}  // namespace

Expected<ProgramRun> run_program(const std::vector<std::string>& words,
                                 const std::filesystem::path& log) {
  const auto failed = [](const char* what, int error_number) {
    return fail(ErrorCode::kWriteFailed,
                fmt::format("{}: {}", what, std::generic_category().message(error_number)));
  };
  const files::OwnedDescriptor file(
      ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!file) return failed(log.c_str(), errno);
  std::string name = "terracut";
  std::vector<std::string> copies = words;
  std::vector<char*> pointers{name.data()};
  for (std::string& word : copies) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const std::int64_t started_ns = measure::monotonic_ns();
  const ::pid_t parent = ::getpid();
  const ::pid_t child = ::fork();
  if (child < 0) return failed("no process for a drive", errno);
  if (child == 0) become(pointers, file.get(), parent);
  running = child;
  if (stop_wanted()) stop_program();  // a stop signal before the fork found no child
  int status = 0;
  struct rusage used{};
  while (::wait4(child, &status, 0, &used) < 0 && errno == EINTR) {
  }
  running = 0;
  ProgramRun run;
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
  run.seconds = static_cast<double>(measure::monotonic_ns() - started_ns) * 1e-9;
  run.cpu_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  run.peak_memory_bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
  return run;
}

void stop_program() noexcept {
  if (const ::pid_t child = running; child > 0) ::kill(child, SIGTERM);
}

}  // namespace terracut::cli
