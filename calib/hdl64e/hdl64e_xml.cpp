// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_xml.hpp"

#include <fmt/format.h>

#include <bitset>
#include <cmath>
#include <pugixml.hpp>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/text/bounded_file.hpp"
#include "calib/text/number_text.hpp"

namespace terracut::hdl64e {
namespace {

constexpr int kCentimetre = -2;  ///< Decimal exponent that converts the file's lengths to metres.

tl::unexpected<Error> malformed(std::string message) {
  return fail(ErrorCode::kMalformed, std::move(message));
}

/// Returns the finite number in the only child `element` of `parent`, times 10^exponent; `fallback`
/// if there is no such child.
Expected<double> number_in(const pugi::xml_node& parent, const char* element, int exponent,
                           const std::string& where, const double* fallback) {
  const pugi::xml_node node = parent.child(element);
  if (!node) {
    if (fallback != nullptr) return *fallback;
    return malformed(fmt::format("{}: <{}> is missing", where, element));
  }
  if (node.next_sibling(element)) {
    return malformed(fmt::format("{}: <{}> is there twice", where, element));
  }
  const auto value = text::number_from(node.text().get(), exponent);
  if (!value || !std::isfinite(*value)) {
    return malformed(fmt::format("{}: <{}> is \"{:.40}\", expected a finite number", where, element,
                                 node.text().get()));
  }
  return *value;
}

/// Returns the 64 <item> numbers of list `element`; 64 times `fallback` if the file has no such
/// list.
Expected<std::array<double, kHdl64eLasers>> list_in(const pugi::xml_node& db, const char* element,
                                                    const std::string& name, double fallback) {
  std::array<double, kHdl64eLasers> values{};
  values.fill(fallback);
  const pugi::xml_node list = db.child(element);
  if (!list) return values;
  std::size_t count = 0;
  for (const pugi::xml_node& item : list.children("item")) {
    const auto value = text::number_from(item.text().get());
    if (!value || !(*value >= 0 && *value <= 255)) {
      return malformed(fmt::format("{}: <{}> of laser {} is \"{:.40}\", expected 0 to 255", name,
                                   element, count, item.text().get()));
    }
    if (count < values.size()) values[count] = *value;
    ++count;
  }
  if (count != values.size()) {
    return malformed(fmt::format("{}: <{}> has {} items, expected 64", name, element, count));
  }
  return values;
}

/// Reads one <px> except for its intensity limits.
Expected<Hdl64eLaser> laser_from(const pugi::xml_node& px, const std::string& where) {
  Hdl64eLaser laser;
  const double zero = 0;
  struct Field {
    const char* element;
    double* target;
    int exponent;
    const double* fallback;
  };
  const Field fields[] = {
      {"rotCorrection_", &laser.rot_correction_rad, 0, nullptr},
      {"vertCorrection_", &laser.vert_correction_rad, 0, nullptr},
      {"distCorrection_", &laser.dist_correction_m, kCentimetre, nullptr},
      {"distCorrectionX_", &laser.dist_correction_x_m, kCentimetre, &zero},
      {"distCorrectionY_", &laser.dist_correction_y_m, kCentimetre, &zero},
      {"vertOffsetCorrection_", &laser.vert_offset_m, kCentimetre, &zero},
      {"horizOffsetCorrection_", &laser.horiz_offset_m, kCentimetre, &zero},
      {"focalDistance_", &laser.focal_distance_m, kCentimetre, &zero},
      {"focalSlope_", &laser.focal_slope, 0, &zero},
  };
  for (const Field& field : fields) {
    const auto value = number_in(px, field.element, field.exponent, where, field.fallback);
    if (!value) return tl::unexpected(value.error());
    *field.target = *value;
  }
  laser.rot_correction_rad = beams::deg_to_rad(laser.rot_correction_rad);
  laser.vert_correction_rad = beams::deg_to_rad(laser.vert_correction_rad);
  laser.two_point = two_point_present(laser.dist_correction_m, laser.dist_correction_x_m,
                                      laser.dist_correction_y_m);
  return laser;
}

Expected<Hdl64eCalibration> calibration_from(const pugi::xml_node& db, const std::string& name) {
  Hdl64eCalibration calibration;
  calibration.origin = name;
  const auto resolution_m =
      number_in(db, "distLSB_", kCentimetre, name, &calibration.distance_resolution_m);
  if (!resolution_m) return tl::unexpected(resolution_m.error());
  calibration.distance_resolution_m = *resolution_m;

  std::bitset<kHdl64eLasers> seen;
  for (const pugi::xml_node& item : db.child("points_").children("item")) {
    const pugi::xml_node px = item.child("px");
    const auto id = number_in(px, "id_", 0, name + ": a laser in <points_>", nullptr);
    if (!id) return tl::unexpected(id.error());
    if (!(*id >= 0 && *id < kHdl64eLasers && *id == std::floor(*id))) {
      return fail(ErrorCode::kUnsupported,
                  fmt::format("{}: laser number {:g}, expected 0 to 63 of an HDL-64E", name, *id));
    }
    const auto number = static_cast<std::size_t>(*id);
    if (seen.test(number)) {
      return malformed(fmt::format("{}: laser {} is there twice", name, number));
    }
    seen.set(number);
    auto laser = laser_from(px, fmt::format("{}: laser {}", name, number));
    if (!laser) return tl::unexpected(laser.error());
    calibration.lasers[number] = *laser;
  }
  if (!seen.all()) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected 64 lasers, found {}; is this another model's file?", name,
                            seen.count()));
  }

  const auto enabled = list_in(db, "enabled_", name, 1);
  if (!enabled) return tl::unexpected(enabled.error());
  const auto minimum = list_in(db, "minIntensity_", name, 0);
  if (!minimum) return tl::unexpected(minimum.error());
  const auto maximum = list_in(db, "maxIntensity_", name, 255);
  if (!maximum) return tl::unexpected(maximum.error());
  std::vector<std::size_t> disabled;
  for (std::size_t i = 0; i < calibration.lasers.size(); ++i) {
    if ((*enabled)[i] == 0) disabled.push_back(i);
    calibration.lasers[i].min_intensity = static_cast<int>(std::lround((*minimum)[i]));
    calibration.lasers[i].max_intensity = static_cast<int>(std::lround((*maximum)[i]));
  }
  if (!disabled.empty()) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected 64 enabled lasers, found {}: laser {} is the first with "
                            "<enabled_> 0",
                            name, calibration.lasers.size() - disabled.size(), disabled.front()));
  }
  return calibration;
}

}  // namespace

