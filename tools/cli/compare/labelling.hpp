// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "rt/error.hpp"

namespace terracut::cli {

/// The label files of several drives, made by one job or program.
struct Labelling {
  std::map<std::string, std::filesystem::path> drives;  ///< Where the label files of each are.
  std::filesystem::path state;  ///< State of their job (RelabelJob::state()), or empty.
};

/// Finds the labels in a folder. In a folder of `terracut relabel` these are the labels of its
/// newest job, in FOLDER/.relabel/ID those of that job. In any other folder, each subfolder with
/// .label files is a drive, named by its path below the folder. Fails with kNotFound if there are
/// no label files, kUnreadable if a folder cannot be listed, or as read_job() does.
[[nodiscard]] Expected<Labelling> find_labelling(const std::filesystem::path& folder);

}  // namespace terracut::cli
