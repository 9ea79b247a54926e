// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "picture_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "html.hpp"
#include "table_parts.hpp"

namespace terracut::evaluation::report {
namespace {

using firmware_io::BirdEyeView;
using firmware_io::Colour;
using firmware_io::Picture;

constexpr BirdEyeView kSmall{.side_m = 60, .pixels_per_m = 6, .ring_spacing_m = 10};
constexpr int kLargeSide = 640;  // pixels

std::string swatch(Colour colour, std::string_view what) {
  return fmt::format(R"(<span><i style="background:#{:02x}{:02x}{:02x}"></i>{}</span> )",
                     colour.red, colour.green, colour.blue, what);
}

std::string truth_legend(bool with_road) {
  return "<p class=\"legend\">Truth: " + (with_road ? swatch(kTrueRoadColour, "road") : "") +
         swatch(colour_of(Role::kGround), with_road ? "other ground" : "ground") +
         swatch(colour_of(Role::kOrdinaryObstacle), "ordinary obstacle") +
         swatch(colour_of(Role::kKeyObstacle), "key obstacle") +
         swatch(colour_of(Role::kIgnored), "counts nowhere") + "</p>\n";
}

std::string verdict_legend(bool with_road) {
  return "<p class=\"legend\">Methods: " +
         swatch(colour_of(Verdict::kGround),
                with_road ? "ground found; road, if the method tells it" : "ground found") +
         (with_road ? swatch(colour_of(Verdict::kOtherGround), "ground found, told to be no road")
                    : "") +
         swatch(colour_of(Verdict::kObstacle), "obstacle found") +
         swatch(colour_of(Verdict::kMissedKey), "key obstacle called ground") +
         swatch(colour_of(Verdict::kMissedOrdinary), "ordinary obstacle called ground") +
         swatch(colour_of(Verdict::kFalseObstacle), "ground called obstacle") + "</p>\n";
}

/// The picture as a figure, or what libpng said against it.
std::string figure(const Picture& picture, std::string_view caption, std::string_view alternative) {
  const auto png = picture.png();
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                     png ? png_element(*png, picture.width(), picture.height(), alternative)
                         : escaped(png.error().message),
                     caption);
}

/// What a method scores on the frame.
std::string score(const Json& evaluation, const std::string& method, const ChosenFrame& chosen) {
  const Json& frames = evaluation.at("methods").at(method).at("frames");
  const auto of_frame = std::ranges::find_if(frames, [&](const Json& frame) {
    return frame.at("sequence") == chosen.sequence && frame.at("frame") == chosen.frame;
  });
  if (of_frame == frames.end()) return "not measured";
  const auto text = [&](const char* measure) {
    const Json& value = of_frame->at(measure);
    return value.is_null() ? std::string("–") : fmt::format("{:.2f} %", 100 * value.get<double>());
  };
  const bool with_road = tells_road(evaluation.at("methods").at(method));
  return fmt::format("IoU<sub>g</sub> {}, Recall<sub>o</sub> {}{}", text("iou_g"), text("recall_o"),
                     with_road ? "<br>road: IoU<sub>g</sub> " + text("iou_road") : "");
}

std::string not_shown(const Error& error) {
  return fmt::format("<p class=\"fault\">Not shown: {}</p>\n", escaped(error.message));
}

/// The reason with its measures set as everywhere on the page.
std::string why_text(const ChosenFrame& frame) {
  std::string html = escaped(frame.why);
  for (const std::string_view measure : {"Recall_o", "IoU_g"}) {
    const std::size_t at = html.find(measure);
    if (at == std::string::npos) continue;
    const std::size_t underscore = at + measure.size() - 2;
    html.replace(underscore, 2, fmt::format("<sub>{}</sub>", measure.back()));
  }
  return html;
}

std::string frame_title(const ChosenFrame& frame) {
  return escaped(frame.sequence + "/" + frame.frame);
}

}  // namespace

std::string comparison_section(const Json& evaluation, const std::vector<ChosenFrame>& frames,
                               FramePictures& pictures, const OnFrame& on_frame) {
  const bool with_road = any_tells_road(evaluation);
  std::string html =
      "<section id=\"comparison\"><h2>Side by side (Fig. 13, 14)</h2>\n<p>The middle frame of "
      "every "
      "sequence from above, 60 m wide, driving up, rings 10 m apart; all physical ground is "
      "ground. Mistakes lie on top.</p>\n" +
      truth_legend(with_road) + verdict_legend(with_road);
  for (const ChosenFrame& frame : frames) {
    html += fmt::format("<h3>{}</h3>\n", frame_title(frame));
    const Status opened = pictures.open(frame.sequence, frame.frame);
    if (!opened) {
      html += not_shown(opened.error());
      on_frame();
      continue;
    }
    html += "<div class=\"pictures small\">\n";
    html +=
        figure(pictures.truth(kSmall, with_road), "<b>truth</b><br>by the labels of the dataset",
               "truth of " + frame.sequence + "/" + frame.frame);
    for (const auto& [name, method] : evaluation.at("methods").items()) {
      html += figure(pictures.result(name, kSmall),
                     fmt::format("<b>{}</b><br>{}", escaped(name), score(evaluation, name, frame)),
                     name + " on " + frame.sequence + "/" + frame.frame);
    }
    html += "</div>\n";
    on_frame();
  }
  return html + "</section>\n";
}

std::string worst_section(const Json& evaluation, const std::vector<ChosenFrame>& frames,
                          FramePictures& pictures, const OnFrame& on_frame) {
  const std::string method = method_in_question(evaluation);
  const bool with_road = tells_road(evaluation.at("methods").at(method));
  std::string html = fmt::format(
      "<section id=\"worst\"><h2>Where it fails (Fig. 16, 17)</h2>\n<p>Of every sequence the "
      "frames where <b>{}</b> has its lowest Recall<sub>o</sub> and its lowest IoU<sub>g</sub>; "
      "rings of red are around key obstacles it missed. Below, the view from the sensor, straight "
      "ahead in the middle: every missed obstacle red, ground "
      "called obstacle yellow.</p>\n",
      escaped(method));
  html += truth_legend(with_road) + verdict_legend(with_road);
  for (const ChosenFrame& frame : frames) {
    html += fmt::format("<h3>{}: {}</h3>\n<p>{}</p>\n", frame_title(frame), why_text(frame),
                        score(evaluation, method, frame));
    const Status opened = pictures.open(frame.sequence, frame.frame);
    if (!opened) {
      html += not_shown(opened.error());
      on_frame();
      continue;
    }
    const BirdEyeView view = pictures.view_of_misses(method, kLargeSide);
    const std::string place = " of " + frame.sequence + "/" + frame.frame;
    html += "<div class=\"pictures large\">\n" +
            figure(pictures.truth(view, with_road),
                   fmt::format("truth, {:.0f} m wide", view.side_m), "truth" + place) +
            figure(pictures.marked_result(method, view), escaped(method), method + place) +
            "</div>\n<div class=\"pictures panorama\">\n" +
            figure(pictures.panorama(method), "from the sensor", "panorama" + place) + "</div>\n";
    on_frame();
  }
  return html + "</section>\n";
}

}  // namespace terracut::evaluation::report
