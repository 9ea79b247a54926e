// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "chosen_frames.hpp"
#include "frame_pictures.hpp"

namespace terracut::report {

/// Draws frames into files of `folder`/pictures and lists them for a page.
class DrawnFrames {
 public:
  /// `evaluation` and `pictures` must outlive this object; `on_frame` is called after every frame.
  DrawnFrames(const Json& evaluation, FramePictures& pictures, std::filesystem::path folder,
              std::function<void()> on_frame)
      : evaluation_(evaluation),
        pictures_(pictures),
        folder_(std::move(folder)),
        on_frame_(std::move(on_frame)) {}

  /// Draws the truth and every method side by side (as in the paper's Fig. 13, 14). Returns a list
  /// with sequence, frame, why, side_m, and the files truth and methods{name}; a frame that cannot
  /// be read has a fault instead.
  [[nodiscard]] Expected<Json> side_by_side(const std::vector<ChosenFrame>& frames);
  /// Draws frames of method_in_question() (as in the paper's Fig. 16, 17). Returns a list with the
  /// files truth, result and panorama.
  [[nodiscard]] Expected<Json> worst(const std::vector<ChosenFrame>& frames);

 private:
  /// Opens a frame and returns the beginning of its entry, with a fault if there is nothing to
  /// draw.
  [[nodiscard]] Json opened(const ChosenFrame& frame);
  /// Writes the picture and puts the file's name into `entry`.
  [[nodiscard]] Status draw(const pictures::Picture& picture, const std::string& name, Json& entry);

  const Json& evaluation_;
  FramePictures& pictures_;
  std::filesystem::path folder_;
  std::function<void()> on_frame_;
};

/// Returns the meaning of the pictures' colours: truth{role} and verdict{name}, in CSS notation.
[[nodiscard]] Json colours_json();

}  // namespace terracut::report
