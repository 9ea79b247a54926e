// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "cli_fixture.hpp"
#include "tests/support/places.hpp"

namespace terracut::cli {

/// A terracut, or another program, that runs beside the test, which waits for what it says instead
/// of for a time. Killed with this object if it has not ended by then.
class BackgroundProgram {
 public:
  /// `PROGRAM ARGUMENTS` with `folder` as working directory. `name`: of the file its output goes
  /// to.
  BackgroundProgram(fs::path folder, const std::string& name, const std::string& arguments,
                    const fs::path& program = test::program())
      : out_(folder / (name + ".stdout.txt")) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    const std::string command = "cd " + quoted(folder) + " && exec " + quoted(program) + " " +
                                arguments + " >" + quoted(out_);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], STDERR_FILENO);
      ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    listener_ = std::jthread([this, from = ends[0]] { listen(from); });
  }
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;
  ~BackgroundProgram() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }

  /// Waits until it says `text` on its standard error; false when it ends without.
  [[nodiscard]] bool says(const std::string& text) {
    std::unique_lock lock(mutex_);
    news_.wait(lock, [&] { return silent_ || said_.find(text) != std::string::npos; });
    return said_.find(text) != std::string::npos;
  }
  /// What stands behind `text` in the line that it says it in. Throws when it ends without.
  [[nodiscard]] std::string said_after(const std::string& text) {
    if (!says(text)) throw std::runtime_error("never said: " + text + "; but: " + said_);
    std::unique_lock lock(mutex_);
    const std::size_t begin = said_.find(text) + text.size();
    news_.wait(lock, [&] { return silent_ || said_.find('\n', begin) != std::string::npos; });
    return said_.substr(begin, said_.find('\n', begin) - begin);
  }

  void interrupt(int signal = SIGINT) const { ::kill(pid_, signal); }
  /// Whether it has ended by itself; end() tells how.
  [[nodiscard]] bool has_ended() {
    const std::scoped_lock lock(mutex_);
    return silent_;
  }
  /// Waits for its end.
  [[nodiscard]] Outcome end() {
    int status = 0;
    ::waitpid(std::exchange(pid_, -1), &status, 0);
    listener_.join();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(out_), said_};
  }

 private:
  void listen(int from) {
    std::array<char, 4096> part{};
    for (::ssize_t got = 0; (got = ::read(from, part.data(), part.size())) > 0;) {
      const std::scoped_lock lock(mutex_);
      said_.append(part.data(), static_cast<std::size_t>(got));
      news_.notify_all();
    }
    ::close(from);
    const std::scoped_lock lock(mutex_);
    silent_ = true;
    news_.notify_all();
  }

  fs::path out_;
  ::pid_t pid_ = -1;
  std::mutex mutex_;
  std::condition_variable news_;
  std::string said_;
  bool silent_ = false;  ///< It has closed its standard error: it has ended, or is about to.
  std::jthread listener_;
};

}  // namespace terracut::cli
