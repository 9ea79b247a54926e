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
  /// `evaluation` and `pictures` must outlive this; `on_frame` is called after every frame.
  DrawnFrames(const Json& evaluation, FramePictures& pictures, std::filesystem::path folder,
              std::function<void()> on_frame)
      : evaluation_(evaluation),
        pictures_(pictures),
        folder_(std::move(folder)),
        on_frame_(std::move(on_frame)) {}

  /// Fig. 13, 14: the truth and every method side by side. A list of sequence, frame, why, side_m,
  /// and of the files truth and methods{name}; or fault, where the frame cannot be read.
  [[nodiscard]] Expected<Json> side_by_side(const std::vector<ChosenFrame>& frames);
  /// Fig. 16, 17: frames of method_in_question(). The same with the files truth, result, panorama.
  [[nodiscard]] Expected<Json> worst(const std::vector<ChosenFrame>& frames);

 private:
  /// What every frame's entry begins with; it has a fault where there is nothing to draw.
  [[nodiscard]] Json opened(const ChosenFrame& frame);
  /// Writes the picture and puts the file's name into `entry`.
  [[nodiscard]] Status draw(const pictures::Picture& picture, const std::string& name, Json& entry);

  const Json& evaluation_;
  FramePictures& pictures_;
  std::filesystem::path folder_;
  std::function<void()> on_frame_;
};

/// What the colours of the pictures stand for: truth{role} and verdict{name}, as CSS writes them.
[[nodiscard]] Json colours_json();

}  // namespace terracut::report
