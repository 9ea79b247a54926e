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

/// A folder that a run fills with a file a frame, all of one ending. Its files are those of one
/// run: the first file of a run takes away what a run before it made of the same input, and nothing
/// else, for a list of them, and of what they were made of, is kept in the folder (the ending and
/// ".terracut"). Not thread-safe; blocks on the disk.
class FrameFolder {
 public:
  struct Config {
    std::filesystem::path folder;
    std::string ending;            ///< ".label"
    std::string made_of{};         ///< The input, for people and to be compared; empty: unknown.
    bool replaces_others = false;  ///< What was made of another input, too.
    /// Told once how many older files were taken away, if any.
    std::function<void(std::size_t)> on_replaced{};
  };

  /// Nothing happens on the disk before the first file.
  explicit FrameFolder(Config config) : config_(std::move(config)) {}

  /// kInvalidArgument where files of that ending are in the folder that no run has listed, for they
  /// are somebody's own, truth labels say; or that a run made of another input. kUnreadable: what
  /// stands in the list's place is none.
  [[nodiscard]] Status check() const;

  /// The path for `name`, a file name that ends in the ending; it is listed from now on.
  /// kWriteFailed, also where another folder has come to its place since the first file, for in
  /// that one nothing was checked; before the first file the errors of check().
  [[nodiscard]] Expected<std::filesystem::path> place(const std::string& name);

 private:
  [[nodiscard]] std::filesystem::path list_path() const {
    return config_.folder / (config_.ending + ".terracut");
  }
  [[nodiscard]] Status begin();
  [[nodiscard]] Status check_still_there() const;
  [[nodiscard]] Status write_line(const std::string& text);

  Config config_;
  files::OwnedDescriptor list_;           ///< None before the first file.
  files::OwnedDescriptor opened_folder_;  ///< The folder itself, whatever its path leads to later.
};

}  // namespace terracut::output
