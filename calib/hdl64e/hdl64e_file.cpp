// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_file.hpp"

#include <fmt/format.h>

#include <string_view>

#include "calib/hdl64e/hdl64e_xml.hpp"
#include "calib/hdl64e/hdl64e_yaml.hpp"
#include "calib/text/bounded_file.hpp"
#include "calib/text/number_text.hpp"

namespace terracut::hdl64e {
namespace {

enum class Kind { kXml, kYaml, kAngleTable, kUnknown };

/// True if `text` begins with a line of an angle table: "-10.2637,9.1205".
bool is_angle_line(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const std::size_t comma = line.find(',');
  return comma != std::string_view::npos && text::number_from(line.substr(0, comma)).has_value();
}

Kind kind_of(std::string_view text, const std::filesystem::path& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos) {
    text.remove_prefix(first);
    if (text.front() == '<') return Kind::kXml;
    if (text.find("lasers:") != std::string_view::npos) return Kind::kYaml;
    if (is_angle_line(text)) return Kind::kAngleTable;
  }
  const std::string extension = path.extension().string();
  if (extension == ".xml") return Kind::kXml;
  if (extension == ".yaml" || extension == ".yml") return Kind::kYaml;
  if (extension == ".csv") return Kind::kAngleTable;
  return Kind::kUnknown;
}

}  // namespace

Expected<Hdl64eCalibration> load_hdl64e_calibration(const std::filesystem::path& path) {
  constexpr std::string_view kExpected =
      "an HDL-64E calibration: the maker's db.xml, or ROS YAML with a list \"lasers:\"";
  const auto text = text::read_bounded_file(path, kExpected);
  if (!text) return tl::unexpected(text.error());
  switch (kind_of(*text, path)) {
    case Kind::kXml:
      return parse_hdl64e_xml(*text, path.string());
    case Kind::kYaml:
      return parse_hdl64e_yaml(*text, path.string());
    case Kind::kAngleTable:
      return fail(ErrorCode::kUnsupported,
                  fmt::format("{}: this is a RoboSense angle table (csv), which no HDL-64E has; "
                              "expected {}",
                              path.string(), kExpected));
    case Kind::kUnknown:
      break;
  }
  return fail(ErrorCode::kUnsupported,
              fmt::format("{}: neither XML nor YAML was recognised; expected {}", path.string(),
                          kExpected));
}

}  // namespace terracut::hdl64e
