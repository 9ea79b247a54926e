// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "frame_result.hpp"
#include "journal.hpp"
#include "method_choice.hpp"
#include "rt/error.hpp"

namespace terracut::eval {

/// Stores the results of frames as they come: in memory, in the journal and, as labels, in
/// `<predictions>/<method>/sequences/<sequence>/predictions/<frame>.label`. From any thread.
class ResultKeeper {
 public:
  /// Starts with the results of these methods in `journal`, which may be null; it and `methods`
  /// must outlive this object. If `predictions` is empty, none are written.
  ResultKeeper(std::span<const MethodChoice> methods, std::filesystem::path predictions,
               Journal* journal);

  /// Notes that a frame belongs to this run. take_results() returns only frames noted so; the
  /// journal may hold others.
  void expect(const std::string& sequence, const std::string& frame);

  /// Returns the indices of the methods that have not labelled this frame yet, or whose requested
  /// prediction is missing.
  [[nodiscard]] std::vector<std::size_t> methods_left(const std::string& sequence,
                                                      const std::string& frame) const;

  /// Keeps a result. Returns false once something could not be written: see failure().
  bool keep(const FrameKey& key, std::span<const frame::Label> labels, FrameResult result);

  [[nodiscard]] std::optional<Error> failure() const;
  [[nodiscard]] FrameResults take_results();

 private:
  [[nodiscard]] std::filesystem::path prediction(const FrameKey& key) const;

  std::span<const MethodChoice> methods_;
  std::filesystem::path predictions_;
  Journal* journal_;

  mutable std::mutex mutex_;  ///< Guards the following members.
  FrameResults results_;
  std::set<std::pair<std::string, std::string>> expected_;  ///< Keyed by sequence and frame.
  std::optional<Error> failure_;
};

}  // namespace terracut::eval
