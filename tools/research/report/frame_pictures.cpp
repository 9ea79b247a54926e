// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "firmware_io/frame/each_return.hpp"
#include "pipeline/pictures/range_image_picture.hpp"

namespace terracut::report {

using frame::Label;
using pictures::Colour;
using pictures::Mistake;
using pictures::Picture;

namespace {

/// Returns the level of a verdict in the drawing: the most important one is on top.
std::uint8_t level_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kMissedKey:
      return 3;
    case Verdict::kMissedOrdinary:
      return 2;
    case Verdict::kFalseObstacle:
      return 1;
    default:
      return 0;
  }
}

}  // namespace

Verdict verdict_of(datasets::Role truth, Label label) noexcept {
  const bool called_ground = is_ground(label);
  switch (truth) {
    case datasets::Role::kGround:
      if (label == Label::kOtherGround) return Verdict::kOtherGround;
      return called_ground ? Verdict::kGround : Verdict::kFalseObstacle;
    case datasets::Role::kOrdinaryObstacle:
      return called_ground ? Verdict::kMissedOrdinary : Verdict::kObstacle;
    case datasets::Role::kKeyObstacle:
      return called_ground ? Verdict::kMissedKey : Verdict::kObstacle;
    case datasets::Role::kIgnored:
      break;
  }
  return Verdict::kIgnored;
}

Colour colour_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kGround:
      return {116, 104, 84};
    case Verdict::kOtherGround:
      return {86, 122, 76};
    case Verdict::kObstacle:
      return {74, 104, 142};
    case Verdict::kMissedKey:
      return pictures::kMissedObstacleColour;
    case Verdict::kMissedOrdinary:
      return {255, 140, 30};
    case Verdict::kFalseObstacle:
      return pictures::kFalseObstacleColour;
    case Verdict::kIgnored:
      break;
  }
  return {52, 57, 66};
}

Colour colour_of(datasets::Role truth) noexcept {
  switch (truth) {
    case datasets::Role::kGround:
      return {226, 160, 186};
    case datasets::Role::kOrdinaryObstacle:
      return {76, 160, 96};
    case datasets::Role::kKeyObstacle:
      return {255, 64, 64};
    case datasets::Role::kIgnored:
      break;
  }
  return colour_of(Verdict::kIgnored);
}

Status FramePictures::open(const std::string& sequence, const std::string& frame) {
  if (const Status read = reader_.read(sequence, frame); !read) return read;
  if (!labeller_ || sequence != sequence_) {
    labeller_ = std::make_unique<eval::FrameLabeller>(config_.methods, reader_.scans(),
                                                      reader_.profile(), config_.through_packets);
    sequence_ = sequence;
  }
  return labeller_->place(reader_.scan(), reader_.rings());
}

Picture FramePictures::truth(const pictures::BirdEyeView& view, bool with_road) const {
  std::vector<Colour> colours;
  std::vector<std::uint8_t> key;
  for (std::size_t i = 0; i < reader_.truth().size(); ++i) {
    const datasets::Role role = reader_.truth()[i];
    const bool is_road = role == datasets::Role::kGround && reader_.is_road()[i] != 0;
    colours.push_back(with_road && is_road ? kTrueRoadColour : colour_of(role));
    key.push_back(role == datasets::Role::kKeyObstacle);
  }
  return bird_eye_picture(pictures::ColouredFrame{reader_.image(), colours, key}, view);
}

void FramePictures::label(std::string_view method) {
  const auto found = std::ranges::find(config_.methods, method, &eval::MethodChoice::name);
  (void)labeller_->label(static_cast<std::size_t>(found - config_.methods.begin()));
  labels_.clear();
  for (const std::uint32_t point : reader_.point_of_return()) {
    labels_.push_back(labeller_->points()[point]);
  }
}

Picture FramePictures::result(std::string_view method, const pictures::BirdEyeView& view) {
  label(method);
  std::vector<Colour> colours;
  std::vector<std::uint8_t> level;
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const Verdict verdict = verdict_of(reader_.truth()[i], labels_[i]);
    colours.push_back(colour_of(verdict));
    level.push_back(level_of(verdict));
  }
  return bird_eye_picture(pictures::ColouredFrame{reader_.image(), colours, level}, view);
}

std::vector<frame::Return> FramePictures::missed_key() const {
  std::vector<frame::Return> missed;
  frame::for_each_return(reader_.image(), [&](const frame::PlacedReturn& placed) {
    const std::size_t i = placed.return_index;
    if (verdict_of(reader_.truth()[i], labels_[i]) == Verdict::kMissedKey) {
      missed.push_back(placed.point);
    }
  });
  return missed;
}

pictures::BirdEyeView FramePictures::view_of_misses(std::string_view method, int side) {
  constexpr double kLeast_m = 60, kMost_m = 160, kStep_m = 10, kMargin_m = 3;
  label(method);
  double farthest_m = 0;
  for (const frame::Return& missed : missed_key()) {
    farthest_m = std::max<double>(farthest_m, std::max(std::abs(missed.x_m), std::abs(missed.y_m)));
  }
  const double side_m = std::ceil(2 * (farthest_m + kMargin_m) / kStep_m) * kStep_m;
  pictures::BirdEyeView view;
  view.side_m = std::clamp(side_m, kLeast_m, kMost_m);
  view.pixels_per_m = side / view.side_m;
  return view;
}

Picture FramePictures::marked_result(std::string_view method, const pictures::BirdEyeView& view) {
  constexpr double kRadius = 9;  // pixels
  Picture picture = result(method, view);
  std::set<std::pair<int, int>> marked;  // several misses close together share a ring
  for (const frame::Return& missed : missed_key()) {
    const double x = picture.width() / 2.0 - static_cast<double>(missed.y_m) * view.pixels_per_m;
    const double y = picture.height() / 2.0 - static_cast<double>(missed.x_m) * view.pixels_per_m;
    if (!(x >= 0 && x < picture.width() && y >= 0 && y < picture.height())) continue;
    if (!marked.emplace(static_cast<int>(x / kRadius), static_cast<int>(y / kRadius)).second)
      continue;
    picture.circle(x, y, kRadius, 1.5, colour_of(Verdict::kMissedKey), 0.8);
  }
  return picture;
}

Picture FramePictures::panorama(std::string_view method) {
  label(method);
  std::vector<Mistake> mistakes;
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    switch (verdict_of(reader_.truth()[i], labels_[i])) {
      case Verdict::kMissedKey:
      case Verdict::kMissedOrdinary:
        mistakes.push_back(Mistake::kMissedObstacle);
        break;
      case Verdict::kFalseObstacle:
        mistakes.push_back(Mistake::kFalseObstacle);
        break;
      default:
        mistakes.push_back(Mistake::kNone);
    }
  }
  return pictures::range_image_picture({reader_.image(), labels_, mistakes});
}

}  // namespace terracut::report
