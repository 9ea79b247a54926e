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

/// Results on disk as they come, one line of JSON each, so that a run that is killed goes on where
/// it was: at most the frames in work are lost. The first line says what was run, and a journal of
/// something else is refused, not mixed.
class Journal {
 public:
  /// Reads what is there, cuts off a line that was not finished, and goes on behind it.
  /// `settings`: everything results depend on, words in one line of text. kInvalidArgument: the
  /// file is of other settings (the message names the words that differ), or another process is
  /// writing it. kMalformed: a whole line that is no result. kWriteFailed.
  [[nodiscard]] static Expected<Journal> open(const std::filesystem::path& path,
                                              const std::string& settings);

  /// What was found by open().
  [[nodiscard]] FrameResults take_results() { return std::move(results_); }

  /// From any thread; whole or not at all, and on disk as far as the system tells. kWriteFailed.
  [[nodiscard]] Status add(const FrameKey& key, const FrameResult& result);

 private:
  Journal(std::filesystem::path path, files::OwnedDescriptor file, FrameResults results)
      : path_(std::move(path)), file_(std::move(file)), results_(std::move(results)) {}

  std::filesystem::path path_;
  files::OwnedDescriptor file_;
  FrameResults results_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
};

/// One line of the journal, without its end; for reports, too.
[[nodiscard]] std::string journal_line(const FrameKey& key, const FrameResult& result);
/// kMalformed when it is none.
[[nodiscard]] Expected<std::pair<FrameKey, FrameResult>> parse_journal_line(
    const std::string& line);

}  // namespace terracut::eval
