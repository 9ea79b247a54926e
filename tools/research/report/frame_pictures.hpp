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

/// How a return's label compares with its truth; decides its colour.
enum class Verdict : std::uint8_t {
  kGround,          ///< Ground, called ground.
  kOtherGround,     ///< Ground, labelled as no road surface.
  kObstacle,        ///< Obstacle, called obstacle.
  kMissedKey,       ///< Key obstacle, called ground.
  kMissedOrdinary,  ///< Ordinary obstacle, called ground.
  kFalseObstacle,   ///< Ground, called obstacle.
  kIgnored,         ///< The return's class is ignored.
};

[[nodiscard]] Verdict verdict_of(datasets::Role truth, frame::Label label) noexcept;
[[nodiscard]] pictures::Colour colour_of(Verdict verdict) noexcept;
/// Returns the colour of a return by its truth alone: ground, ordinary obstacle, key obstacle.
[[nodiscard]] pictures::Colour colour_of(datasets::Role truth) noexcept;
/// The colour of ground that is road, in pictures of methods that tell road from other ground.
inline constexpr pictures::Colour kTrueRoadColour{150, 92, 158};

/// Pictures of single frames: the truth, and the results of methods.
class FramePictures {
 public:
  /// `config` and `reader` must outlive this object.
  FramePictures(const eval::EvaluationConfig& config, FrameReader& reader)
      : config_(config), reader_(reader) {}

  /// Sets the frame of all pictures. Fails with the errors of FrameReader::read() and
  /// FrameLabeller::place().
  [[nodiscard]] Status open(const std::string& sequence, const std::string& frame);

  /// Draws the truth; `with_road` gives road its own colour.
  [[nodiscard]] pictures::Picture truth(const pictures::BirdEyeView& view, bool with_road) const;
  /// Draws the labels of one of config.methods, with its mistakes on top.
  [[nodiscard]] pictures::Picture result(std::string_view method,
                                         const pictures::BirdEyeView& view);
  /// Returns a view that shows all key obstacles that the method missed: the sensor in the middle,
  /// 60 to 160 m wide, drawn in about `side` pixels.
  [[nodiscard]] pictures::BirdEyeView view_of_misses(std::string_view method, int side);
  /// Draws what result() draws, and a ring around missed key obstacles, because single returns are
  /// hard to see.
  [[nodiscard]] pictures::Picture marked_result(std::string_view method,
                                                const pictures::BirdEyeView& view);
  /// Draws the labels as a panorama (range_image_picture.hpp); missed obstacles are red, false ones
  /// yellow.
  [[nodiscard]] pictures::Picture panorama(std::string_view method);

 private:
  void label(std::string_view method);
  /// Returns the key obstacles' returns that the last label() missed.
  [[nodiscard]] std::vector<frame::Return> missed_key() const;

  const eval::EvaluationConfig& config_;
  FrameReader& reader_;
  std::string sequence_;
  std::unique_ptr<eval::FrameLabeller> labeller_;
  std::vector<frame::Label> labels_;  ///< One per return.
};

}  // namespace terracut::report
