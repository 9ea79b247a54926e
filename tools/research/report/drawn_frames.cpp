// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "drawn_frames.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace terracut::report {
namespace {

using pictures::BirdEyeView;
using pictures::Colour;

constexpr BirdEyeView kSmall{.side_m = 60, .pixels_per_m = 6, .ring_spacing_m = 10};
constexpr int kLargeSide = 640;  // pixels

std::string css(Colour colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

/// True if the method tells the road surface from other ground.
bool tells_road(const Json& method) {
  return std::ranges::any_of(method.at("by_class"), [](const Json& entry) {
    return entry.at("as_other_ground").get<std::uint64_t>() > 0;
  });
}

}  // namespace

Json DrawnFrames::opened(const ChosenFrame& frame) {
  Json entry{{"sequence", frame.sequence}, {"frame", frame.frame}, {"why", frame.why}};
  const Status opened = pictures_.open(frame.sequence, frame.frame);
  if (!opened) entry["fault"] = opened.error().message;
  return entry;
}

Status DrawnFrames::draw(const pictures::Picture& picture, const std::string& name, Json& entry) {
  entry = "pictures/" + name + ".png";
  return picture.write_png(folder_ / entry.get<std::string>());
}

Expected<Json> DrawnFrames::side_by_side(const std::vector<ChosenFrame>& frames) {
  const bool with_road = std::ranges::any_of(evaluation_.at("methods"), tells_road);
  Json list = Json::array();
  for (const ChosenFrame& frame : frames) {
    Json entry = opened(frame);
    if (!entry.contains("fault")) {
      const std::string name = frame.sequence + "_" + frame.frame + "_";
      entry["side_m"] = kSmall.side_m;
      Status drawn = draw(pictures_.truth(kSmall, with_road), name + "truth", entry["truth"]);
      for (const auto& [method, results] : evaluation_.at("methods").items()) {
        if (!drawn) return tl::unexpected(drawn.error());
        drawn = draw(pictures_.result(method, kSmall), name + method, entry["methods"][method]);
      }
      if (!drawn) return tl::unexpected(drawn.error());
    }
    list.push_back(std::move(entry));
    on_frame_();
  }
  return list;
}

Expected<Json> DrawnFrames::worst(const std::vector<ChosenFrame>& frames) {
  const std::string method = method_in_question(evaluation_);
  const bool with_road = tells_road(evaluation_.at("methods").at(method));
  Json list = Json::array();
  for (const ChosenFrame& frame : frames) {
    Json entry = opened(frame);
    if (!entry.contains("fault")) {
      const std::string name = "worst_" + frame.sequence + "_" + frame.frame + "_";
      const BirdEyeView view = pictures_.view_of_misses(method, kLargeSide);
      entry["side_m"] = view.side_m;
      const Status drawn =
          draw(pictures_.truth(view, with_road), name + "truth", entry["truth"])
              .and_then([&] {
                return draw(pictures_.marked_result(method, view), name + "result",
                            entry["result"]);
              })
              .and_then([&] {
                return draw(pictures_.panorama(method), name + "panorama", entry["panorama"]);
              });
      if (!drawn) return tl::unexpected(drawn.error());
    }
    list.push_back(std::move(entry));
    on_frame_();
  }
  return list;
}

Json colours_json() {
  using datasets::Role;
  return {{"truth",
           {{"road", css(kTrueRoadColour)},
            {"ground", css(colour_of(Role::kGround))},
            {"ordinary", css(colour_of(Role::kOrdinaryObstacle))},
            {"key", css(colour_of(Role::kKeyObstacle))},
            {"ignored", css(colour_of(Role::kIgnored))}}},
          {"verdict",
           {{"ground", css(colour_of(Verdict::kGround))},
            {"other_ground", css(colour_of(Verdict::kOtherGround))},
            {"obstacle", css(colour_of(Verdict::kObstacle))},
            {"missed_key", css(colour_of(Verdict::kMissedKey))},
            {"missed_ordinary", css(colour_of(Verdict::kMissedOrdinary))},
            {"false_obstacle", css(colour_of(Verdict::kFalseObstacle))}}}};
}

}  // namespace terracut::report
