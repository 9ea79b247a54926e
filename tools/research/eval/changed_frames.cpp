// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/eval/changed_frames.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "pipeline/pictures/bird_eye_picture.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::eval {

using frame::Label;
using frame::PlacedReturn;
using pictures::Colour;
using pictures::Picture;

namespace {

constexpr Colour kRight{60, 225, 130};
constexpr Colour kWrong{255, 70, 60};
constexpr Colour kNoMatter{225, 225, 225};
constexpr Colour kGround{92, 84, 70};
constexpr Colour kObstacle{58, 84, 120};

bool is_changed(Label one, Label other) noexcept {
  return is_ground(one) != is_ground(other);
}

bool is_right(datasets::Role truth, Label label) noexcept {
  return is_ground(label) == (truth == datasets::Role::kGround);
}

Colour colour_of(datasets::Role truth, Label label, bool changed) noexcept {
  if (!changed) return is_ground(label) ? kGround : kObstacle;
  if (truth == datasets::Role::kIgnored) return kNoMatter;
  return is_right(truth, label) ? kRight : kWrong;
}

/// Returns the side, in metres, of a square around the sensor that holds nine tenths of the changed
/// returns.
double side_around(std::vector<double>& distances_m) {
  constexpr double kLeast_m = 40, kMost_m = 120, kStep_m = 10, kShare = 0.9;
  const auto place = distances_m.begin() +
                     static_cast<std::ptrdiff_t>(kShare * static_cast<double>(distances_m.size()));
  std::ranges::nth_element(distances_m, place);
  return std::clamp(std::ceil(2 * *place / kStep_m) * kStep_m, kLeast_m, kMost_m);
}

Picture side_by_side(const Picture& left, const Picture& right) {
  constexpr int kGap = 6;
  Picture both(left.width() + kGap + right.width(), left.height(), {255, 255, 255});
  for (int y = 0; y < left.height(); ++y) {
    for (int x = 0; x < left.width(); ++x) both.set(x, y, left.at(x, y));
    for (int x = 0; x < right.width(); ++x) both.set(left.width() + kGap + x, y, right.at(x, y));
  }
  return both;
}

}  // namespace

ChangedFrames::ChangedFrames(std::span<const MethodChoice> methods,
                             const datasets::ClassTable& classes)
    : methods_(methods), classes_(classes), most_(methods.size()) {}

datasets::Role ChangedFrames::role_of(std::uint32_t label) const {
  return classes_.role(scan::semantic_class(label), datasets::GroundDefinition::kAll);
}

void ChangedFrames::look(const LabelledByAll& frame) {
  for (std::size_t i = 1; i < methods_.size(); ++i) {
    Change change = change_of(frame, i);
    if (change.returns == 0) continue;
    // Frames with more changed returns come first; frames with equally many are ordered by name.
    const auto is_more = [&] {
      const Change& most = most_[i];
      return change.returns != most.returns
                 ? change.returns > most.returns
                 : std::tie(change.sequence, change.frame) < std::tie(most.sequence, most.frame);
    };
    {
      const std::scoped_lock lock(mutex_);
      if (!is_more()) continue;
    }
    draw(frame, i, change);
    const std::scoped_lock lock(mutex_);
    if (is_more()) most_[i] = std::move(change);
  }
}

ChangedFrames::Change ChangedFrames::change_of(const LabelledByAll& frame,
                                               std::size_t method) const {
  Change change{.sequence = frame.sequence, .frame = frame.frame};
  const auto first = frame.labels_of(0), other = frame.labels_of(method);
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!is_changed(first[i], other[i])) continue;
    ++change.returns;
    const datasets::Role truth = role_of(frame.truth[i]);
    if (truth == datasets::Role::kIgnored) continue;
    ++(is_right(truth, first[i]) ? change.right : change.wrong);
  }
  return change;
}

void ChangedFrames::draw(const LabelledByAll& frame, std::size_t method, Change& change) const {
  const auto first = frame.labels_of(0), other = frame.labels_of(method);
  std::vector<Colour> before, after;
  std::vector<std::uint8_t> level;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const datasets::Role truth = role_of(frame.truth[i]);
    const bool changed = is_changed(first[i], other[i]);
    before.push_back(colour_of(truth, other[i], changed));
    after.push_back(colour_of(truth, first[i], changed));
    level.push_back(!changed ? 0 : truth == datasets::Role::kIgnored ? 1 : 2);
  }
  std::vector<double> distances_m;
  frame::for_each_return(frame.image, [&](const PlacedReturn& placed) {
    if (level[placed.return_index] == 0) return;
    distances_m.push_back(
        std::max(std::abs(double{placed.point.x_m}), std::abs(double{placed.point.y_m})));
  });
  change.side_m = side_around(distances_m);
  const pictures::BirdEyeView view{.side_m = change.side_m, .pixels_per_m = kSide / change.side_m};
  change.picture =
      side_by_side(bird_eye_picture(pictures::ColouredFrame{frame.image, before, level}, view),
                   bird_eye_picture(pictures::ColouredFrame{frame.image, after, level}, view));
}

Status ChangedFrames::write(const std::filesystem::path& folder) const {
  const std::scoped_lock lock(mutex_);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t i = 1; i < methods_.size(); ++i) {
    const Change& change = most_[i];
    if (change.returns == 0) continue;
    json[methods_[i].name] = {{"sequence", change.sequence}, {"frame", change.frame},
                              {"returns", change.returns},   {"right", change.right},
                              {"wrong", change.wrong},       {"side_m", change.side_m}};
    const Status drawn = change.picture.write_png(folder / (methods_[i].name + ".png"));
    if (!drawn) return drawn;
  }
  return files::write_whole_file(folder / "changes.json", json.dump(1) + "\n");
}

}  // namespace terracut::eval
