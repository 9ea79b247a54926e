// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "rt/error.hpp"

namespace terracut::cli {

/// Label files of one origin.
struct Labelling {
  std::map<std::string, std::filesystem::path> drives;  ///< Where the label files of each are.
  std::filesystem::path state;  ///< Of the job that made them (RelabelJob::state()); may be empty.
};

/// Finds the labels in a folder. A folder of `terracut relabel` has those of its newest job;
/// FOLDER/.relabel/ID those of that job; in any other, each folder with .label files is a drive,
/// named by its path below. kNotFound if there are no label files; kUnreadable if a folder cannot
/// be listed; errors of read_job().
[[nodiscard]] Expected<Labelling> find_labelling(const std::filesystem::path& folder);

}  // namespace terracut::cli
