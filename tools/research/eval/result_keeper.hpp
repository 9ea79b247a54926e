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

/// Puts the results of frames where they belong as they come: into memory, the journal, and, their
/// labels, into `<predictions>/<method>/sequences/<sequence>/predictions/<frame>.label`. From any
/// thread.
class ResultKeeper {
 public:
  /// Begins with what `journal` has of these methods. `journal`: may be null; it and `methods` must
  /// outlive this. `predictions`: empty: none are written.
  ResultKeeper(std::span<const MethodChoice> methods, std::filesystem::path predictions,
               Journal* journal);

  /// A frame that this run is about. The journal may have others, of a run over more of the
  /// dataset: they are not among take_results().
  void expect(const std::string& sequence, const std::string& frame);

  /// The methods, by index, that have not labelled this frame yet, or whose prediction is wanted
  /// and not there.
  [[nodiscard]] std::vector<std::size_t> methods_left(const std::string& sequence,
                                                      const std::string& frame) const;

  /// False, from then on, when something could not be written: failure().
  bool keep(const FrameKey& key, std::span<const frame::Label> labels, FrameResult result);

  [[nodiscard]] std::optional<Error> failure() const;
  [[nodiscard]] FrameResults take_results();

 private:
  [[nodiscard]] std::filesystem::path prediction(const FrameKey& key) const;

  std::span<const MethodChoice> methods_;
  std::filesystem::path predictions_;
  Journal* journal_;

  mutable std::mutex mutex_;  ///< Guards what follows.
  FrameResults results_;
  std::set<std::pair<std::string, std::string>> expected_;  ///< By sequence and frame.
  std::optional<Error> failure_;
};

}  // namespace terracut::eval
