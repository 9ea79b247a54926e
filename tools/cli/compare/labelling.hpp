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
  std::filesystem::path state;  ///< Of the job that made them (RelabelJob::state()); empty: none.
};

/// What lies in a folder: of `terracut relabel`, what the job that began last there has done; of
/// FOLDER/.relabel/ID, what that one has; of any other, each folder with .label files is a drive,
/// by its place below. kNotFound where there are no label files; kUnreadable where a
/// folder cannot be listed; the errors of read_job().
[[nodiscard]] Expected<Labelling> find_labelling(const std::filesystem::path& folder);

}  // namespace terracut::cli
