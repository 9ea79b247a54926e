// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/pictures/png_picture.hpp"
#include "rt/error.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/eval/method_choice.hpp"

namespace terracut::eval {

/// A frame that every method has labelled; everything by return index of `image`.
struct LabelledByAll {
  const std::string& sequence;
  const std::string& frame;
  const frame::RangeImage& image;
  std::span<const std::uint32_t> truth;                                 ///< As in label files.
  std::function<std::span<const frame::Label>(std::size_t)> labels_of;  ///< methods[index]
};

/// Of every method but the first: the frame with most returns that are ground to one and obstacle
/// to the other, as a picture from above. On the left what the method said, on the right the first
/// one; returns of which both say the same dim, the others green where that is right, red where it
/// is wrong, white where their class counts nowhere. From any thread.
class ChangedFrames {
 public:
  static constexpr int kSide = 320;  ///< Pixels of either half.

  /// Both must outlive this.
  ChangedFrames(std::span<const eval::MethodChoice> methods, const datasets::ClassTable& classes);

  /// The order of calls makes no difference: of equal frames the first by name is kept.
  void look(const LabelledByAll& frame);

  /// `<folder>/<method>.png` for every method that ever differed, and changes.json: of each of them
  /// the frame, what changed there, and what of it the first method has right and wrong.
  [[nodiscard]] Status write(const std::filesystem::path& folder) const;

 private:
  struct Change {
    std::string sequence, frame;
    std::uint64_t returns = 0;
    std::uint64_t right = 0, wrong = 0;  ///< To the first; the others count nowhere.
    double side_m = 0;                   ///< Of what the picture shows.
    pictures::Picture picture{1, 1, {}};
  };
  [[nodiscard]] Change change_of(const LabelledByAll& frame, std::size_t method) const;
  void draw(const LabelledByAll& frame, std::size_t method, Change& change) const;
  [[nodiscard]] datasets::Role role_of(std::uint32_t label) const;

  std::span<const eval::MethodChoice> methods_;
  const datasets::ClassTable& classes_;
  mutable std::mutex mutex_;  ///< Guards what follows.
  std::vector<Change> most_;  ///< By method.
};

}  // namespace terracut::eval
