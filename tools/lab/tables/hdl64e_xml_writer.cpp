// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/tables/hdl64e_xml_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "calib/beams/angle.hpp"
#include "calib/text/number_text.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::hdl64e {
namespace {

using Text = fmt::memory_buffer;

/// Returns the shortest text in degrees that deg_to_rad() turns back into exactly `rad`; if there
/// is none, that of the nearest double.
std::string degrees(double rad) {
  const double nearest = beams::rad_to_deg(rad);
  std::string best = text::text_of(nearest, 0);
  bool exact = beams::deg_to_rad(nearest) == rad;
  for (const double towards : {-HUGE_VAL, HUGE_VAL}) {
    double candidate = nearest;
    for (int ulp = 0; ulp < 2; ++ulp) {
      candidate = std::nextafter(candidate, towards);
      const std::string text = text::text_of(candidate, 0);
      if (beams::deg_to_rad(candidate) != rad || (exact && text.size() >= best.size())) continue;
      best = text;
      exact = true;
    }
  }
  return best;
}

std::string centimetres(double m) {
  return text::text_of(m, -2);
}

template <class... Args>
void put(Text& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

/// Writes a list of one value a laser, as Boost.Serialization writes a std::vector or std::array.
template <class Value>
void put_list(Text& text, std::string_view element, bool versioned, Value value) {
  put(text, "\t<{}>\n\t\t<count>64</count>\n", element);
  if (versioned) put(text, "\t\t<item_version>0</item_version>\n");
  for (std::size_t i = 0; i < kHdl64eLasers; ++i) put(text, "\t\t<item>{}</item>\n", value(i));
  put(text, "\t</{}>\n", element);
}

/// Writes the display colours. Readers expect them in the layout but do not use them, so they are
/// shades of grey.
void put_colors(Text& text) {
  put(text,
      "\t<colors_ class_id=\"3\" tracking_level=\"0\" version=\"0\">\n"
      "\t\t<count>64</count>\n\t\t<item_version>0</item_version>\n");
  for (int i = 0; i < kHdl64eLasers; ++i) {
    const double grey = (i + 1) / static_cast<double>(kHdl64eLasers);
    put(text, "\t\t<item{}>\n\t\t\t<rgb>\n\t\t\t\t<count>3</count>\n",
        i == 0 ? " class_id=\"4\" tracking_level=\"0\" version=\"0\"" : "");
    for (int channel = 0; channel < 3; ++channel) put(text, "\t\t\t\t<item>{}</item>\n", grey);
    put(text, "\t\t\t</rgb>\n\t\t</item>\n");
  }
  put(text, "\t</colors_>\n");
}

void put_laser(Text& text, std::size_t number, const Hdl64eLaser& laser) {
  const bool first = number == 0;
  // Some readers always interpolate between near and far. With both equal they use the far value
  // everywhere, which is what a laser without two-point correction needs.
  const double near_x_m = laser.two_point ? laser.dist_correction_x_m : laser.dist_correction_m;
  const double near_y_m = laser.two_point ? laser.dist_correction_y_m : laser.dist_correction_m;
  put(text, "\t\t<item{}>\n\t\t\t<px class_id{}=\"9\"{} object_id=\"_{}\">\n",
      first ? " class_id=\"8\" tracking_level=\"0\" version=\"1\"" : "", first ? "" : "_reference",
      first ? " tracking_level=\"1\" version=\"1\"" : "", number + 1);
  put(text, "\t\t\t\t<id_>{}</id_>\n", number);
  const auto field = [&](std::string_view element, const std::string& value) {
    put(text, "\t\t\t\t<{0}>{1}</{0}>\n", element, value);
  };
  field("rotCorrection_", degrees(laser.rot_correction_rad));
  field("vertCorrection_", degrees(laser.vert_correction_rad));
  field("distCorrection_", centimetres(laser.dist_correction_m));
  field("distCorrectionX_", centimetres(near_x_m));
  field("distCorrectionY_", centimetres(near_y_m));
  field("vertOffsetCorrection_", centimetres(laser.vert_offset_m));
  field("horizOffsetCorrection_", centimetres(laser.horiz_offset_m));
  field("focalDistance_", centimetres(laser.focal_distance_m));
  field("focalSlope_", text::text_of(laser.focal_slope, 0));
  put(text, "\t\t\t</px>\n\t\t</item>\n");
}

void put_triple(Text& text, std::string_view element, int class_id, std::string_view inner) {
  put(text,
      "\t<{0} class_id=\"{1}\" tracking_level=\"0\" version=\"0\">\n\t\t<{2}>\n"
      "\t\t\t<count>3</count>\n\t\t\t<item>0</item>\n\t\t\t<item>0</item>\n\t\t\t<item>0</item>\n"
      "\t\t</{2}>\n\t</{0}>\n",
      element, class_id, inner);
}

}  // namespace

Status write_hdl64e_xml(const std::filesystem::path& path, const Hdl64eCalibration& calibration) {
  if (const Status status = validate(calibration); !status) return status;
  const auto& lasers = calibration.lasers;
  Text text;
  put(text,
      "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\" ?>\n"
      "<!DOCTYPE boost_serialization>\n"
      "<boost_serialization signature=\"serialization::archive\" version=\"4\">\n"
      "<DB class_id=\"0\" tracking_level=\"1\" version=\"0\" object_id=\"_0\">\n");
  put(text, "\t<distLSB_>{}</distLSB_>\n", centimetres(calibration.distance_resolution_m));
  put_triple(text, "position_", 1, "xyz");
  put_triple(text, "orientation_", 2, "rpy");
  put_colors(text);
  put_list(text, "enabled_", false, [](std::size_t) { return 1; });
  put_list(text, "intensity_", false, [](std::size_t) { return 1; });
  put_list(text, "minIntensity_", true, [&](std::size_t i) { return lasers[i].min_intensity; });
  put_list(text, "maxIntensity_", true, [&](std::size_t i) { return lasers[i].max_intensity; });
  put(text,
      "\t<points_ class_id=\"7\" tracking_level=\"0\" version=\"0\">\n"
      "\t\t<count>64</count>\n\t\t<item_version>1</item_version>\n");
  for (std::size_t i = 0; i < lasers.size(); ++i) put_laser(text, i, lasers[i]);
  put(text, "\t</points_>\n</DB>\n</boost_serialization>\n");
  return files::write_whole_file(path, std::string_view(text.data(), text.size()));
}

}  // namespace terracut::hdl64e
