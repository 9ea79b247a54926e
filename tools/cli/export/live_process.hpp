// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/page/status_page_list.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Finds the running `terracut live` of this name, or the only one if `name` is empty. kNotFound:
/// none runs, or not under this name; kInvalidArgument: several run, the message names them.
[[nodiscard]] Expected<page::StatusPageEntry> find_live_process(const std::filesystem::path& folder,
                                                                const std::string& name);

/// Sends it SIGUSR1, unless that could end it: the process must hold its status page, belong to the
/// page's user, and be prepared for the signal (live/dump_signal.hpp). kNotFound: it has ended;
/// kUnsupported: it does not listen; kUnreadable: not permitted.
[[nodiscard]] Status ask_for_dump(const std::filesystem::path& folder,
                                  const page::StatusPageEntry& process);

}  // namespace terracut::cli
