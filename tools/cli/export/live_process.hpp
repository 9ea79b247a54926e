// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/page/status_page_list.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Finds the running `terracut live` of this name, or the only one if `name` is empty. Fails with
/// kNotFound if no such process runs, kInvalidArgument (naming them) if several run.
[[nodiscard]] Expected<page::StatusPageEntry> find_live_process(const std::filesystem::path& folder,
                                                                const std::string& name);

/// Sends SIGUSR1 to a process, but only if the signal cannot end it: the process must hold its
/// status page, belong to the page's user, and be prepared for the signal (live/dump_signal.hpp).
/// Fails with kNotFound if it has ended, kUnsupported if it is not prepared, kUnreadable if not
/// permitted.
[[nodiscard]] Status ask_for_dump(const std::filesystem::path& folder,
                                  const page::StatusPageEntry& process);

}  // namespace terracut::cli
