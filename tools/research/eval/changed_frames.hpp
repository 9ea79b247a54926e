// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "pipeline/pictures/png_picture.hpp"
#include "rt/error.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/eval/labelled_by_all.hpp"
#include "tools/research/eval/method_choice.hpp"

namespace terracut::eval {

/// For every method but the first, keeps one frame as a picture from above: the frame in which most
/// returns are ground to one of the two methods and obstacle to the other. The left half shows the
/// method, the right half the first one; returns with equal labels are dim, the others green where
/// right, red where wrong, white where their class is ignored. For any thread.
class ChangedFrames {
 public:
  static constexpr int kSide = 320;  ///< Pixels of each half.

  /// Both arguments must outlive this object.
  ChangedFrames(std::span<const MethodChoice> methods, const datasets::ClassTable& classes);

  /// Looks at a frame. The order of calls does not matter: of equal frames the first by name is
  /// kept.
  void look(const LabelledByAll& frame);

  /// Writes `<folder>/<method>.png` for every method that ever differed, and changes.json: the
  /// method's frame, what changed there, and how many of these returns the first method has right
  /// and wrong.
  [[nodiscard]] Status write(const std::filesystem::path& folder) const;

 private:
  struct Change {
    std::string sequence, frame;
    std::uint64_t returns = 0;
    std::uint64_t right = 0, wrong = 0;  ///< Of the first method; ignored classes do not count.
    double side_m = 0;                   ///< Length of the picture's side.
    pictures::Picture picture{1, 1, {}};
  };
  [[nodiscard]] Change change_of(const LabelledByAll& frame, std::size_t method) const;
  void draw(const LabelledByAll& frame, std::size_t method, Change& change) const;
  [[nodiscard]] datasets::Role role_of(std::uint32_t label) const;

  std::span<const MethodChoice> methods_;
  const datasets::ClassTable& classes_;
  mutable std::mutex mutex_;  ///< Guards the following member.
  std::vector<Change> most_;  ///< Indexed by method.
};

}  // namespace terracut::eval
