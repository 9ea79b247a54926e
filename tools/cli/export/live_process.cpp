// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_process.hpp"

#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <ios>
#include <limits>
#include <system_error>
#include <vector>

#include "rt/files/owned_descriptor.hpp"

namespace terracut::cli {
namespace {

using page::StatusPageEntry;

struct Pages {
  std::vector<StatusPageEntry> running;
  std::string left_over;  ///< Lists pages of processes that are gone, for people.
};

Pages pages_in(const std::filesystem::path& folder) {
  Pages pages;
  for (const StatusPageEntry& page : page::list_status_pages(folder)) {
    if (page.publisher_lives) {
      pages.running.push_back(page);
    } else {
      pages.left_over +=
          fmt::format("; the page '{}' was left by process {}, which is gone", page.name, page.pid);
    }
  }
  return pages;
}

bool still_runs(const std::filesystem::path& folder, const StatusPageEntry& process) {
  return std::ranges::any_of(pages_in(folder).running, [&](const StatusPageEntry& each) {
    return each.name == process.name && each.pid == process.pid;
  });
}

/// True if the process belongs to the user of its page and blocks or catches SIGUSR1, as the
/// hexadecimal masks in /proc/PID/status tell. False if these cannot be read: without certainty no
/// signal is sent.
bool listens_for_dumps(const StatusPageEntry& process) {
  constexpr std::uint64_t kSignal = std::uint64_t{1} << (SIGUSR1 - 1);
  std::ifstream status(fmt::format("/proc/{}/status", process.pid));
  bool is_owners = false;
  for (std::string key; status >> key;) {
    if (key == "Uid:") {  // real, effective and others
      ::uid_t real = 0, effective = 0;
      is_owners = status >> real >> effective && effective == process.owner;
    }
    if (key == "SigBlk:" || key == "SigCgt:") {
      std::uint64_t mask = 0;
      if (status >> std::hex >> mask && (mask & kSignal) != 0) return is_owners;
    }
    status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return false;
}

Error system_refusal(const StatusPageEntry& process, int error_number) {
  if (error_number == ESRCH) {
    return {ErrorCode::kNotFound, fmt::format("'{}' has just ended", process.name)};
  }
  return {ErrorCode::kUnreadable,
          fmt::format("'{}' (process {}) could not be signalled: {}; run this as the user that "
                      "runs it, or as root",
                      process.name, process.pid, std::generic_category().message(error_number))};
}

}  // namespace

Expected<StatusPageEntry> find_live_process(const std::filesystem::path& folder,
                                            const std::string& name) {
  const auto [processes, left_over] = pages_in(folder);
  std::string names;
  for (const StatusPageEntry& process : processes) {
    if (!name.empty() && process.name == name) return process;
    names += (names.empty() ? "" : ", ") + process.name;
  }
  if (name.empty() && processes.size() == 1) return processes.front();
  if (processes.empty()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("no `terracut live` is running (status pages are looked for in {}){}",
                            folder.string(), left_over));
  }
  if (name.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("several are running, name one of them: {}", names));
  }
  return fail(
      ErrorCode::kNotFound,
      fmt::format("no `terracut live` is running under the name '{}'; running: {}", name, names));
}

Status ask_for_dump(const std::filesystem::path& folder, const StatusPageEntry& process) {
  // The descriptor identifies this very process: after the check the signal cannot reach a later
  // process of the same number.
  const files::OwnedDescriptor held(static_cast<int>(::syscall(SYS_pidfd_open, process.pid, 0)));
  if (!held) return tl::unexpected(system_refusal(process, errno));
  if (!still_runs(folder, process)) return tl::unexpected(system_refusal(process, ESRCH));
  if (!listens_for_dumps(process)) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("'{}' (process {}) does not listen for dumps: it is starting, or was "
                            "told to keep no packets",
                            process.name, process.pid));
  }
  if (::syscall(SYS_pidfd_send_signal, held.get(), SIGUSR1, nullptr, 0) != 0) {
    return tl::unexpected(system_refusal(process, errno));
  }
  return {};
}

}  // namespace terracut::cli
