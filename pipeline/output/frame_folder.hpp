// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::output {

/// A folder that a run fills with a file a frame, all of one ending. Its files are those of one
/// run: the first file of a run takes away what the run before it left, and nothing else, for a
/// list of them is kept in the folder (the ending and ".terracut"). Not thread-safe; blocks on the
/// disk.
class FrameFolder {
 public:
  /// `ending`: ".label". Nothing happens on the disk before the first file.
  FrameFolder(std::filesystem::path folder, std::string ending)
      : folder_(std::move(folder)), ending_(std::move(ending)) {}

  /// kInvalidArgument where files of that ending are in the folder that no run has listed: they are
  /// somebody's own, truth labels say.
  [[nodiscard]] Status check() const;

  /// The path for `name`, a file name that ends in the ending; it is listed from now on.
  /// kWriteFailed.
  [[nodiscard]] Expected<std::filesystem::path> place(const std::string& name);

 private:
  [[nodiscard]] std::filesystem::path list_path() const {
    return folder_ / (ending_ + ".terracut");
  }
  [[nodiscard]] Status begin();

  std::filesystem::path folder_;
  std::string ending_;
  files::OwnedDescriptor list_;  ///< None before the first file.
};

}  // namespace terracut::output
