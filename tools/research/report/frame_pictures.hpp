// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "frame_reader.hpp"
#include "pipeline/pictures/bird_eye_picture.hpp"
#include "tools/research/eval/evaluation.hpp"
#include "tools/research/eval/frame_labeller.hpp"

namespace terracut::report {

/// What a label made of a return, for its colour.
enum class Verdict : std::uint8_t {
  kGround,          ///< Ground, called ground.
  kOtherGround,     ///< Ground, told to be no road surface.
  kObstacle,        ///< Obstacle, called obstacle.
  kMissedKey,       ///< Key obstacle, called ground.
  kMissedOrdinary,  ///< Ordinary obstacle, called ground.
  kFalseObstacle,   ///< Ground, called obstacle.
  kIgnored,         ///< Of a class that counts nowhere.
};

[[nodiscard]] Verdict verdict_of(datasets::Role truth, frame::Label label) noexcept;
[[nodiscard]] pictures::Colour colour_of(Verdict verdict) noexcept;
/// Colours of the truth alone: ground, ordinary obstacle, key obstacle.
[[nodiscard]] pictures::Colour colour_of(datasets::Role truth) noexcept;
/// Of ground that is road, where a method is asked to tell it.
inline constexpr pictures::Colour kTrueRoadColour{150, 92, 158};

/// Pictures of single frames: the truth, and what methods make of it.
class FramePictures {
 public:
  /// `config` and `reader` must outlive this.
  FramePictures(const eval::EvaluationConfig& config, FrameReader& reader)
      : config_(config), reader_(reader) {}

  /// The frame that is shown from now on. Errors of FrameReader::read() and FrameLabeller::place().
  [[nodiscard]] Status open(const std::string& sequence, const std::string& frame);

  /// `with_road`: road in a colour of its own.
  [[nodiscard]] pictures::Picture truth(const pictures::BirdEyeView& view, bool with_road) const;
  /// By one of config.methods, with its mistakes on top.
  [[nodiscard]] pictures::Picture result(std::string_view method,
                                         const pictures::BirdEyeView& view);
  /// What to look at to see all key obstacles that the method missed: the sensor in the middle,
  /// 60 to 160 m wide, drawn in about `side` pixels.
  [[nodiscard]] pictures::BirdEyeView view_of_misses(std::string_view method, int side);
  /// result() with a ring around missed key obstacles: single returns are hard to see.
  [[nodiscard]] pictures::Picture marked_result(std::string_view method,
                                                const pictures::BirdEyeView& view);
  /// The same as a panorama (range_image_picture.hpp); missed obstacles red, false ones yellow.
  [[nodiscard]] pictures::Picture panorama(std::string_view method);

 private:
  void label(std::string_view method);
  /// Where the last label() missed key obstacles.
  [[nodiscard]] std::vector<frame::Return> missed_key() const;

  const eval::EvaluationConfig& config_;
  FrameReader& reader_;
  std::string sequence_;
  std::unique_ptr<eval::FrameLabeller> labeller_;
  std::vector<frame::Label> labels_;  ///< By return index.
};

}  // namespace terracut::report
