// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "frame_result.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::eval {

/// Keeps results on disk as they come, one line of JSON each, so that a killed run can be
/// continued: at most the frames being labelled are lost. The first line states the run's settings;
/// a journal with other settings is refused.
class Journal {
 public:
  /// Reads the existing lines, cuts off an incomplete one, and appends after them. `settings` is
  /// everything that results depend on, as words in one line of text. Fails with kInvalidArgument
  /// if the file has other settings (the message names the words that differ) or another process is
  /// writing it; kMalformed if a whole line is no result; kWriteFailed if the file cannot be
  /// written.
  [[nodiscard]] static Expected<Journal> open(const std::filesystem::path& path,
                                              const std::string& settings);

  /// Returns the results found by open().
  [[nodiscard]] FrameResults take_results() { return std::move(results_); }

  /// Writes a result, whole or not at all, and flushes it to disk. From any thread. Fails with
  /// kWriteFailed.
  [[nodiscard]] Status add(const FrameKey& key, const FrameResult& result);

 private:
  Journal(std::filesystem::path path, files::OwnedDescriptor file, FrameResults results)
      : path_(std::move(path)), file_(std::move(file)), results_(std::move(results)) {}

  std::filesystem::path path_;
  files::OwnedDescriptor file_;
  FrameResults results_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
};

/// Returns the line of a result without its line end; reports use it, too.
[[nodiscard]] std::string journal_line(const FrameKey& key, const FrameResult& result);
/// Parses journal_line(). Fails with kMalformed if the line is invalid.
[[nodiscard]] Expected<std::pair<FrameKey, FrameResult>> parse_journal_line(
    const std::string& line);

}  // namespace terracut::eval
