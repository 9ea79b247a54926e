// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_io/sinks/bird_eye_picture.hpp"
#include "frame_reader.hpp"
#include "tools/eval/evaluation.hpp"
#include "tools/eval/frame_labeller.hpp"

namespace terracut::evaluation::report {

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
inline constexpr std::size_t kVerdicts = 7;

[[nodiscard]] Verdict verdict_of(Role truth, pipeline::Label label) noexcept;
[[nodiscard]] firmware_io::Colour colour_of(Verdict verdict) noexcept;
/// Colours of the truth alone: ground, ordinary obstacle, key obstacle.
[[nodiscard]] firmware_io::Colour colour_of(Role truth) noexcept;
/// Of ground that is road, where a method is asked to tell it.
inline constexpr firmware_io::Colour kTrueRoadColour{150, 92, 158};

/// Pictures of single frames: the truth, and what methods make of it.
class FramePictures {
 public:
  /// `config` and `reader` must outlive this.
  FramePictures(const EvaluationConfig& config, FrameReader& reader)
      : config_(config), reader_(reader) {}

  /// The frame that is shown from now on. Errors of FrameReader::read() and FrameLabeller::place().
  [[nodiscard]] Status open(const std::string& sequence, const std::string& frame);

  /// `with_road`: road in a colour of its own.
  [[nodiscard]] firmware_io::Picture truth(const firmware_io::BirdEyeView& view,
                                           bool with_road) const;
  /// By one of config.methods, with its mistakes on top.
  [[nodiscard]] firmware_io::Picture result(std::string_view method,
                                            const firmware_io::BirdEyeView& view);
  /// What to look at to see all key obstacles that the method missed: the sensor in the middle,
  /// 60 to 160 m wide, drawn in about `side` pixels.
  [[nodiscard]] firmware_io::BirdEyeView view_of_misses(std::string_view method, int side);
  /// result() with a ring around missed key obstacles: single returns are hard to see.
  [[nodiscard]] firmware_io::Picture marked_result(std::string_view method,
                                                   const firmware_io::BirdEyeView& view);
  /// The same as a panorama (range_image_picture.hpp); missed obstacles red, false ones yellow.
  [[nodiscard]] firmware_io::Picture panorama(std::string_view method);

 private:
  void label(std::string_view method);
  /// Where the last label() missed key obstacles.
  [[nodiscard]] std::vector<pipeline::Return> missed_key() const;

  const EvaluationConfig& config_;
  FrameReader& reader_;
  std::string sequence_;
  std::unique_ptr<FrameLabeller> labeller_;
  std::vector<pipeline::Label> labels_;  ///< By return index.
};

}  // namespace terracut::evaluation::report
