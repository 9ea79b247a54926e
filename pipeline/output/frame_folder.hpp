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

/// A folder to which a run writes one file per frame, all with the same ending. It holds the files
/// of one run: the first file of a run removes those of an earlier run on the same input, and no
/// others. A list file beside them, named by the ending and ".terracut", has their names and their
/// input. Not thread-safe; blocks on the disk.
class FrameFolder {
 public:
  struct Config {
    std::filesystem::path folder;
    std::string ending;            ///< Ending of the files, such as ".label".
    std::string made_of{};         ///< Name of the input, shown and compared; empty: unknown.
    bool replaces_others = false;  ///< True: also replaces files made from another input.
    /// Called once with the number of files that were removed, if there were any.
    std::function<void(std::size_t)> on_replaced{};
  };

  /// Does nothing on the disk before the first file.
  explicit FrameFolder(Config config) : config_(std::move(config)) {}

  /// Checks the folder. Fails with kInvalidArgument if it has files of that ending that no run has
  /// listed (they may be truth labels) or that a run made from another input; with kUnreadable if
  /// the list file cannot be understood.
  [[nodiscard]] Status check() const;

  /// Returns the path for `name`, which must have the ending, and adds the file to the list. Before
  /// the first file it fails with the errors of check(), later with kWriteFailed, also if another,
  /// unchecked folder has taken the folder's place.
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