Expected<Hdl64eCalibration> parse_hdl64e_xml(std::span<const char> text, const std::string& name) {
  if (text.size() > text::kMaxFileBytes) {
    return fail(ErrorCode::kUnsupported, name + ": is larger than 4 MiB, expected a db.xml");
  }
  if (text.empty()) return malformed(name + ": is empty, expected a db.xml");
  pugi::xml_document document;
  const auto parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) {
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0));
    return malformed(fmt::format("{}: line {}: not well-formed XML: {}", name,
                                 text::line_of({text.data(), text.size()}, offset),
                                 parsed.description()));
  }
  const pugi::xml_node db = document.child("boost_serialization").child("DB");
  if (!db) {
    return fail(
        ErrorCode::kUnsupported,
        fmt::format("{}: expected an HDL-64E db.xml (<boost_serialization><DB>), found root "
                    "element <{:.40}>",
                    name, document.document_element().name()));
  }
  auto calibration = calibration_from(db, name);
  if (!calibration) return calibration;
  if (const Status status = validate(*calibration); !status) {
    return tl::unexpected(status.error());
  }
  return calibration;
}

Expected<Hdl64eCalibration> read_hdl64e_xml(const std::filesystem::path& path) {
  const auto text = text::read_bounded_file(path, "an HDL-64E db.xml");
  if (!text) return tl::unexpected(text.error());
  return parse_hdl64e_xml(*text, path.string());
}

}  // namespace terracut::hdl64e
