// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::output {

/// A folder to which a run writes one file a frame, all with one ending. Its files are those of one
/// run: a run's first file removes the files of an earlier run on the same input, and no others.
/// For this a list of the files and their input is kept in the folder (the ending and ".terracut").
/// Not thread-safe; blocks on the disk.
class FrameFolder {
 public:
  struct Config {
    std::filesystem::path folder;
    std::string ending;            ///< ".label"
    std::string made_of{};         ///< The input, to be shown and compared; empty: unknown.
    bool replaces_others = false;  ///< Also replaces files made of another input.
    /// Called once with the number of files removed, if any.
    std::function<void(std::size_t)> on_replaced{};
  };

  /// Does nothing on the disk before the first file.
  explicit FrameFolder(Config config) : config_(std::move(config)) {}

  /// Errors: kInvalidArgument if the folder has files of that ending that no run has listed, as
  /// they may be truth labels, say, or files that a run made of another input. kUnreadable: the
  /// list is not a list.
  [[nodiscard]] Status check() const;

  /// Returns the path for `name`, which must have the ending, and lists it. kWriteFailed, also if
  /// another, unchecked folder took its place since the first file; before the first file the
  /// errors of check().
  [[nodiscard]] Expected<std::filesystem::path> place(const std::string& name);

 private:
  [[nodiscard]] std::filesystem::path list_path() const {
    return config_.folder / (config_.ending + ".terracut");
  }
  [[nodiscard]] Status begin();
  [[nodiscard]] Status check_still_there() const;
  [[nodiscard]] Status write_line(const std::string& text);

  Config config_;
  files::OwnedDescriptor list_;           ///< Not open before the first file.
  files::OwnedDescriptor opened_folder_;  ///< The folder itself, even if its path changes later.
};

}  // namespace terracut::output
