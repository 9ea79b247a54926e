// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "rt/error.hpp"

namespace terracut::cli {

/// A running `terracut live`, as its status page tells (pipeline/page/status_page_list.hpp).
struct LiveProcess {
  std::string name;
  ::pid_t pid = 0;
  ::uid_t owner = 0;  ///< Of its page.
};

/// The process of this name, or the only one that runs when `name` is empty. kNotFound: none runs,
/// or not under this name; kInvalidArgument: several run, the message names them.
[[nodiscard]] Expected<LiveProcess> find_live_process(const std::filesystem::path& folder,
                                                      const std::string& name);

/// Sends it SIGUSR1, unless that could end it: the process must still hold its status page, must
/// be of the user that the page belongs to, and must have made itself ready for the signal
/// (live/dump_signal.hpp). kNotFound: it has ended; kUnsupported: it does not listen; kUnreadable:
/// not permitted.
[[nodiscard]] Status ask_for_dump(const std::filesystem::path& folder, const LiveProcess& process);

}  // namespace terracut::cli
